// SPDX-License-Identifier: BSD-3-Clause
#include "core/nearest_name.hpp"

#include <algorithm>
#include <vector>

#include "core/word_list.hpp"

namespace waitpoint {

std::size_t edit_distance(std::string_view a, std::string_view b) {
  // Three rows of the table distance(i letters of a, j letters of b): a swap looks two rows back.
  std::vector<std::size_t> before_last(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    before_last.swap(last);
    last.swap(row);
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t changed = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      row[j] = std::min({changed, last[j] + 1, row[j - 1] + 1});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) row[j] = std::min(row[j], before_last[j - 2] + 1);
    }
  }
  return row[b.size()];
}

std::string nearest_name(std::string_view word, std::span<const std::string_view> known) {
  std::string_view nearest;
  std::size_t least = 0;
  for (const std::string_view name : known) {
    const std::size_t distance = edit_distance(word, name);
    if (3 * distance > std::max(word.size(), name.size())) continue;
    if (nearest.empty() || distance < least) {
      nearest = name;
      least = distance;
    }
  }
  return std::string(nearest);
}

std::string did_you_mean(std::string_view word, std::span<const std::string_view> known) {
  const std::string nearest = nearest_name(word, known);
  return nearest.empty() ? "" : ", did you mean '" + nearest + "'?";
}

std::string did_you_mean_or_expected(std::string_view word, std::span<const std::string_view> known) {
  const std::string hint = did_you_mean(word, known);
  return hint.empty() && !known.empty() ? ", expected " + word_list(known) : hint;
}

}  // namespace waitpoint
