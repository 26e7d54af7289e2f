// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/explore/strategies/factory.hpp"

#include <vector>

#include "core/error.hpp"
#include "core/nearest_name.hpp"
#include "core/number_text.hpp"
#include "fibers/explore/strategies/dfs.hpp"
#include "fibers/explore/strategies/dpor.hpp"
#include "fibers/explore/strategies/fifo.hpp"
#include "fibers/explore/strategies/go_explore.hpp"
#include "fibers/explore/strategies/pct.hpp"
#include "fibers/explore/strategies/portfolio.hpp"
#include "fibers/explore/strategies/pos.hpp"
#include "fibers/explore/strategies/random.hpp"
#include "fibers/explore/strategies/rff.hpp"
#include "fibers/explore/strategies/urw.hpp"

namespace waitpoint::exploration {
namespace {

using Made = std::unique_ptr<Strategy>;

// The proportions are measured: docs/zoo.md.
Made make_portfolio() {
  const std::shared_ptr<Strategy> pos = make_strategy("pos"), surw = make_strategy("surw"),
                                  returning = make_strategy("goexplore");
  return std::make_unique<Portfolio>(std::vector<std::shared_ptr<Strategy>>{
      make_strategy("random"), make_strategy("pct:2"), pos, returning, surw, make_strategy("rff"), make_strategy("urw"),
      returning, pos, make_strategy("pct:3"), surw, returning});
}

struct Known {
  std::string_view name;
  const char* parameter;  // its letter; null for a strategy without one
  std::uint32_t usual;    // default value
  std::uint32_t least;    // least value
  Made (*make)(std::uint32_t parameter);
};

constexpr Known known[] = {
    {"portfolio", nullptr, 0, 0, [](std::uint32_t) { return make_portfolio(); }},
    {"fifo", nullptr, 0, 0, [](std::uint32_t) -> Made { return std::make_unique<Fifo>(); }},
    {"random", nullptr, 0, 0, [](std::uint32_t) -> Made { return std::make_unique<Random>(); }},
    {"pct", "D", 3, 1, [](std::uint32_t depth) -> Made { return std::make_unique<Pct>(depth); }},
    {"pos", nullptr, 0, 0, [](std::uint32_t) -> Made { return std::make_unique<Pos>(); }},
    {"urw", nullptr, 0, 0, [](std::uint32_t) -> Made { return std::make_unique<Urw>(false); }},
    {"surw", nullptr, 0, 0, [](std::uint32_t) -> Made { return std::make_unique<Urw>(true); }},
    {"rff", nullptr, 0, 0, [](std::uint32_t) -> Made { return std::make_unique<Rff>(); }},
    {"goexplore", nullptr, 0, 0, [](std::uint32_t) -> Made { return std::make_unique<GoExplore>(); }},
    {"bounded", "K", 2, 0, [](std::uint32_t most) -> Made { return std::make_unique<Dfs>(most); }},
    {"dfs", nullptr, 0, 0, [](std::uint32_t) -> Made { return std::make_unique<Dfs>(); }},
    {"dpor", nullptr, 0, 0, [](std::uint32_t) -> Made { return std::make_unique<Dpor>(); }},
};
constexpr std::uint32_t parameter_max = 1000;

bool is_of(const Known& strategy, Kinds kinds) {
  return kinds == Kinds::all || !strategy.make(strategy.usual)->is_exhaustive();
}

}  // namespace

std::unique_ptr<Strategy> make_strategy(const std::string& name, Kinds named) {
  const std::size_t colon = name.find(':');
  const std::string_view kind = std::string_view(name).substr(0, colon);
  std::vector<std::string_view> names;
  for (const Known& strategy : known) {
    if (is_of(strategy, named)) names.push_back(strategy.name);
    if (strategy.name != kind) continue;
    std::uint32_t parameter = strategy.usual;
    if (colon != std::string::npos &&
        (strategy.parameter == nullptr || !parse_number(std::string_view(name).substr(colon + 1), parameter) ||
         parameter < strategy.least || parameter > parameter_max))
      throw BadInput("strategy", "expected " + std::string(kind) +
                                     (strategy.parameter == nullptr
                                          ? " without a parameter"
                                          : ":" + std::string(strategy.parameter) + ", a whole number from " +
                                                std::to_string(strategy.least) + " to 1000") +
                                     ", found '" + name + "'");
    return strategy.make(parameter);
  }
  throw BadInput("strategy", "unknown strategy '" + name + "'" + did_you_mean(kind, names) + "; there are " +
                                 strategy_names(named));
}

std::string strategy_names(Kinds kinds) {
  std::string text;
  for (const Known& strategy : known) {
    if (!is_of(strategy, kinds)) continue;
    text.append(text.empty() ? "" : ", ").append(strategy.name);
    if (strategy.parameter != nullptr) text.append(":").append(strategy.parameter);
  }
  return text;
}

}  // namespace waitpoint::exploration
