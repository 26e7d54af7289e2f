// SPDX-License-Identifier: BSD-3-Clause
#include "modules/description/lexer.hpp"

#include <array>

#include "core/error.hpp"

namespace waitpoint::description {
namespace {

bool is_digit(char letter) { return letter >= '0' && letter <= '9'; }
bool begins_name(char letter) {
  return (letter >= 'a' && letter <= 'z') || (letter >= 'A' && letter <= 'Z') || letter == '_';
}
bool in_name(char letter) { return begins_name(letter) || is_digit(letter); }

// Longer ones first.
constexpr std::array punctuation = std::to_array<std::string_view>(
    {"...", "<<=", ">>=", "::", "<<", ">>", "<=", ">=", "==", "!=", "&&", "||", "->", "++", "--", "##"});
constexpr std::string_view single_punctuation = "{}[]()<>;:,.*&|^~!+-/%=?#@";

class Lexer {
 public:
  Lexer(std::string_view contents, const std::shared_ptr<const std::string>& file)
      : contents_(contents), place_{file, 1, 1} {}

  std::vector<Token> read() {
    std::vector<Token> tokens;
    for (;;) {
      skip_space();
      Token& token = tokens.emplace_back();
      token.place = place_;
      token.first_of_line = first_of_line_;
      token.after_space = after_space_;
      token.begin = at_;
      first_of_line_ = after_space_ = false;
      if (at_ == contents_.size()) {
        token.first_of_line = true;
        token.end = at_;
        return tokens;
      }
      read_token(token);
      token.end = at_;
    }
  }

 private:
  char peek(std::size_t ahead = 0) const { return at_ + ahead < contents_.size() ? contents_[at_ + ahead] : '\0'; }
  bool begins(std::string_view text) const { return contents_.substr(at_).starts_with(text); }

  void advance(std::size_t letters = 1) {
    for (; letters > 0 && at_ < contents_.size(); --letters, ++at_) {
      ++place_.column;
      if (contents_[at_] != '\n') continue;
      ++place_.line;
      place_.column = 1;
    }
  }

  void skip_space() {
    for (;;) {
      if (peek() == '\n') {
        first_of_line_ = true;
        advance();
      } else if (peek() == ' ' || (peek() >= '\t' && peek() <= '\r')) {
        advance();
      } else if (begins("\\\n") || begins("\\\r\n")) {
        advance(begins("\\\n") ? 2 : 3);
      } else if (begins("//")) {
        while (at_ < contents_.size() && peek() != '\n') advance();
      } else if (begins("/*")) {
        skip_comment();
      } else {
        return;
      }
      after_space_ = true;
    }
  }

  void skip_comment() {
    const SourcePlace begin = place_;
    advance(2);
    while (!begins("*/")) {
      if (at_ == contents_.size()) reject(begin, "expected '*/' at the end of this comment, found the end of the file");
      advance();
    }
    advance(2);
  }

  void read_token(Token& token) {
    if (begins_name(peek())) {
      token.kind = TokenKind::name;
      take_while(token, in_name);
    } else if (is_digit(peek()) || (peek() == '.' && is_digit(peek(1)))) {
      token.kind = TokenKind::number;
      take_number(token);
    } else if (peek() == '"' || peek() == '\'') {
      take_quoted(token, peek());
    } else {
      token.kind = TokenKind::punctuation;
      take_punctuation(token);
    }
  }

  void take_while(Token& token, bool (*belongs)(char)) {
    while (belongs(peek())) take(token);
  }
  void take(Token& token) {
    token.text += peek();
    advance();
  }

  // As in C, a number goes on after a sign behind its exponent.
  void take_number(Token& token) {
    while (in_name(peek()) || peek() == '.') {
      const bool exponent = (peek() == 'e' || peek() == 'E') && !token.text.starts_with("0x");
      take(token);
      if (exponent && (peek() == '+' || peek() == '-')) take(token);
    }
  }

  // A character in single quotes is a number, as in C.
  void take_quoted(Token& token, char quote) {
    token.kind = TokenKind::text;
    advance();
    while (peek() != quote || at_ == contents_.size()) {
      if (at_ == contents_.size() || peek() == '\n')
        reject(token.place, std::string("expected a closing ") + quote + ", found the end of the line");
      if (peek() != '\\') {
        take(token);
        continue;
      }
      advance();
      token.text += peek() == 'n' ? '\n' : peek();
      advance();
    }
    advance();
    if (quote == '"') return;
    if (token.text.size() != 1) reject(token.place, "expected one character between single quotes");
    token.kind = TokenKind::number;
    token.text = std::to_string(static_cast<int>(token.text[0]));
  }

  void take_punctuation(Token& token) {
    std::size_t length = 0;
    for (const std::string_view known : punctuation)
      if (length == 0 && begins(known)) length = known.size();
    if (length == 0 && single_punctuation.find(peek()) != std::string_view::npos) length = 1;
    if (length == 0) reject(place_, std::string("expected a word of GenoM or C, found '") + peek() + "'");
    for (; length > 0; --length) take(token);
  }

  std::string_view contents_;
  std::size_t at_ = 0;
  SourcePlace place_;
  bool first_of_line_ = true, after_space_ = false;
};

}  // namespace

void reject(const SourcePlace& place, const std::string& message) {
  throw BadInput(place.file ? *place.file : "", place.line, "column " + std::to_string(place.column) + ": " + message);
}

std::string shown(const Token& token) {
  if (token.kind == TokenKind::end) return "the end of the file";
  if (token.kind == TokenKind::text) return "the text '" + token.text + "'";
  return "'" + token.text + "'";
}

std::vector<Token> lex(std::string_view contents, const std::shared_ptr<const std::string>& file) {
  return Lexer(contents, file).read();
}

}  // namespace waitpoint::description
