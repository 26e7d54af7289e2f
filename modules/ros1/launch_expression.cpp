// SPDX-License-Identifier: BSD-3-Clause
#include "modules/ros1/launch_expression.hpp"

#include <algorithm>
#include <iterator>

#include "core/number_text.hpp"
#include "modules/ros1/expression_value.hpp"

namespace waitpoint::ros1 {
namespace {

bool begins_name(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool continues_name(char c) { return begins_name(c) || is_digit(c); }

struct ExpressionToken {
  enum class Kind : unsigned char { name, number, text, sign, end };
  Kind kind = Kind::end;
  std::string text;  // of a text without its quotes
};

class Evaluation {
 public:
  Evaluation(std::string_view expression, const SubstitutionCall& call, const Location& written)
      : rest_(expression), whole_(expression), call_(call), written_(written) {
    advance();
  }

  ExpressionValue value() {
    ExpressionValue result = choice();
    if (token_.kind != ExpressionToken::Kind::end) fail("the end");
    return result;
  }

 private:
  // For each level of parentheses and signs, all levels below are on the stack.
  static constexpr int levels_max = 50;

  [[noreturn]] void fail(const std::string& expected) const {
    const std::string found = token_.kind == ExpressionToken::Kind::end ? "its end" : "'" + token_.text + "'";
    throw written_.bad("expected " + expected + " in the expression '" + std::string(whole_) + "', found " + found);
  }
  [[noreturn]] void fail_at(const std::string& op) const {
    throw written_.bad("expected values that have '" + op + "', and a result, in the expression '" +
                       std::string(whole_) + "'");
  }

  void advance() {
    rest_.remove_prefix(std::min(rest_.find_first_not_of(" \t\r\n"), rest_.size()));
    token_ = {};
    if (rest_.empty()) return;
    const char first = rest_.front();
    std::size_t size = 1;
    if (begins_name(first)) {
      token_.kind = ExpressionToken::Kind::name;
      while (size < rest_.size() && continues_name(rest_[size])) ++size;
    } else if (is_digit(first) || (first == '.' && rest_.size() > 1 && is_digit(rest_[1]))) {
      token_.kind = ExpressionToken::Kind::number;
      const auto in_exponent = [&](char c) { return (c == '+' || c == '-') && (rest_[size - 1] | 0x20) == 'e'; };
      while (size < rest_.size() && (continues_name(rest_[size]) || rest_[size] == '.' || in_exponent(rest_[size])))
        ++size;
    } else if (first == '\'' || first == '"') {
      token_.kind = ExpressionToken::Kind::text;
      const std::size_t end = rest_.find(first, 1);
      if (end == rest_.npos || rest_.substr(0, end).find('\\') != rest_.npos)
        throw written_.bad("expected a text in quotes, without '\\', in the expression '" + std::string(whole_) + "'");
      token_.text = rest_.substr(1, end - 1);
      rest_.remove_prefix(end + 1);
      return;
    } else {
      token_.kind = ExpressionToken::Kind::sign;
      for (const std::string_view two : {"==", "!=", "<=", ">=", "//"})
        if (rest_.starts_with(two)) size = 2;
    }
    token_.text = rest_.substr(0, size);
    rest_.remove_prefix(size);
  }

  bool is(ExpressionToken::Kind kind, std::string_view text) const {
    return token_.kind == kind && token_.text == text;
  }
  bool take_name(std::string_view text) { return take(ExpressionToken::Kind::name, text); }
  bool take_sign(std::string_view text) { return take(ExpressionToken::Kind::sign, text); }
  bool take(ExpressionToken::Kind kind, std::string_view text) {
    const bool found = is(kind, text);
    if (found) advance();
    return found;
  }
  void require_sign(const char* text) {
    if (!take_sign(text)) fail("'" + std::string(text) + "'");
  }
  template <std::size_t count>
  bool take_one_of(const std::string_view (&signs)[count], std::string& found) {
    found = token_.text;
    return token_.kind == ExpressionToken::Kind::sign &&
           std::find(std::begin(signs), std::end(signs), token_.text) != std::end(signs) && take_sign(found);
  }

  ExpressionValue choice() {
    if (++levels_ > levels_max)
      throw written_.bad("expected at most " + std::to_string(levels_max) + " levels in the expression '" +
                         std::string(whole_) + "'");
    ExpressionValue first = alternative();
    if (take_name("if")) {
      const bool holds = is_true(alternative());
      if (!take_name("else")) fail("'else'");
      ExpressionValue second = choice();
      if (!holds) first = std::move(second);
    }
    --levels_;
    return first;
  }
  ExpressionValue alternative() {
    ExpressionValue value = conjunction();
    while (take_name("or")) {
      ExpressionValue next = conjunction();
      if (!is_true(value)) value = std::move(next);
    }
    return value;
  }
  ExpressionValue conjunction() {
    ExpressionValue value = negation();
    while (take_name("and")) {
      ExpressionValue next = negation();
      if (is_true(value)) value = std::move(next);
    }
    return value;
  }
  ExpressionValue negation() {
    bool is_negated = false, has_not = false;
    while (take_name("not")) {
      is_negated = !is_negated;
      has_not = true;
    }
    ExpressionValue value = comparison();
    if (has_not) return is_true(value) != is_negated;
    return value;
  }
  ExpressionValue comparison() {
    constexpr std::string_view orders[] = {"<", "<=", ">", ">="};
    ExpressionValue value = sum();
    if (take_sign("==")) return is_equal(value, sum());
    if (take_sign("!=")) return !is_equal(value, sum());
    std::string op;
    if (!take_one_of(orders, op)) return value;
    bool result = false;
    if (!compare(value, op, sum(), result)) fail_at(op);
    return result;
  }
  ExpressionValue sum() {
    constexpr std::string_view signs[] = {"+", "-"};
    ExpressionValue value = product(), result;
    for (std::string op; take_one_of(signs, op); value = std::move(result))
      if (!calculate(value, op, product(), result)) fail_at(op);
    return value;
  }
  ExpressionValue product() {
    constexpr std::string_view signs[] = {"*", "/", "//", "%"};
    ExpressionValue value = signed_value(), result;
    for (std::string op; take_one_of(signs, op); value = std::move(result))
      if (!calculate(value, op, signed_value(), result)) fail_at(op);
    return value;
  }
  ExpressionValue signed_value() {
    bool is_negative = false, has_sign = false;
    for (std::string sign; take_one_of({"+", "-"}, sign); has_sign = true) is_negative = is_negative != (sign == "-");
    ExpressionValue value = operand(), result;
    if (!has_sign) return value;
    const std::string op = is_negative ? "-" : "+";
    if (!calculate(std::int64_t{0}, op, value, result)) fail_at(op);
    return result;
  }
  ExpressionValue operand() {
    const ExpressionToken token = token_;
    if (token.kind == ExpressionToken::Kind::end) fail("a value");
    if (token.kind == ExpressionToken::Kind::sign) {
      require_sign("(");
      ExpressionValue value = choice();
      require_sign(")");
      return value;
    }
    advance();
    switch (token.kind) {
      case ExpressionToken::Kind::text: return token.text;
      case ExpressionToken::Kind::number: return number(token.text);
      default: return named(token.text);
    }
  }
  ExpressionValue number(const std::string& text) {
    std::int64_t integer = 0;
    double real = 0;
    if (parse_number(text, integer)) return integer;
    if (!parse_number(text, real)) throw written_.bad("expected a number in an expression, found '" + text + "'");
    return real;
  }
  ExpressionValue named(const std::string& name) {
    if (name == "True" || name == "true") return true;
    if (name == "False" || name == "false") return false;
    if (!take_sign("(")) return value_of_text(call_({"arg", name}));
    std::vector<std::string> words = {name};
    while (!take_sign(")")) {
      if (words.size() > 1) require_sign(",");
      if (token_.kind != ExpressionToken::Kind::text) fail("a text in quotes");
      words.push_back(token_.text);
      advance();
    }
    if (name == "eval") fail("no call of eval");
    std::string text = call_(words);
    if (name == "arg") return value_of_text(text);
    return text;
  }

  std::string_view rest_, whole_;
  const SubstitutionCall& call_;
  const Location& written_;
  ExpressionToken token_;
  int levels_ = 0;
};

}  // namespace

std::string value_of_expression(std::string_view expression, const SubstitutionCall& call, const Location& written) {
  constexpr std::size_t letters_max = 4096;
  if (expression.size() > letters_max)
    throw written.bad("expected an expression of at most " + std::to_string(letters_max) + " characters");
  return text_of(Evaluation(expression, call, written).value());
}

}  // namespace waitpoint::ros1
