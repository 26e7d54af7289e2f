// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/world/figures.hpp"

#include <fmt/format.h>

namespace waitpoint::bench {

std::string Figures::judge(const std::optional<Limit>& limit, double figure, Count& count) {
  if (!limit) return "";
  const bool met = limit->met_by(figure);
  ++count.all;
  count.met += met ? 1 : 0;
  return fmt::format("{}{:.3g} {}", limit->at_most ? '<' : '>', limit->value, met ? "yes" : "NO ");
}

void Figures::add(const Figure& figure) {
  const double judged = figure.ratio.value_or(figure.value);
  const std::string must = judge(figure.must, judged, musts_), aim = judge(figure.aim, judged, aims_);
  const std::string ratio = figure.ratio ? fmt::format("{:.2f}x", *figure.ratio) : "";
  fmt::print("{:<34}{:<16}{:>10.2f} {:<10}{:>10}{:>12}{:>12}\n", figure.case_name, figure.who, figure.value,
             figure.unit, ratio, must, aim);
  std::fflush(stdout);
  rows_.push_back({"world", figure.case_name, figure.who, figure.value, figure.unit});
  if (figure.ratio) rows_.push_back({"world", figure.case_name + ", ratio", figure.who, *figure.ratio, "times"});
  if (!figure.must) return;
  // A row's bound is a minimum: an upper bound becomes the ratio of the bound to the figure.
  if (!figure.must->at_most)
    rows_.back().must = figure.must->value;
  else
    rows_.push_back(
        {"world", figure.case_name + ", bound to figure", figure.who, figure.must->value / judged, "times", 1});
}

}  // namespace waitpoint::bench
