// SPDX-License-Identifier: BSD-3-Clause
#include "modules/description/constant_expression.hpp"

#include <array>
#include <charconv>
#include <limits>
#include <string>

namespace waitpoint::description {
namespace {

struct Operator {
  std::string_view text;
  int precedence;
};
constexpr std::array operators = std::to_array<Operator>({{"||", 1},
                                                          {"&&", 2},
                                                          {"|", 3},
                                                          {"^", 4},
                                                          {"&", 5},
                                                          {"==", 6},
                                                          {"!=", 6},
                                                          {"<", 7},
                                                          {">", 7},
                                                          {"<=", 7},
                                                          {">=", 7},
                                                          {"<<", 8},
                                                          {">>", 8},
                                                          {"+", 9},
                                                          {"-", 9},
                                                          {"*", 10},
                                                          {"/", 10},
                                                          {"%", 10}});
constexpr int depth_max = 100;
constexpr int shift_max = 62;

class Evaluation {
 public:
  Evaluation(TokenStream& tokens, const NameValue& value_of) : tokens_(tokens), value_of_(value_of) {}

  std::int64_t conditional(int depth) {
    if (depth > depth_max) tokens_.fail("expected at most 100 nested expressions");
    const std::int64_t condition = binary(1, depth);
    if (!tokens_.accept("?")) return condition;
    const std::int64_t yes = conditional(depth + 1);
    tokens_.expect(":", "of '?:'");
    const std::int64_t no = conditional(depth + 1);
    return condition != 0 ? yes : no;
  }

 private:
  // Precedence climbing: all operators of at least this precedence.
  std::int64_t binary(int least, int depth) {
    if (depth > depth_max) tokens_.fail("expected at most 100 nested expressions");
    std::int64_t left = unary(depth + 1);
    for (;;) {
      const Operator* found = nullptr;
      for (const Operator& known : operators)
        if (tokens_.next_is(known.text) && known.precedence >= least) found = &known;
      if (found == nullptr) return left;
      const Token token = tokens_.take();
      left = apply(token.text, token.place, left, binary(found->precedence + 1, depth + 1));
    }
  }

  static std::int64_t apply(std::string_view text, const SourcePlace& place, std::int64_t a, std::int64_t b) {
    std::int64_t result = 0;
    bool overflow = false;
    if (text == "+") overflow = __builtin_add_overflow(a, b, &result);
    if (text == "-") overflow = __builtin_sub_overflow(a, b, &result);
    if (text == "*") overflow = __builtin_mul_overflow(a, b, &result);
    if (text == "/" || text == "%") {
      if (b == 0 || (a == std::numeric_limits<std::int64_t>::min() && b == -1))
        reject(place, "expected a divisor other than this");
      return text == "/" ? a / b : a % b;
    }
    if (text == "<<" || text == ">>") {
      if (b < 0 || b > shift_max || a < 0) reject(place, "expected a shift of a positive number by 0 to 62 bits");
      overflow = text == "<<" && (a << b >> b) != a;
      result = text == "<<" ? a << b : a >> b;
    }
    if (overflow) reject(place, "expected a result of 64 bits");
    if (text == "|") return a | b;
    if (text == "^") return a ^ b;
    if (text == "&") return a & b;
    if (text == "||") return static_cast<std::int64_t>(a != 0 || b != 0);
    if (text == "&&") return static_cast<std::int64_t>(a != 0 && b != 0);
    if (text == "==") return static_cast<std::int64_t>(a == b);
    if (text == "!=") return static_cast<std::int64_t>(a != b);
    if (text == "<") return static_cast<std::int64_t>(a < b);
    if (text == ">") return static_cast<std::int64_t>(a > b);
    if (text == "<=") return static_cast<std::int64_t>(a <= b);
    if (text == ">=") return static_cast<std::int64_t>(a >= b);
    return result;
  }

  std::int64_t unary(int depth) {
    if (depth > depth_max) tokens_.fail("expected at most 100 nested expressions");
    const Token token = tokens_.peek();
    if (tokens_.accept("!")) return static_cast<std::int64_t>(unary(depth + 1) == 0);
    if (tokens_.accept("~")) return ~unary(depth + 1);
    if (tokens_.accept("+")) return unary(depth + 1);
    if (tokens_.accept("-")) return apply("-", token.place, 0, unary(depth + 1));
    if (tokens_.accept("(")) {
      const std::int64_t inner = conditional(depth + 1);
      tokens_.expect(")", "at the end of an expression");
      return inner;
    }
    if (token.kind == TokenKind::number) return number(tokens_.take());
    if (token.kind != TokenKind::name) tokens_.fail("expected a constant integer");
    tokens_.take();
    const std::optional<std::int64_t> value = value_of_(tokens_, token);
    if (!value) reject(token.place, "expected a constant, found the unknown name '" + token.text + "'");
    return *value;
  }

  static std::int64_t number(const Token& token) {
    std::string_view digits = token.text;
    while (!digits.empty() && std::string_view("uUlL").find(digits.back()) != std::string_view::npos)
      digits.remove_suffix(1);
    int base = 10;
    if (digits.starts_with("0x") || digits.starts_with("0X")) {
      base = 16;
      digits.remove_prefix(2);
    } else if (digits.size() > 1 && digits[0] == '0') {
      base = 8;
    }
    std::int64_t value = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value, base);
    if (error != std::errc() || end != digits.data() + digits.size())
      reject(token.place, "expected an integer of 64 bits, found '" + token.text + "'");
    return value;
  }

  TokenStream& tokens_;
  const NameValue& value_of_;
};

}  // namespace

std::int64_t constant_expression(TokenStream& tokens, const NameValue& value_of) {
  return Evaluation(tokens, value_of).conditional(0);
}

}  // namespace waitpoint::description
