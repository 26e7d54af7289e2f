// SPDX-License-Identifier: BSD-3-Clause
#include "modules/control/lexer.hpp"

#include <algorithm>
#include <iterator>

#include "core/number_text.hpp"

namespace waitpoint::control {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool begins_word(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool continues_word(char c) { return begins_word(c) || is_digit(c) || c == '-'; }
bool continues_number(char c) { return is_digit(c) || c == '.' || c == 'e' || c == 'E'; }

// The longest first.
constexpr std::string_view signs[] = {"&&", "||", "<=", ">=", "==", "!=", "{", "}",
                                      "(",  ")",  ",",  ":",  ";",  "<",  ">", "!"};

std::size_t word_length(std::string_view text) {
  std::size_t i = 0;
  while (i < text.size()) {
    const bool is_dot_in_word = text[i] == '.' && i + 1 < text.size() && continues_word(text[i + 1]);
    if (!is_dot_in_word && !continues_word(text[i])) break;
    ++i;
  }
  return i;
}

// A '-' or '+' belongs to the number at its beginning and after an 'e'; a '+' at the beginning is refused.
std::size_t number_length(std::string_view text) {
  std::size_t i = text.front() == '-' ? 1 : 0;
  while (i < text.size()) {
    const bool is_sign = text[i] == '-' || text[i] == '+';
    const bool is_after_e = i > 0 && (text[i - 1] == 'e' || text[i - 1] == 'E');
    if (!(is_sign && is_after_e) && !continues_number(text[i])) break;
    ++i;
  }
  return i;
}

}  // namespace

BadInput bad(const std::string& file, Place place, const std::string& message) {
  return BadInput(file, place.line, "column " + std::to_string(place.column) + ": " + message);
}

Token Lexer::next() {
  skip_space();
  if (rest_.empty()) return {.kind = Token::Kind::end, .text = {}, .place = place_};
  const char first = rest_.front();
  if (begins_word(first)) return take(Token::Kind::word, word_length(rest_));
  const bool is_negative = first == '-' && rest_.size() > 1 && (is_digit(rest_[1]) || rest_[1] == '.');
  if (is_digit(first) || first == '.' || is_negative) {
    Token token = take(Token::Kind::number, number_length(rest_));
    if (!parse_number(token.text, token.number))
      throw bad(file_, token.place, "expected a number, found '" + std::string(token.text) + "'");
    return token;
  }
  const auto* const sign =
      std::find_if(std::begin(signs), std::end(signs), [&](std::string_view each) { return rest_.starts_with(each); });
  if (sign == std::end(signs)) refuse();
  return take(Token::Kind::sign, sign->size());
}

void Lexer::skip_space() {
  bool is_comment = false;
  while (!rest_.empty()) {
    const char c = rest_.front();
    if (c == '\n') {
      is_comment = false;
      ++place_.line;
      place_.column = 0;
    } else if (c == '#') {
      is_comment = true;
    } else if (!is_comment && c != ' ' && c != '\t' && c != '\r') {
      return;
    }
    ++place_.column;
    rest_.remove_prefix(1);
  }
}

Token Lexer::take(Token::Kind kind, std::size_t length) {
  const Token token{.kind = kind, .text = rest_.substr(0, length), .place = place_};
  rest_.remove_prefix(length);
  place_.column += static_cast<int>(length);
  return token;
}

// Bytes that are no printable ASCII are named by their number.
void Lexer::refuse() const {
  const auto byte = static_cast<unsigned char>(rest_.front());
  const bool is_printable = byte > ' ' && byte < 0x7F;
  throw bad(file_, place_,
            "expected a name, a number or a sign, found " +
                (is_printable ? "'" + std::string(1, rest_.front()) + "'" : "byte " + std::to_string(byte)));
}

}  // namespace waitpoint::control
