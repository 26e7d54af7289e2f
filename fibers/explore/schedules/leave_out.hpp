// SPDX-License-Identifier: BSD-3-Clause
// Delta debugging: removes elements of a list by halves, quarters and so on down to single ones (Zeller, Hildebrandt,
// "Simplifying and isolating failure-inducing input", IEEE TSE 2002).
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace waitpoint::exploration {

/// `all()` is the current list. `is_enough(all, others, from, size)` returns true if it has replaced the list by a
/// shorter one: `others`, which lacks the `size` elements at `from`, or one derived from it. Runs until nothing more
/// can be removed.
template <class All, class IsEnough>
void leave_out(const All& all, const IsEnough& is_enough) {
  for (std::size_t parts = 2;;) {
    const auto whole = all();
    if (whole.size() < 2) return;
    parts = std::min(parts, whole.size());
    const std::size_t size = (whole.size() + parts - 1) / parts;
    bool is_shorter = false;
    for (std::size_t from = 0; from < whole.size() && !is_shorter; from += size) {
      const std::size_t end = std::min(whole.size(), from + size);
      auto others = whole;
      others.erase(others.begin() + static_cast<std::ptrdiff_t>(from),
                   others.begin() + static_cast<std::ptrdiff_t>(end));
      is_shorter = is_enough(whole, others, from, size);
    }
    if (is_shorter)
      parts = std::max<std::size_t>(2, parts - 1);
    else if (parts == whole.size())
      return;
    else
      parts *= 2;
  }
}

}  // namespace waitpoint::exploration
