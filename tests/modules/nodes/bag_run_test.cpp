// SPDX-License-Identifier: BSD-3-Clause
#include "modules/nodes/bag_run.hpp"

#include <gtest/gtest.h>

namespace waitpoint::nodes {
namespace {

using namespace std::chrono_literals;
using End = BagResult::End;

/// A bag with a message each second, and nodes that answer each with one, or for ever.
class FakeBag final : public BagSide {
 public:
  FakeBag(std::vector<std::string>& log, bool is_chatty) : log_(log), is_chatty_(is_chatty) {}

  std::string master_address() const override { return "http://127.0.0.1:1/"; }
  bool is_published(const std::string&) const override { return false; }
  bool is_served(const std::string&) const override { return false; }
  bool is_registered(const std::string&) const override { return true; }

  std::optional<std::int64_t> next_ns() override {
    constexpr std::int64_t second = 1'000'000'000;
    return next_ < 3 ? std::optional(next_ * second) : std::nullopt;
  }
  void play_next() override {
    log_.push_back("message");
    ++next_;
    heard_.push_back({"/answer", "std_msgs/Empty", "/node", ""});
  }
  void play_latched() override { log_.emplace_back("latched"); }
  void show_clock(std::int64_t time_ns) override { log_.push_back(std::to_string(time_ns / 1'000'000)); }
  std::vector<HeardMessage> hear() override {
    if (is_chatty_) heard_.push_back({"/tf", "tf2_msgs/TFMessage", "/node", ""});
    return std::exchange(heard_, {});
  }
  std::vector<TopicCount> played() const override { return {{"/scan", static_cast<std::uint64_t>(next_)}}; }

 private:
  std::vector<std::string>& log_;
  bool is_chatty_;
  std::int64_t next_ = 0;
  std::vector<HeardMessage> heard_;
};

struct Played {
  scenario::PlayScenario play;
  bool has_clock = false, is_chatty = false;
  std::string script = "exec sleep 1000";
  std::vector<std::string> log;

  BagResult run(Duration limit = 1000s) {
    NodeCommand command;
    command.node.name = "node";
    command.words = {"sh", "-c", script};
    const BagRun::Surroundings surroundings{.wait_until = [](Time) { return true; },
                                            .tell = [](Time, const NodeNews&) {}};
    return BagRun(play, has_clock, std::make_unique<FakeBag>(log, is_chatty), {command}, surroundings)
        .run(Time() + limit);
  }
};

TEST(BagRun, EndsWhenNodesAreIdle) {
  Played played;
  const BagResult result = played.run();
  EXPECT_EQ(result.end, End::idle);
  EXPECT_TRUE(result.is_played);
  EXPECT_EQ(result.played, Duration(2s));
  EXPECT_EQ(result.heard.at("/answer").messages, 3);
  EXPECT_EQ(played.log, (std::vector<std::string>{"latched", "message", "message", "message"}));
  EXPECT_GE(result.simulated, Duration(4s));
  EXPECT_LT(result.simulated, Duration(5s));
}

TEST(BagRun, EndsSomeTimeAfterTheBagThoughNodesPublish) {
  Played played;
  played.play.end_most = 3s;
  played.is_chatty = true;
  const BagResult result = played.run();
  EXPECT_EQ(result.end, End::latest);
  EXPECT_GE(result.simulated, Duration(6s));
  EXPECT_LT(result.simulated, Duration(7s));
}

TEST(BagRun, EndsAtItsLimit) {
  const BagResult result = Played{}.run(2500ms);
  EXPECT_EQ(result.end, End::limit);
  EXPECT_FALSE(result.is_played);
  EXPECT_EQ(result.topics.front().messages, 2);
}

TEST(BagRun, ShowsTheBagsTimeAtTheRate) {
  Played played;
  played.play.rate = 2;
  played.play.clock_hz = 1;
  played.has_clock = true;
  played.run();
  const std::vector<std::string> first = {"latched", "0", "message", "1000", "message", "2000", "message", "3000"};
  ASSERT_GE(played.log.size(), first.size());
  EXPECT_TRUE(std::equal(first.begin(), first.end(), played.log.begin()));
}

TEST(BagRun, CountsNodesThatFail) {
  Played played;
  played.script = "exit 3";
  // In a virtual time that waits for nobody, the node ends long after the bag.
  played.play.end_most = played.play.idle = 1'000'000s;
  const BagResult result = played.run(2'000'000s);
  EXPECT_EQ(result.end, End::nodes_ended);
  EXPECT_EQ(result.faults, 1);
}

}  // namespace
}  // namespace waitpoint::nodes
