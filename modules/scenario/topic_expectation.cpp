// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "core/number_text.hpp"
#include "modules/scenario/scenario.hpp"

namespace waitpoint::scenario {

bool parse(const std::string& text, TopicExpectation& expectation) {
  std::string plain = text;
  std::erase(plain, ' ');
  constexpr std::pair<const char*, TopicExpectation::Relation> relations[] = {
      {">=", TopicExpectation::Relation::at_least},
      {"<=", TopicExpectation::Relation::at_most},
      {"==", TopicExpectation::Relation::equal}};
  for (const auto& [sign, relation] : relations) {
    const std::size_t at = plain.find(sign);
    if (at == std::string::npos) continue;
    const std::size_t dot = std::min(at, plain.find('.'));
    expectation = {plain.substr(0, dot), dot == at ? "data" : plain.substr(dot + 1, at - dot - 1), relation, 0, text};
    return dot > 1 && plain.front() == '/' && !expectation.field.empty() &&
           parse_number(std::string_view(plain).substr(at + 2), expectation.limit);
  }
  return false;
}

std::string topic_expectation_words(const std::string& text) {
  return "expected /TOPIC>=NUMBER or /TOPIC.FIELD<=NUMBER (>=, <= or ==), found '" + text + "'";
}

}  // namespace waitpoint::scenario
