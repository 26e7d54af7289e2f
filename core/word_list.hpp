// SPDX-License-Identifier: BSD-3-Clause
// Words as a list in a message: "run, walk or stand".
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace waitpoint {

inline std::string word_list(std::span<const std::string_view> words) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (i > 0) text += i + 1 == words.size() ? " or " : ", ";
    text += words[i];
  }
  return text;
}

}  // namespace waitpoint
