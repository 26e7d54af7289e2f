// SPDX-License-Identifier: BSD-3-Clause
#include "modules/scenario/expectation_reader.hpp"

#include <algorithm>

#include "core/number_text.hpp"

namespace waitpoint::scenario {
namespace {

constexpr std::uint64_t count_max = 1'000'000'000;
constexpr std::string_view plan_words[] = {"any", "completed"}, test_words[] = {"any", "passed"};

void read_goals_reached(const YamlNode& node, Expectation& expect) {
  expect.all_goals_reached = node.kind == YamlNode::Kind::scalar && node.text == "all";
  if (expect.all_goals_reached) return;
  if (node.kind != YamlNode::Kind::scalar || node.text.find_first_not_of("0123456789") != std::string::npos)
    throw node.written.bad("expected goals_reached to be 'all' or a number, found " + described(node));
  expect.goals_reached = read_count(node, "goals_reached", 0, count_max);
}

Json goals_reached_schema(SchemaDefinitions&) { return any_of({{{"const", "all"}}, count_schema({0, count_max})}); }

Form<TopicExpectation> topic_form() {
  return {[](const YamlNode& node, std::string_view, TopicExpectation& topic) {
            const std::string text = read_lines(node, "the value of a topic");
            if (!parse(text, topic)) throw node.written.bad(topic_expectation_words(text));
          },
          [](SchemaDefinitions&) {
            return Json{{"type", "string"}, {"pattern", "^ */ *[^. ].*(>=|<=|==)"}};
          }};
}

}  // namespace

const Keys<Expectation>& expectation_table() {
  using Expect = Expectation;
  const Form<std::optional<std::uint64_t>> count = optional_form(count_form<std::uint64_t>({0, count_max}));
  static const Keys<Expect> keys =
      Keys<Expect>("expectations")
          .add("goals_reached", read_goals_reached, goals_reached_schema, "`all`, or the number over all robots")
          .add("collisions", &Expect::collisions, count, "the number over all robots")
          .add("position_error_max_m", &Expect::position_error_max_m,
               optional_form(number_form(ranges::number_from_zero)), "bound of every robot's own position")
          .add("plans", &Expect::plans_completed, word_form<bool>(plan_words), "every robot's temporal plan")
          .add("node_failures", &Expect::node_failures, count,
               "nodes of ROS that may end by a signal, or with another status than 0")
          .add("service_call_max_s", &Expect::service_call_max_s, optional_form(number_form(ranges::positive_number)),
               "bound of the calls of services of ROS")
          .add("topics", &Expect::topics, list_form(topic_form(), "the value of a topic"),
               "bounds of numbers in messages of ROS: `/TOPIC.FIELD<=NUMBER`")
          .add("tests", &Expect::tests_passed, word_form<bool>(test_words), "all tests of launch files");
  return keys;
}

std::span<const std::string_view> expectation_keys() { return expectation_table().table().names(); }

Expectation read_expectation(const YamlNode& node) {
  Expectation expect;
  read_object(node, "expect", expectation_table(), expect);
  return expect;
}

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
