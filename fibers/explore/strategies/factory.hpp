// SPDX-License-Identifier: BSD-3-Clause
// Strategies by their names, as options, tokens and the environment give them.
#pragma once

#include <memory>
#include <string>

#include "fibers/explore/strategies/strategy.hpp"

namespace waitpoint::exploration {

enum class Kinds {
  all,
  drawing,  ///< those that can draw a schedule without its predecessors: not the exhaustive ones
};

/// The strategy of that name: "random", "pct:3". Throws BadInput, which lists the strategies of kind `named`.
std::unique_ptr<Strategy> make_strategy(const std::string& name, Kinds named = Kinds::all);

/// The names of all strategies, with their parameters, as --help shows them.
std::string strategy_names(Kinds kinds = Kinds::all);

}  // namespace waitpoint::exploration
