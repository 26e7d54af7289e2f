// SPDX-License-Identifier: BSD-3-Clause
// Compares the outcomes that strategies find with those that a program can have.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "tests/fibers/explore/completeness/interpreter.hpp"

namespace waitpoint::completeness {

/// The greatest number of an abstract machine's states.
inline constexpr std::size_t states_max = 200'000;

/// Finds the outcomes of a program, as cover() does.
using Coverage = std::function<Covered(const Program& program)>;

enum class RunVerdict {
  equal,
  different,   ///< it found an outcome that the program cannot have, or has missed one
  left_out,    ///< the strategy says that it left schedules out, and found no other outcome
  unfinished,  ///< more states or schedules than the limits: no other outcome was found
};

/// The verdict on `covered`, of a program with the outcomes `all`; in `difference`, what differs. The outcome "cycle ?"
/// stands for all cycles.
RunVerdict compare(const Enumerated& all, const Covered& covered, std::string& difference);

/// A smallest program, made from `program` by omissions, for which `coverage` still differs.
Program shrink(const Program& program, const Coverage& coverage);

}  // namespace waitpoint::completeness
