// SPDX-License-Identifier: BSD-3-Clause
// The words of one file in C's lexical grammar, which GenoM's descriptions share: names, numbers, quoted texts and
// punctuation, without comments.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "modules/description/place.hpp"

namespace waitpoint::description {

enum class TokenKind : std::uint8_t { name, number, text, punctuation, end };

struct Token {
  TokenKind kind = TokenKind::end;
  std::string text;  ///< of a quoted text: the letters between the quotes, escapes resolved
  SourcePlace place;
  bool first_of_line = false;
  bool after_space = false;
  std::size_t begin = 0, end = 0;  ///< in the file's bytes
  std::string macro;               ///< the macro that it comes from, if any
};

/// True for the punctuation or the name `text`; a quoted text never is.
inline bool is(const Token& token, std::string_view text) {
  return (token.kind == TokenKind::punctuation || token.kind == TokenKind::name) && token.text == text;
}

inline Token end_token(const SourcePlace& place) {
  Token token;
  token.place = place;
  return token;
}

/// For messages: "'name'", "the text \"...\"" or "the end of the file".
std::string shown(const Token& token);

/// The tokens of a file, with an end token behind them. An unfinished comment or text, or a letter that C does not
/// know, is BadInput.
std::vector<Token> lex(std::string_view contents, const std::shared_ptr<const std::string>& file);

}  // namespace waitpoint::description
