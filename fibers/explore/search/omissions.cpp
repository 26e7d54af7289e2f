// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/explore/search/omissions.hpp"

#include "fibers/explore/strategies/memory_option.hpp"

namespace waitpoint::exploration {

std::string Omissions::in_words() const {
  std::string text;
  const auto add = [&](bool is_left_out, const char* what) {
    if (is_left_out) text.append(text.empty() ? ", except " : " and ").append(what);
  };
  add(turns, "turns of spinning tasks");
  add(costs, "computing costs between the bounds");
  add(spurious, "spurious wake-ups");
  add(accesses, "switches at first accesses to memory that the default order does not share");
  add(values, values_left_out);
  return text;
}

}  // namespace waitpoint::exploration
