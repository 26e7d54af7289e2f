// SPDX-License-Identifier: BSD-3-Clause
#include "modules/nodes/node_processes.hpp"

#include <gtest/gtest.h>

#include <set>
#include <thread>

#include "tests/project.hpp"

namespace waitpoint::nodes {
namespace {

class FakeMaster final : public MasterSide {
 public:
  std::set<std::string> topics, nodes;

  std::string master_address() const override { return "http://127.0.0.1:1/"; }
  bool is_published(const std::string& topic) const override { return topics.contains(topic); }
  bool is_served(const std::string&) const override { return false; }
  bool is_registered(const std::string& node) const override { return nodes.contains(node); }
};

NodeCommand node(const std::string& name, const std::string& script) {
  NodeCommand command;
  command.node.name = name;
  command.words = {"sh", "-c", script};
  return command;
}

StartCondition condition(const std::string& text) {
  StartCondition condition;
  EXPECT_TRUE(ros1::parse(text, "/", condition)) << text;
  return condition;
}

/// News as "/name: text", until there are `count`.
std::vector<std::string> news_of(NodeProcesses& processes, std::size_t count, Time now = {}) {
  std::vector<std::string> all;
  constexpr int rounds_most = 10'000;
  for (int round = 0; all.size() < count && round < rounds_most; ++round) {
    processes.go_on(now);
    for (const NodeNews& news : processes.take_news()) all.push_back(news.node + ": " + news.text);
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return all;
}

TEST(NodeProcesses, AreToldOfTheirEnds) {
  FakeMaster master;
  NodeProcesses processes({node("good", "exit 0")}, master);
  EXPECT_EQ(news_of(processes, 1), std::vector<std::string>{"/good: ended with status 0"});
  EXPECT_FALSE(processes.is_over());
  NodeProcesses killed({node("bad", "kill -9 $$")}, master);
  EXPECT_EQ(news_of(killed, 1), std::vector<std::string>{"/bad: ended by signal 9 (Killed)"});
}

TEST(NodeProcesses, EndTheRunWithARequiredOne) {
  FakeMaster master;
  NodeCommand command = node("needed", "exit 7");
  command.node.required = true;
  NodeProcesses processes({command}, master);
  EXPECT_EQ(news_of(processes, 1), std::vector<std::string>{"/needed: ended with status 7"});
  EXPECT_TRUE(processes.is_over());
}

TEST(NodeProcesses, EndTheRunWhenAllTestsHaveEnded) {
  FakeMaster master;
  NodeCommand good = node("good", "exit 0"), bad = node("bad", "exit 3"), slow = node("slow", "sleep 100");
  good.time_limit = bad.time_limit = slow.time_limit = Duration::from_seconds(1);
  NodeProcesses processes({good, bad, node("server", "sleep 100")}, master, NodeEnds::killed);
  EXPECT_EQ(processes.unmet_tests(std::nullopt).size(), 2U);
  news_of(processes, 2);
  EXPECT_TRUE(processes.is_over());
  EXPECT_EQ(processes.unmet_tests(std::nullopt), std::vector<std::string>{"test /bad ended with status 3"});

  NodeProcesses late({slow}, master, NodeEnds::killed);
  late.go_on(Time());
  EXPECT_TRUE(late.unmet_tests(Time()).empty());
  EXPECT_EQ(late.unmet_tests(Time() + Duration::from_seconds(2)), std::vector<std::string>{"test /slow has not ended"});
}

TEST(NodeProcesses, WaitForTheirConditions) {
  FakeMaster master;
  NodeCommand late = node("late", "exit 1"), last = node("last", "exit 2");
  late.node.after = {condition("topic:/map")};
  last.node.after = {StartCondition{.kind = StartCondition::Kind::end, .of = "/late"}};
  NodeProcesses processes({last, late}, master);
  processes.go_on({});
  EXPECT_TRUE(processes.take_news().empty());
  master.topics.insert("/map");
  const std::vector<std::string> expected = {"/late: ended with status 1", "/last: ended with status 2"};
  EXPECT_EQ(news_of(processes, 2), expected);
}

TEST(NodeProcesses, KnowTheMasterAndTheirNames) {
  FakeMaster master;
  NodeCommand command =
      node("n", "[ $ROS_MASTER_URI = http://127.0.0.1:1/ ] && [ \"$0\" = a:=b ] && [ $1 = __name:=n ] && exit 3");
  command.node.remappings = {{"a", "b"}};
  NodeProcesses processes({command}, master);
  EXPECT_EQ(news_of(processes, 1), std::vector<std::string>{"/n: ended with status 3"});
}

TEST(NodeProcesses, AreMissedIfTheyDoNotRegister) {
  FakeMaster master;
  NodeProcesses processes({node("slow", "exec sleep 1000"), node("known", "exec sleep 1000")}, master);
  master.nodes.insert("/known");
  processes.go_on({});
  processes.go_on(Time() + Duration(std::chrono::seconds(9)));
  EXPECT_TRUE(processes.take_news().empty());
  processes.go_on(Time() + Duration(std::chrono::seconds(10)));
  const std::vector<NodeNews> news = processes.take_news();
  ASSERT_EQ(news.size(), 1U);
  EXPECT_EQ(news.front().node, "/slow");
  EXPECT_EQ(news.front().text, "has not registered with the master in 10 s");
}

TEST(NodeProcesses, MissingProgramsAreFaults) {
  // qemu's vfork() is a fork(): the parent does not learn what exec() answers, but the status 127.
  if (test::is_emulated()) GTEST_SKIP() << "posix_spawn() of an emulator does not report errors";
  FakeMaster master;
  NodeCommand command = node("missing", "");
  command.words = {"/nowhere/node"};
  NodeProcesses processes({command}, master);
  EXPECT_EQ(news_of(processes, 1),
            std::vector<std::string>{"/missing: cannot be started: /nowhere/node: No such file or directory"});
}

}  // namespace
}  // namespace waitpoint::nodes
