// SPDX-License-Identifier: BSD-3-Clause
// Words and signs of a file of rules. A word is a name, or several joined by dots: "ndd.GoTo", "mast.state.height_m",
// "via.0.x". Comments last from '#' to the end of the line.
#pragma once

#include <string>
#include <string_view>

#include "modules/control/rules.hpp"

namespace waitpoint::control {

struct Token {
  enum class Kind : std::uint8_t { word, number, sign, end };
  Kind kind = Kind::end;
  std::string_view text;  ///< of the contents
  double number = 0;
  Place place;

  bool is(std::string_view what) const { return kind != Kind::end && text == what; }
};

class Lexer {
 public:
  /// `contents` must outlive the lexer and its tokens.
  Lexer(std::string_view contents, const std::string& file) : file_(file), rest_(contents) {}

  /// The next token; `end` at and after the end of the file. BadInput for a character that begins none.
  Token next();

 private:
  void skip_space();
  Token take(Token::Kind kind, std::size_t length);
  [[noreturn]] void refuse() const;

  const std::string& file_;
  std::string_view rest_;
  Place place_;
};

}  // namespace waitpoint::control
