// SPDX-License-Identifier: BSD-3-Clause
#include "modules/logs/carmen_log.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "core/error.hpp"
#include "core/exact_math.hpp"
#include "core/nearest_name.hpp"
#include "core/number_text.hpp"
#include "core/printable_line.hpp"
#include "modules/logs/limits.hpp"
#include "modules/logs/stamp.hpp"

namespace waitpoint::logs {
namespace {

constexpr std::size_t beams_max = 100'000;
constexpr double no_echo_m = 80;  // a SICK's codes for no echo are greater: 81.83 to 81.91 m
// Poses of records have six decimals, some two.
constexpr double same_m = 0.011, same_rad = 0.011;

/// Types of records with scans, the first that a log has being its default.
constexpr std::array<std::string_view, 8> scan_types = {"ROBOTLASER1", "FLASER",      "RAWLASER1", "LASER_READING",
                                                        "RLASER",      "ROBOTLASER2", "RAWLASER2", "LASER"};

bool is_scan(std::string_view type) {
  return std::find(scan_types.begin(), scan_types.end(), type) != scan_types.end();
}

/// The words of one line, one after another.
class Words {
 public:
  Words(const std::string& file, int line, std::string_view text) : file_(file), line_(line), rest_(text) {}

  std::string_view word() {
    constexpr std::string_view spaces = " \t\r";
    rest_.remove_prefix(std::min(rest_.find_first_not_of(spaces), rest_.size()));
    const std::size_t length = std::min(rest_.find_first_of(spaces), rest_.size());
    const std::string_view word = rest_.substr(0, length);
    rest_.remove_prefix(length);
    return word;
  }
  /// One that is not computed with.
  double number(const char* what) { return number(what, std::numeric_limits<double>::infinity()); }
  double number(const char* what, double magnitude_max) {
    const std::string_view text = word();
    double number = 0;
    if (!parse_number(text, number)) reject(what, text);
    if (!(std::fabs(number) <= magnitude_max)) reject(limited_text(what, magnitude_max), text);
    return number;
  }
  Pose pose(const char* what) {
    Pose pose;
    pose.x = number(what, position_max_m);
    pose.y = number(what, position_max_m);
    pose.heading = exact::wrap_angle(number(what, heading_max_rad));
    return pose;
  }
  std::size_t count(const char* what) {
    const std::string_view text = word();
    std::size_t count = 0;
    if (!parse_number(text, count) || count > beams_max)
      reject(std::string(what) + " up to " + std::to_string(beams_max), text);
    return count;
  }
  Time stamp() {
    const std::string_view text = word();
    const std::optional<Time> stamp = parse_stamp(text);
    if (!stamp) reject("a time in seconds", text);
    return *stamp;
  }
  void check_span(const LoggedScan& scan) const {
    const std::string error = span_error(scan.range_m.size(), scan.angle_step_rad);
    if (!error.empty()) throw BadInput(file_, line_, error);
  }
  [[noreturn]] void reject(const std::string& expected, std::string_view found) const {
    const std::string shown = found.empty() ? "the end of the line" : "'" + printable_line(std::string(found)) + "'";
    throw BadInput(file_, line_, "expected " + expected + ", found " + shown);
  }

 private:
  const std::string& file_;
  int line_;
  std::string_view rest_;
};

/// A scan, with the keys to choose among lasers and hosts.
struct Record {
  LoggedScan scan;
  std::optional<Pose> laser;
  std::string_view type, host;
};

class Parser {
 public:
  Parser(const std::string& name, const LogChoice& choice) : name_(name), choice_(choice) {
    log_.format = "CARMEN";
    if (!choice.scan.empty() && !is_scan(choice.scan))
      throw BadInput(choice.scan_place, "expected a type of CARMEN's records with scans, found '" + choice.scan + "'" +
                                            did_you_mean(choice.scan, scan_types));
    if (!choice.odometry.empty()) throw BadInput(choice.odometry_place, "a log of CARMEN has no topics: expected none");
  }

  SensorLog parse(std::string_view text) {
    int line = 0;
    while (!text.empty()) {
      const std::size_t length = std::min(text.find('\n'), text.size());
      Words words(name_, ++line, text.substr(0, length));
      text.remove_prefix(std::min(length + 1, text.size()));
      take(words);
    }
    choose_scans();
    find_mount();
    return std::move(log_);
  }

 private:
  void take(Words& words);
  void take_scan(std::string_view type, Words& words);
  void take_described_scan(Record& record, bool has_poses, Words& words);
  void take_plain_scan(Record& record, bool has_two_poses, Words& words);
  void take_odometry(Words& words);
  void take_parameter(Words& words);
  void read_ranges(LoggedScan& scan, std::size_t beams, Words& words) const;
  void choose_scans();
  void find_mount();
  bool is_of_robot(std::string_view host) const { return choice_.robot.empty() || host == choice_.robot; }

  const std::string& name_;
  const LogChoice& choice_;
  SensorLog log_;
  std::vector<Record> records_;
  std::vector<Pose> mounts_;  // by scan of the chosen laser
  Pose declared_mount_;
  std::optional<double> declared_range_max_m_;
  std::uint64_t places_ = 0;
};

void Parser::take(Words& words) {
  const std::string_view type = words.word();
  if (type.empty() || type.starts_with('#')) return;
  if (type == "PARAM") return take_parameter(words);
  if (type == "ODOM") return take_odometry(words);
  if (is_scan(type)) return take_scan(type, words);
  ++log_.left_out[printable_line(std::string(type.substr(0, 40)))];
}

// Others, of programs rather than of the laser, are not needed.
void Parser::take_parameter(Words& words) {
  const std::string_view key = words.word();
  constexpr double degree = exact::pi / 180;
  if (key == "robot_frontlaser_offset") declared_mount_.x = words.number("metres", position_max_m);
  if (key == "robot_frontlaser_side_offset") declared_mount_.y = words.number("metres", position_max_m);
  if (key == "robot_frontlaser_angular_offset")
    declared_mount_.heading = exact::wrap_angle(words.number("degrees", 1440) * degree);
  if (key == "robot_front_laser_max") declared_range_max_m_ = words.number("metres", range_max_m);
}

void Parser::take_odometry(Words& words) {
  LoggedOdometry odometry;
  odometry.pose = words.pose("a number of the odometry's pose");
  const std::string_view fourth = words.word();
  const std::string_view fifth = words.word();
  std::string_view host;
  if (fifth.empty()) {  // gfs
    const std::optional<Time> stamp = parse_stamp(fourth);
    if (!stamp) words.reject("a time in seconds", fourth);
    odometry.stamp = *stamp;
  } else {
    words.number("the acceleration");
    odometry.stamp = words.stamp();
    host = words.word();
  }
  odometry.place = places_++;
  if (is_of_robot(host)) log_.odometry.push_back(odometry);
}

void Parser::read_ranges(LoggedScan& scan, std::size_t beams, Words& words) const {
  scan.range_m.reserve(beams);
  for (std::size_t i = 0; i < beams; ++i)
    scan.range_m.push_back(static_cast<float>(words.number("a range in metres", range_max_m)));
}

void Parser::take_scan(std::string_view type, Words& words) {
  Record& record = records_.emplace_back();
  record.type = type;
  record.scan.place = places_++;
  if (type.starts_with("ROBOTLASER") || type.starts_with("RAWLASER"))
    take_described_scan(record, type.starts_with("ROBOTLASER"), words);
  else
    take_plain_scan(record, type != "LASER_READING", words);
}

void Parser::take_described_scan(Record& record, bool has_poses, Words& words) {
  LoggedScan& scan = record.scan;
  words.number("the laser's type");
  scan.first_angle_rad = words.number("the start angle", beam_angle_max_rad);
  words.number("the field of view");
  scan.angle_step_rad = words.number("the angular resolution", beam_angle_max_rad);
  scan.range_max_m = words.number("the maximum range", range_max_m);
  words.number("the accuracy");
  words.number("the remission mode");
  read_ranges(scan, words.count("the number of ranges"), words);
  words.check_span(scan);
  const std::size_t remissions = words.count("the number of remissions");
  for (std::size_t i = 0; i < remissions; ++i) words.number("a remission");
  if (has_poses) {
    record.laser = words.pose("a number of the laser's pose");
    scan.odometry = words.pose("a number of the robot's pose");
    for (int i = 0; i < 5; ++i) words.number("a number after the robot's pose");
  }
  scan.stamp = words.stamp();
  record.host = words.word();
}

void Parser::take_plain_scan(Record& record, bool has_two_poses, Words& words) {
  LoggedScan& scan = record.scan;
  const std::size_t beams = words.count("the number of ranges");
  constexpr double degree = exact::pi / 180;
  scan.first_angle_rad = -exact::pi / 2;
  scan.angle_step_rad = beams <= 181 ? degree : beams <= 361 ? degree / 2 : exact::pi / static_cast<double>(beams - 1);
  scan.range_max_m = no_echo_m;
  read_ranges(scan, beams, words);
  const Pose first = words.pose("a number of the laser's pose");
  if (!has_two_poses) {
    scan.odometry = first;
    scan.stamp = words.stamp();
    return;
  }
  record.laser = first;
  scan.odometry = words.pose("a number of the odometry's pose");
  scan.stamp = words.stamp();
  record.host = words.word();
}

void Parser::choose_scans() {
  std::string_view chosen = choice_.scan;
  for (const std::string_view type : scan_types)
    if (chosen.empty() &&
        std::any_of(records_.begin(), records_.end(), [&](const Record& r) { return r.type == type; }))
      chosen = type;
  std::string_view host;
  for (Record& record : records_) {
    if (record.type != chosen) {
      ++log_.left_out[std::string(record.type)];
      continue;
    }
    if (!is_of_robot(record.host)) continue;
    if (!log_.scans.empty() && record.host != host)
      throw BadInput(choice_.robot_place, "expected a name, since the log has scans of several robots: '" +
                                              std::string(host) + "', '" + std::string(record.host) + "'");
    host = record.host;
    if (record.laser) mounts_.push_back(between(*record.scan.odometry, *record.laser));
    if (!chosen.starts_with("R") && declared_range_max_m_) record.scan.range_max_m = *declared_range_max_m_;
    log_.scans.push_back(std::move(record.scan));
  }
  if (log_.scans.empty())
    throw BadInput(name_, "expected a log of CARMEN with scans (" +
                              (chosen.empty() ? "FLASER, ROBOTLASER1, LASER_READING" : std::string(chosen)) +
                              (choice_.robot.empty() ? "" : " of '" + choice_.robot + "'") + "), found none");
  log_.laser = chosen;
  const bool has_poses =
      std::all_of(log_.scans.begin(), log_.scans.end(), [](const auto& scan) { return scan.odometry; });
  if (!has_poses && log_.odometry.empty()) throw BadInput(name_, "expected odometry (ODOM), found none");
}

// In corrected logs the first of two poses is the corrected one, not the laser's.
void Parser::find_mount() {
  log_.mount = declared_mount_;
  if (mounts_.empty()) return;
  const Pose& first = mounts_.front();
  for (const Pose& other : mounts_) {
    if (length(other.position() - first.position()) > same_m) return;
    if (std::fabs(exact::wrap_angle(other.heading - first.heading)) > same_rad) return;
  }
  if (first.position() == Point() && first.heading == 0) return;
  log_.mount = first;
}

}  // namespace

SensorLog parse_carmen_log(const std::string& name, std::string_view text, const LogChoice& choice) {
  return Parser(name, choice).parse(text);
}

}  // namespace waitpoint::logs
