// SPDX-License-Identifier: BSD-3-Clause
// Recordings with topics, made here byte by byte: MCAP of ROS 2 and ROS bags.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "core/error.hpp"
#include "modules/logs/log_file.hpp"
#include "modules/logs/playing_order.hpp"

namespace waitpoint::logs {
namespace {

constexpr double quarter = exact::pi / 2;
constexpr float no_number = std::numeric_limits<float>::quiet_NaN(), infinite = std::numeric_limits<float>::infinity();

template <class Number>
std::string raw(Number number) {
  return {reinterpret_cast<const char*>(&number), sizeof number};
}

std::string text(const std::string& of) { return raw(static_cast<std::uint32_t>(of.size())) + of; }

/// A message of ROS 1, or in CDR with its head and padding.
class Message {
 public:
  explicit Message(bool is_cdr) : is_cdr_(is_cdr) {}

  template <class Number>
  Message& add(Number number) {
    while (is_cdr_ && bytes_.size() % sizeof number != 0) bytes_ += '\0';
    bytes_ += raw(number);
    return *this;
  }
  Message& add(const std::string& of) {
    add(static_cast<std::uint32_t>(of.size() + (is_cdr_ ? 1 : 0)));
    bytes_ += of;
    if (is_cdr_) bytes_ += '\0';
    return *this;
  }
  Message& header(double stamp_s, const std::string& frame) {
    if (!is_cdr_) add(std::uint32_t{7});
    add(static_cast<std::uint32_t>(stamp_s));
    add(static_cast<std::uint32_t>(std::llround((stamp_s - std::floor(stamp_s)) * 1e9)));
    return add(frame);
  }
  /// At (x, 0), turned about z, or about x too: upside down.
  Message& place(double x, double heading, bool is_upside_down = false) {
    for (const double value : {x, 0.0, 0.3}) add(value);
    const auto [s, c] = exact::sincos(heading / 2);
    const Quaternion turn = is_upside_down ? Quaternion{c, s, 0, 0} : Quaternion{0, 0, s, c};
    for (const double value : {turn.x, turn.y, turn.z, turn.w}) add(value);
    return *this;
  }
  std::string bytes() const { return (is_cdr_ ? std::string("\0\1\0\0", 4) : "") + bytes_; }

 private:
  struct Quaternion {
    double x, y, z, w;
  };
  bool is_cdr_;
  std::string bytes_;
};

std::string scan(bool is_cdr, double stamp_s, float first, float step, const std::vector<float>& ranges) {
  Message message(is_cdr);
  message.header(stamp_s, "laser").add(first).add(first).add(step).add(0.0f).add(0.0f).add(0.1f).add(30.0f);
  message.add(static_cast<std::uint32_t>(ranges.size()));
  for (const float range : ranges) message.add(range);
  return message.add(std::uint32_t{0}).bytes();
}

std::string odometry(bool is_cdr, double stamp_s, double x) {
  Message message(is_cdr);
  message.header(stamp_s, "odom").add(std::string("base")).place(x, quarter);
  for (int i = 0; i < 36 + 6 + 36; ++i) message.add(0.0);  // covariances, velocities
  return message.bytes();
}

/// One transform, from its parent to its child.
std::string frame(bool is_cdr, const char* parent, const char* child, double x, double heading, bool upside_down) {
  Message message(is_cdr);
  message.add(std::uint32_t{1}).header(1, parent).add(std::string(child)).place(x, heading, upside_down);
  return message.bytes();
}

class Mcap {
 public:
  Mcap() : bytes_("\x89MCAP0\r\n") { record(1, text("ros2") + text("")); }
  std::uint16_t channel(const std::string& topic, const std::string& type, const char* encoding = "cdr") {
    const std::uint16_t number = ++channels_;
    record(3, raw(number) + text(type) + text("ros2msg") + text(""));
    record(4, raw(number) + raw(number) + text(topic) + text(encoding) + text(""));
    return number;
  }
  void message(std::uint16_t channel, const std::string& of, std::uint64_t received_ns = 0) {
    record(5, raw(channel) + raw(std::uint32_t{0}) + raw(received_ns) + raw(std::uint64_t{0}) + of);
  }
  std::string bytes() { return bytes_ + '\x0f' + raw(std::uint64_t{4}) + raw(std::uint32_t{0}); }

 private:
  void record(char operation, const std::string& of) {
    bytes_ += operation + raw(static_cast<std::uint64_t>(of.size())) + of;
  }
  std::string bytes_;
  std::uint16_t channels_ = 0;
};

std::string field(const std::string& name, const std::string& value) { return text(name + "=" + value); }
std::string record(const std::string& header, const std::string& data) { return text(header) + text(data); }
std::string connection(std::uint32_t number, const std::string& topic, const std::string& type) {
  return record(field("op", "\7") + field("conn", raw(number)) + field("topic", topic), field("type", type));
}
std::string message(std::uint32_t number, const std::string& of, std::uint32_t received_s = 0) {
  return record(field("op", "\2") + field("conn", raw(number)) + field("time", raw(std::uint64_t{received_s})), of);
}
std::string bag(const std::string& chunk, const std::string& compression = "none") {
  return "#ROSBAG V2.0\n" + record(field("op", "\3"), std::string(100, ' ')) +
         record(field("op", "\5") + field("compression", compression), chunk);
}

Mcap small_mcap(bool upside_down = false) {
  Mcap mcap;
  const auto scans = mcap.channel("/scan", "sensor_msgs/msg/LaserScan");
  const auto odometries = mcap.channel("/odom", "nav_msgs/msg/Odometry"),
             frames = mcap.channel("/tf", "tf2_msgs/msg/TFMessage");
  mcap.message(frames, frame(true, "base", "plate", 0.25, 0, false));
  mcap.message(frames, frame(true, "plate", "laser", 0.5, upside_down ? 0 : quarter, upside_down));
  mcap.message(odometries, odometry(true, 10.5, 2));
  mcap.message(scans, scan(true, 10.75, -1, 0.5, {1, 2, no_number, infinite, 0.01f}));
  return mcap;
}

std::string error(const std::string& bytes, const LogChoice& choice = {}) {
  try {
    parse_log("a", bytes, choice);
  } catch (const BadInput& error) {
    return error.what();
  }
  return "";
}

TEST(TopicLog, McapOfRos2HasScansOdometryAndTheLasersPoseByTheFrames) {
  const SensorLog log = parse_log("a", small_mcap().bytes(), {});
  ASSERT_EQ(log.scans.size(), 1u);
  EXPECT_EQ(log.scans[0].stamp.ns(), 10'750000000);
  EXPECT_EQ(log.scans[0].range_m, (std::vector<float>{1, 2, 30, 30, 30}));
  EXPECT_EQ(log.scans[0].first_angle_rad, -1);
  EXPECT_EQ(log.scans[0].angle_step_rad, 0.5);
  EXPECT_EQ(log.scans[0].range_max_m, 30);
  ASSERT_EQ(log.odometry.size(), 1u);
  EXPECT_EQ(log.odometry[0].pose.x, 2);
  EXPECT_NEAR(log.odometry[0].pose.heading, quarter, 1e-12);
  EXPECT_NEAR(log.mount.x, 0.75, 1e-12);
  EXPECT_NEAR(log.mount.heading, quarter, 1e-12);
}

TEST(TopicLog, ALaserUpsideDownHasItsBeamsInTheOtherOrder) {
  const SensorLog log = parse_log("a", small_mcap(true).bytes(), {});
  EXPECT_EQ(log.scans[0].range_m, (std::vector<float>{30, 30, 30, 2, 1}));
  EXPECT_EQ(log.scans[0].first_angle_rad, -1);
  EXPECT_EQ(log.scans[0].angle_step_rad, 0.5);
  EXPECT_NEAR(log.mount.x, 0.75, 1e-12);
}

TEST(TopicLog, ABagHasTheSameMessagesInRos1) {
  const std::string chunk = connection(0, "/scan", "sensor_msgs/LaserScan") +
                            message(0, scan(false, 10.75, 1, -0.5, {1, 2, 3})) +
                            connection(1, "/odom", "nav_msgs/Odometry") + message(1, odometry(false, 10.5, 2)) +
                            connection(2, "/chatter", "std_msgs/String") + message(2, text("hello"));
  const SensorLog log = parse_log("a", bag(chunk), {});
  EXPECT_EQ(log.format, "ROS bag");
  EXPECT_EQ(log.scans.at(0).range_m, (std::vector<float>{3, 2, 1}));
  EXPECT_EQ(log.scans[0].first_angle_rad, 0);
  EXPECT_EQ(log.odometry.at(0).pose.x, 2);
  EXPECT_EQ(log.mount, Pose());
  EXPECT_EQ(log.left_out.at("/chatter"), 1u);
}

TEST(TopicLog, MessagesAreInTheOrderInWhichTheRecorderGotThem) {
  const auto is_in_order = [](const std::string& bytes) {
    const SensorLog log = parse_log("a", bytes, {});
    const PlayingOrder order = playing_order(log);
    return order.late == 0 && order.records.size() == 3 && log.scans.at(0).range_m.at(0) == 2 &&
           order.records[0].scan == 1u && order.records[2].scan == 0u;
  };
  EXPECT_TRUE(is_in_order(bag(connection(0, "scan", "sensor_msgs/LaserScan") +
                              message(0, scan(false, 12, 0, 1, {2}), 12) + message(0, scan(false, 10, 0, 1, {1}), 10) +
                              connection(1, "/odom", "nav_msgs/Odometry") + message(1, odometry(false, 11, 2), 11))));
  Mcap mcap;
  const auto scans = mcap.channel("/scan", "sensor_msgs/msg/LaserScan");
  mcap.message(scans, scan(true, 12, 0, 1, {2}), 12);
  mcap.message(scans, scan(true, 10, 0, 1, {1}), 10);
  mcap.message(mcap.channel("/odom", "nav_msgs/msg/Odometry"), odometry(true, 11, 2), 11);
  EXPECT_TRUE(is_in_order(mcap.bytes()));
}

TEST(TopicLog, ATopicOfABagWithoutASlashIsGlobal) {
  const std::string chunk = connection(0, "scan", "sensor_msgs/LaserScan") + message(0, scan(false, 1, 0, 1, {1})) +
                            connection(1, "odom", "nav_msgs/Odometry") + message(1, odometry(false, 1, 2));
  EXPECT_EQ(parse_log("a", bag(chunk), {.scan = "/scan"}).laser, "/scan");
}

TEST(TopicLog, WithoutOdometryTheFramesOfOdomAreTaken) {
  const std::string chunk = connection(0, "/scan", "sensor_msgs/LaserScan") + message(0, scan(false, 1, 0, 1, {1})) +
                            connection(1, "/tf", "tf/tfMessage") +
                            message(1, frame(false, "/odom", "/base", 3, 0, false)) +
                            message(1, frame(false, "/base", "/laser", 0.1, 0, false));
  const SensorLog log = parse_log("a", bag(chunk), {});
  EXPECT_EQ(log.odometry.at(0).pose.x, 3);
  EXPECT_NEAR(log.mount.x, 0.1, 1e-12);
}

TEST(TopicLog, AmongSeveralTopicsOneMustBeChosen) {
  Mcap mcap = small_mcap();
  mcap.message(mcap.channel("/rear", "sensor_msgs/msg/LaserScan"), scan(true, 11, 0, 1, {9}));
  EXPECT_EQ(error(mcap.bytes()), "--scan: expected one of the log's topics: '/rear', '/scan'");
  EXPECT_EQ(parse_log("a", mcap.bytes(), {.scan = "/rear"}).scans.at(0).range_m.at(0), 9);
  EXPECT_EQ(error(mcap.bytes(), {.scan = "/reer"}),
            "--scan: expected one of the log's topics: '/rear', '/scan'; found '/reer', did you mean '/rear'?");
  EXPECT_EQ(error(Mcap().bytes()), "a: expected a recording with scans (LaserScan), found none");
}

TEST(TopicLog, ANumberBeyondItsLimitIsToldWithItsMessage) {
  const auto with_scan = [](float first, float step) {
    Mcap mcap = small_mcap();
    mcap.message(mcap.channel("/rear", "sensor_msgs/msg/LaserScan"), scan(true, 11, 0, 1, {9}));
    mcap.message(mcap.channel("/rear", "sensor_msgs/msg/LaserScan"), scan(true, 11, first, step, {9, 8, 7}));
    return error(mcap.bytes());
  };
  EXPECT_EQ(with_scan(1e8f, 1), "a: message 2 of '/rear': expected a beam's angle within +-25, found 1e+08");
  EXPECT_EQ(
      with_scan(0, 5),
      "a: message 2 of '/rear': expected the beams of a scan over at most a turn, found 3 beams, one every 5 rad");
  Mcap mcap = small_mcap();
  mcap.message(mcap.channel("/odom", "nav_msgs/msg/Odometry"), odometry(true, 11, 1e11));
  EXPECT_EQ(error(mcap.bytes()), "a: message 2 of '/odom': expected a coordinate within +-1000000, found 1e+11");
}

TEST(TopicLog, ARangeBeyondTheLimitIsNoEcho) {
  Mcap mcap;
  mcap.message(mcap.channel("/odom", "nav_msgs/msg/Odometry"), odometry(true, 10.5, 2));
  mcap.message(mcap.channel("/scan", "sensor_msgs/msg/LaserScan"), scan(true, 11, 0, 1, {2, 1e30f, -1e30f}));
  EXPECT_EQ(parse_log("a", mcap.bytes(), {}).scans.front().range_m, (std::vector<float>{2, 30, 30}));
}

TEST(TopicLog, DamagedFilesAreToldInOneLine) {
  const std::string whole = small_mcap().bytes();
  for (std::size_t size = 13; size < whole.size(); size += 7) {
    const std::string told = error(whole.substr(0, size));
    EXPECT_TRUE(told.starts_with("a: ") && told.find("expected ") != told.npos) << size << told;
  }
  const std::string of_bag = bag(connection(0, "/scan", "sensor_msgs/LaserScan"));
  for (std::size_t size = 14; size < of_bag.size(); size += 7)
    EXPECT_EQ(error(of_bag.substr(0, size)).substr(0, 12), "a: expected ") << size;
  EXPECT_EQ(error("#ROSBAG V1.2\n"), "a: expected a ROS bag of version 2.0");
  EXPECT_EQ(error(bag("", "zip")), "a: has chunks compressed by 'zip', expected bz2, lz4 or zstd");
}

}  // namespace
}  // namespace waitpoint::logs
