// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/explore/search/new_pair_chance.hpp"

#include <cstdio>

namespace waitpoint::exploration {
namespace {

// With two digits that count.
std::string percent(double share) {
  const double value = 100 * share;
  char text[32];
  std::snprintf(text, sizeof text,
                value == 0 || value >= 9.95 ? "%.0f %%"
                : value >= 0.995            ? "%.1f %%"
                                            : "%.2g %%",
                value);
  return text;
}

}  // namespace

std::string to_text(const NewPairChance& chance) {
  return std::to_string(chance.pairs) + " pairs of events in " + std::to_string(chance.schedules) + " schedules of " +
         chance.strategy + (chance.is_at_accesses ? " with switches at accesses" : "") +
         ", a new one in the next with a chance of " + percent(chance.estimate) +
         " (95 % confidence: " + percent(chance.lower_bound) + " to " + percent(chance.upper_bound) + ")";
}

}  // namespace waitpoint::exploration
