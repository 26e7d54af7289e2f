// SPDX-License-Identifier: BSD-3-Clause
#include "modules/scenario/words.hpp"

#include <algorithm>

namespace waitpoint::scenario {
namespace {

constexpr std::string_view blanks = " \t\r\n";

}  // namespace

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

std::string take_word(std::string_view& text, const Location& written) {
  text = text.substr(std::min(text.find_first_not_of(blanks), text.size()));
  std::string word;
  if (!text.starts_with('"')) {
    word = text.substr(0, text.find_first_of(blanks));
    text.remove_prefix(word.size());
    return word;
  }
  const std::size_t end = text.find('"', 1);
  if (end == std::string_view::npos) throw written.bad("expected a closing quote");
  word = text.substr(1, end - 1);
  text.remove_prefix(end + 1);
  return word;
}

void require_end(std::string_view text, const Location& written) {
  if (!trimmed(text).empty())
    throw written.bad("expected the end of the line, found '" + std::string(trimmed(text)) + "'");
}

}  // namespace waitpoint::scenario
