// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/explore/schedules/token.hpp"

#include <array>
#include <charconv>
#include <string_view>

#include "core/error.hpp"
#include "core/number_text.hpp"
#include "fibers/explore/strategies/factory.hpp"

namespace waitpoint::exploration {
namespace {

constexpr std::string_view version = "wx1";
constexpr std::size_t digest_digits = 8;
constexpr char before_trail = '-', weak = 'w';

[[noreturn]] void refuse(const std::string& text, const std::string& expected) {
  throw BadInput("replay", "expected " + expected + " in the token '" + text + "'");
}

// Splits off the part before `end`, and `end`; everything if there is none.
std::string_view take(std::string_view& rest, char end) {
  const std::size_t at = rest.find(end);
  const std::string_view part = rest.substr(0, at);
  rest = at == std::string_view::npos ? std::string_view() : rest.substr(at + 1);
  return part;
}

template <class Number>
Number take_number(std::string_view part, const std::string& text, const char* what) {
  Number number = 0;
  if (!parse_number(part, number))
    refuse(text, std::string(what) + ", a whole number, not '" + std::string(part) + "',");
  return number;
}

std::uint32_t take_digest(std::string_view part, const std::string& text) {
  std::uint32_t digest = 0;
  const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), digest, 16);
  if (part.size() != digest_digits || error != std::errc() || end != part.data() + part.size())
    refuse(text, "eight hexadecimal digits of a digest, not '" + std::string(part) + "',");
  return digest;
}

}  // namespace

std::string digest_text(std::uint32_t digest) {
  std::array<char, digest_digits> digits{};
  const auto [end, error] = std::to_chars(digits.begin(), digits.end(), digest, 16);
  const auto count = static_cast<std::size_t>(end - digits.begin());
  return std::string(digest_digits - count, '0') + std::string(digits.data(), count);
}

bool is_token(const std::string& text) { return text.starts_with("wx") && text.find('/') == std::string::npos; }

std::string to_text(const Token& token) {
  std::string text(version);
  text += "." + std::to_string(token.call);
  if (token.memory == Memory::weak) text += weak;
  text += "." + digest_text(token.digest);
  if (const std::string trail = to_text(token.trail); !trail.empty()) text += before_trail + trail;
  text += ".";
  if (!token.strategy.empty())
    return text + token.strategy + "." + std::to_string(token.seed) + "." + std::to_string(token.number);
  text += "=";
  for (const Deviation& deviation : token.deviations) {
    if (text.back() != '=') text += ",";
    text += std::to_string(deviation.decision) + "-" + std::to_string(deviation.chosen);
  }
  return text;
}

std::string to_text_with(Token token, const Trail& trail) {
  token.trail = trail;
  if (std::string text = to_text(token); text.size() <= token_length_max) return text;
  token.trail = {};
  return to_text(token);
}

Token read_token(const std::string& text) {
  std::string_view rest = text;
  if (const std::string_view first = take(rest, '.'); first != version)
    refuse(text, "the version " + std::string(version) + ", not '" + std::string(first) + "',");
  Token token;
  std::string_view call = take(rest, '.');
  if (call.ends_with(weak)) {
    token.memory = Memory::weak;
    call.remove_suffix(1);
  }
  token.call = take_number<std::uint32_t>(call, text, "the number of the call of explore()");
  std::string_view end = take(rest, '.');
  const bool has_trail = end.find(before_trail) != std::string_view::npos;
  token.digest = take_digest(take(end, before_trail), text);
  if (has_trail && !read_trail(end, token.trail))
    refuse(text, "letters and digits of a trail, not '" + std::string(end) + "',");
  if (rest.starts_with('=')) {
    rest.remove_prefix(1);
    while (!rest.empty()) {
      std::string_view part = take(rest, ',');
      const auto decision = take_number<std::uint32_t>(take(part, '-'), text, "the number of a choice");
      if (!token.deviations.empty() && decision <= token.deviations.back().decision)
        refuse(text, "numbers of choices that ascend");
      token.deviations.push_back({decision, take_number<std::uint32_t>(part, text, "the number of an alternative")});
    }
    return token;
  }
  token.strategy = take(rest, '.');
  (void)make_strategy(token.strategy);  // BadInput if it is unknown
  token.seed = take_number<std::uint64_t>(take(rest, '.'), text, "a seed");
  token.number = take_number<std::uint64_t>(rest, text, "the number of a schedule");
  return token;
}

}  // namespace waitpoint::exploration
