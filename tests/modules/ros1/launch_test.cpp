// SPDX-License-Identifier: BSD-3-Clause
// Names, conditions and words of nodes.
#include <gtest/gtest.h>

#include "modules/ros1/graph_name.hpp"
#include "modules/ros1/launch.hpp"
#include "modules/ros1/words_of_text.hpp"
#include "tests/modules/scenario/scenario_text.hpp"

namespace waitpoint::ros1 {
namespace {

TEST(GraphName, ConsistsOfWordsAndSlashes) {
  for (const char* good : {"a", "a_1/b2", "/a/b", "/", "~a", "~/a/b", "a/1"}) EXPECT_TRUE(is_graph_name(good)) << good;
  for (const char* bad : {"", "1a", "a b", "a//b", "a/", "~", "//", "/1", "a-b", "_a", "é"})
    EXPECT_FALSE(is_graph_name(bad)) << bad;
  EXPECT_TRUE(is_base_name("Node_1"));
  for (const char* bad : {"", "a/b", "/a", "~a", "1", "_a"}) EXPECT_FALSE(is_base_name(bad)) << bad;
}

TEST(GraphName, ResolvesInItsNamespace) {
  EXPECT_EQ(resolved("scan", "/"), "/scan");
  EXPECT_EQ(resolved("scan", "/r/s"), "/r/s/scan");
  EXPECT_EQ(resolved("/scan", "/r"), "/scan");
  EXPECT_EQ(resolved("~rate", "/r", "/r/driver"), "/r/driver/rate");
  EXPECT_EQ(resolved("~/rate", "/r", "/r/driver"), "/r/driver/rate");
  EXPECT_EQ(without_extra_slashes("//a///b/"), "/a/b");
}

TEST(WordsOfText, SplitAsAShellDoes) {
  std::vector<std::string> words;
  EXPECT_TRUE(split_words(R"( a  'b c' "d \" e"f g\ h '' "\n" )", words));
  EXPECT_EQ(words, (std::vector<std::string>{"a", "b c", "d \" ef", "g h", "", "\\n"}));
  words.clear();
  EXPECT_TRUE(split_words(" \n", words));
  EXPECT_TRUE(words.empty());
  for (const char* bad : {"'a", "\"a", "a\\"}) EXPECT_FALSE(split_words(bad, words)) << bad;
}

TEST(NodeCondition, NamesNodesTopicsServicesAndPorts) {
  StartCondition condition;
  ASSERT_TRUE(parse("topic:scan", "/r", condition));
  EXPECT_EQ(condition.of, "/r/scan");
  EXPECT_EQ(condition.kind, StartCondition::Kind::topic);
  ASSERT_TRUE(parse("service:/static_map", "/r", condition));
  EXPECT_EQ(condition.of, "/static_map");
  EXPECT_EQ(condition.kind, StartCondition::Kind::service);
  ASSERT_TRUE(parse("driver.started", "/r", condition));
  EXPECT_EQ(condition.of, "driver");
  EXPECT_EQ(condition.kind, StartCondition::Kind::start);
  ASSERT_TRUE(parse("tcp:11311", "/", condition));
  EXPECT_EQ(condition.port, 11311);
  for (const char* bad : {"topic:", "topic:/", "topic:a b", "service:~x", "tcp:0", ""})
    EXPECT_FALSE(parse(bad, "/", condition)) << bad;
}

Node node(const std::string& ns, const std::string& name, int line, const std::vector<std::string>& after = {}) {
  Node result;
  result.name = name;
  result.ns = ns;
  result.written = {"s.yaml", line};
  for (const std::string& text : after) EXPECT_TRUE(parse(text, ns, result.after.emplace_back()));
  return result;
}

TEST(LaunchConditions, PreferNodesOfTheirOwnNamespace) {
  Launch launch;
  launch.add(node("/a", "map", 1));
  launch.add(node("/b", "map", 2));
  launch.add(node("/", "only", 3));
  launch.add(node("/b", "user", 4, {"map.started", "only", "topic:x"}));
  settle_conditions(launch);
  EXPECT_EQ(launch.nodes[3].after[0].of, "/b/map");
  EXPECT_EQ(launch.nodes[3].after[1].of, "/only");
  Launch apart;
  apart.add(node("/a", "map", 1));
  apart.add(node("/b", "map", 2));
  apart.add(node("/c", "other", 5, {"map"}));
  EXPECT_EQ(scenario::message_of<BadInput>([&] { settle_conditions(apart); }),
            "s.yaml:5: after: there are several nodes 'map', but none in the namespace /c");
}

TEST(LaunchConditions, RefuseUnknownNodesAndCycles) {
  Launch unknown;
  unknown.add(node("/", "driver", 1));
  unknown.add(node("/", "a", 2, {"drivre"}));
  EXPECT_EQ(scenario::message_of<BadInput>([&] { settle_conditions(unknown); }),
            "s.yaml:2: after: the robot has no node 'drivre', did you mean 'driver'?");
  Launch cycle;
  cycle.add(node("/", "a", 1, {"b"}));
  cycle.add(node("/", "b", 2, {"a.started"}));
  EXPECT_EQ(scenario::message_of<BadInput>([&] { settle_conditions(cycle); }),
            "s.yaml:1: 'a' can never start: the conditions in after form a cycle");
}

}  // namespace
}  // namespace waitpoint::ros1
