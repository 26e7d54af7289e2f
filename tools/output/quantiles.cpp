// SPDX-License-Identifier: BSD-3-Clause
#include "tools/output/quantiles.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace waitpoint::tools {
namespace {

using bridge::FiguresPresent;
using bridge::RunResult;
using bridge::RunTotals;

struct Figure {
  const char* name;
  bool (*is_present)(const RunTotals& totals);
  double (*value)(const RunResult& result, const RunTotals& totals);
};

constexpr Figure figures[] = {
    {"goals_reached_share", [](const RunTotals& totals) { return totals.goals > 0; },
     [](const RunResult&, const RunTotals& totals) {
       return static_cast<double>(totals.goals_reached) / static_cast<double>(totals.goals);
     }},
    {"distance_m", [](const RunTotals& totals) { return totals.present.motion; },
     [](const RunResult&, const RunTotals& totals) { return totals.distance_m; }},
    {"collisions", [](const RunTotals& totals) { return totals.present.motion; },
     [](const RunResult&, const RunTotals& totals) { return static_cast<double>(totals.collisions); }},
    {"position_error_max_m", [](const RunTotals& totals) { return totals.present.position; },
     [](const RunResult&, const RunTotals& totals) { return totals.position_error_max_m; }},
    {"odometry_error_max_m", [](const RunTotals& totals) { return totals.present.odometry; },
     [](const RunResult&, const RunTotals& totals) { return totals.odometry_error_max_m; }},
    {"simulated_s", [](const RunTotals&) { return true; },
     [](const RunResult& result, const RunTotals&) { return result.simulated.seconds(); }},
};

// Of sorted values, at least one.
double quantile(const std::vector<double>& values, double share) {
  const auto count = static_cast<std::size_t>(std::ceil(share * static_cast<double>(values.size())));
  return values[std::max<std::size_t>(count, 1) - 1];
}

}  // namespace

std::vector<Quantiles> quantiles_of(std::span<const RunResult> results) {
  std::vector<Quantiles> all;
  for (const Figure& figure : figures) {
    std::vector<double> values;
    for (const RunResult& result : results)
      if (const RunTotals sum = totals(result); figure.is_present(sum)) values.push_back(figure.value(result, sum));
    if (values.empty()) continue;
    std::ranges::sort(values);
    all.push_back({figure.name, values.front(), quantile(values, 0.1), quantile(values, 0.5), quantile(values, 0.9),
                   values.back()});
  }
  return all;
}

std::string quantiles_text(std::span<const RunResult> results) {
  std::string text =
      fmt::format("\n{:>22}  {:>9}  {:>9}  {:>9}  {:>9}  {:>9}\n", "", "least", "10 %", "median", "90 %", "most");
  for (const Quantiles& row : quantiles_of(results))
    text += fmt::format("{:>22}  {:>9.3f}  {:>9.3f}  {:>9.3f}  {:>9.3f}  {:>9.3f}\n", row.figure, row.least, row.tenth,
                        row.median, row.nine_tenths, row.most);
  return text;
}

}  // namespace waitpoint::tools
