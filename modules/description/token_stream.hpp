// SPDX-License-Identifier: BSD-3-Clause
// A position among tokens, for recursive-descent parsers.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "modules/description/keywords.hpp"
#include "modules/description/lexer.hpp"

namespace waitpoint::description {

class TokenStream {
 public:
  /// The last of `tokens` is an end token.
  explicit TokenStream(std::vector<Token> tokens) : tokens_(std::move(tokens)) {}

  /// Behind the last token: the end token.
  const Token& peek(std::size_t ahead = 0) const { return tokens_[std::min(at_ + ahead, tokens_.size() - 1)]; }
  const Token& take() {
    const Token& token = peek();
    if (at_ + 1 < tokens_.size()) ++at_;
    return token;
  }
  /// The token taken last.
  const Token& previous() const { return tokens_[at_ > 0 ? at_ - 1 : 0]; }
  bool at_end() const { return peek().kind == TokenKind::end; }
  bool next_is(std::string_view text) const { return is(peek(), text); }
  bool accept(std::string_view text) {
    if (!next_is(text)) return false;
    take();
    return true;
  }
  /// Takes the punctuation or keyword `text`; `where` ends the message: "after the name of a request".
  const Token& expect(std::string_view text, std::string_view where = "") {
    if (!next_is(text)) fail("expected '" + std::string(text) + "'" + (where.empty() ? "" : " " + std::string(where)));
    return take();
  }
  /// Takes a name; `what` says of what: "the name of a request".
  const Token& expect_name(std::string_view what) {
    if (peek().kind != TokenKind::name) fail("expected " + std::string(what));
    return take();
  }
  /// The same of a declaration in C and C++, where keywords are no names.
  const Token& expect_declared_name(std::string_view what) {
    if (peek().kind == TokenKind::name && is_keyword(peek().text))
      reject(peek().place, "expected " + std::string(what) + ", found the keyword '" + peek().text + "' of C or C++");
    return expect_name(what);
  }
  /// Throws BadInput "`expected`, found TOKEN" at the next token.
  [[noreturn]] void fail(const std::string& expected) const {
    reject(peek().place, expected + ", found " + shown(peek()));
  }

 private:
  std::vector<Token> tokens_;
  std::size_t at_ = 0;
};

}  // namespace waitpoint::description
