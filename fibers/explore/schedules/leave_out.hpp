// SPDX-License-Identifier: BSD-3-Clause
// Delta debugging: what can be left out of a list is, by halves, quarters and so on down to single elements (Zeller,
// Hildebrandt, "Simplifying and isolating failure-inducing input", IEEE TSE 2002).
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace waitpoint::exploration {

/// `all()` is the list as it stands. `is_enough(all, others, from, size)` says whether it was replaced by a shorter
/// one: by `others`, which are all but the `size` elements `from` there on, or something made of them. Until nothing
/// more can be left out.
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
