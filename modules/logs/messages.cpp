// SPDX-License-Identifier: BSD-3-Clause
#include "modules/logs/messages.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <tuple>

#include "core/number_text.hpp"
#include "modules/logs/byte_reader.hpp"
#include "modules/logs/limits.hpp"

namespace waitpoint::logs {
namespace {

using Json = nlohmann::json;

constexpr std::uint32_t beams_max = 100'000, frames_max = 100'000;
constexpr float no_echo_m = std::numeric_limits<float>::infinity();

/// Of ROS 1, without padding; or CDR, whose numbers are aligned after its head of four bytes.
class MessageReader {
 public:
  MessageReader(const std::string& place, Encoding encoding, std::string_view bytes)
      : is_cdr_(encoding == Encoding::cdr), bytes_(place, is_cdr_ ? behind_head(place, bytes) : bytes) {}

  template <class Number>
  Number number() {
    if (is_cdr_) bytes_.align(sizeof(Number));
    return bytes_.number<Number>();
  }
  std::string text() {
    if (is_cdr_) bytes_.align(sizeof(std::uint32_t));
    std::string text(bytes_.text());
    if (is_cdr_ && text.ends_with('\0')) text.pop_back();
    return text;
  }
  std::uint32_t count(std::uint32_t most) {
    const auto count = number<std::uint32_t>();
    if (count > most) bytes_.reject("at most " + std::to_string(most) + " elements in a message");
    return count;
  }
  /// The header's stamp and frame.
  std::pair<Time, std::string> header() {
    if (!is_cdr_) number<std::uint32_t>();  // its sequence number
    const auto seconds = number<std::uint32_t>();
    const auto ns = number<std::uint32_t>();
    constexpr std::int64_t second = 1'000'000'000;
    return {Time::from_ns(seconds * second + ns), text()};
  }

 private:
  static std::string_view behind_head(const std::string& place, std::string_view bytes) {
    constexpr std::size_t head = 4;
    if (bytes.size() < head || bytes[0] != 0 || bytes[1] != 1)
      throw BadInput(place, "expected messages in little-endian CDR");
    return bytes.substr(head);
  }

  bool is_cdr_;
  ByteReader bytes_;
};

// Parts of a rotation, which need not have the length 1.
constexpr double rotation_max = 1e6;

double within(const std::string& place, const char* what, double magnitude_max, double value) {
  if (!(std::fabs(value) <= magnitude_max))
    throw BadInput(place, "expected " + limited_text(what, magnitude_max) + ", found " + number_text(value));
  return value;
}
double beam_angle(const std::string& place, double value) {
  return within(place, "a beam's angle", beam_angle_max_rad, value);
}
double coordinate(const std::string& place, double value) {
  return within(place, "a coordinate", position_max_m, value);
}
double rotation(const std::string& place, double value) {
  return within(place, "a part of a rotation", rotation_max, value);
}

void check_span(const std::string& place, const ScanMessage& scan) {
  const std::string error = span_error(scan.range_m.size(), scan.angle_step_rad);
  if (!error.empty()) throw BadInput(place, error);
}

/// Calls `read` with the parsed message; what is missing or of another type in it is BadInput.
template <class Read>
auto from_json(const std::string& place, std::string_view message, Read read) {
  try {
    return read(Json::parse(message));
  } catch (const Json::exception&) {
    throw BadInput(place, "expected a message of Foxglove's schemas in JSON");
  }
}

Time stamp_of(const Json& json) {
  constexpr std::int64_t second = 1'000'000'000, seconds_max = 4'000'000'000;
  const Json& stamp = json.at("timestamp");
  const auto seconds = std::clamp<std::int64_t>(stamp.at("sec").get<std::int64_t>(), -seconds_max, seconds_max);
  return Time::from_ns(seconds * second + std::clamp<std::int64_t>(stamp.at("nsec").get<std::int64_t>(), 0, second));
}

void read_frame(const std::string& place, const Json& translation, const Json& turn, SpaceFrame& frame) {
  frame.x = coordinate(place, translation.at("x").get<double>());
  frame.y = coordinate(place, translation.at("y").get<double>());
  frame.z = coordinate(place, translation.at("z").get<double>());
  frame.qx = rotation(place, turn.at("x").get<double>());
  frame.qy = rotation(place, turn.at("y").get<double>());
  frame.qz = rotation(place, turn.at("z").get<double>());
  frame.qw = rotation(place, turn.at("w").get<double>());
}

void read_frame(const std::string& place, MessageReader& reader, SpaceFrame& frame) {
  for (double* const value : {&frame.x, &frame.y, &frame.z}) *value = coordinate(place, reader.number<double>());
  for (double* const value : {&frame.qx, &frame.qy, &frame.qz, &frame.qw})
    *value = rotation(place, reader.number<double>());
}

Pose pose_of(const SpaceFrame& frame) { return {frame.x, frame.y, heading_of(frame.qx, frame.qy, frame.qz, frame.qw)}; }

ScanMessage scan_of_json(const std::string& place, const Json& json) {
  ScanMessage scan;
  scan.stamp = stamp_of(json);
  scan.frame = json.at("frame_id").get<std::string>();
  scan.first_angle_rad = beam_angle(place, json.at("start_angle").get<double>());
  const double last_rad = beam_angle(place, json.at("end_angle").get<double>());
  for (const Json& range : json.at("ranges")) {
    const double range_m = range.is_null() ? no_echo_m : range.get<double>();
    scan.range_m.push_back(std::fabs(range_m) <= range_max_m ? static_cast<float>(range_m) : no_echo_m);
  }
  if (scan.range_m.size() > 1)
    scan.angle_step_rad = (last_rad - scan.first_angle_rad) / static_cast<double>(scan.range_m.size() - 1);
  check_span(place, scan);
  return scan;
}

}  // namespace

double heading_of(double qx, double qy, double qz, double qw) {
  return exact::atan2(2 * (qw * qz + qx * qy), qw * qw + qx * qx - qy * qy - qz * qz);
}

ScanMessage parse_scan(const std::string& place, Encoding encoding, std::string_view message) {
  if (encoding == Encoding::json)
    return from_json(place, message, [&](const Json& json) { return scan_of_json(place, json); });
  MessageReader reader(place, encoding, message);
  ScanMessage scan;
  std::tie(scan.stamp, scan.frame) = reader.header();
  scan.first_angle_rad = beam_angle(place, reader.number<float>());
  reader.number<float>();  // the last angle
  scan.angle_step_rad = beam_angle(place, reader.number<float>());
  reader.number<float>();  // time between beams
  reader.number<float>();  // time between scans
  scan.range_min_m = within(place, "the least range", range_max_m, reader.number<float>());
  const auto greatest_m = reader.number<float>();
  if (greatest_m > 0 && greatest_m <= range_max_m) scan.range_max_m = greatest_m;
  const std::uint32_t beams = reader.count(beams_max);
  for (std::uint32_t i = 0; i < beams; ++i) {
    const auto range_m = reader.number<float>();
    scan.range_m.push_back(std::fabs(range_m) <= range_max_m ? range_m : no_echo_m);
  }
  check_span(place, scan);
  return scan;
}

OdometryMessage parse_odometry(const std::string& place, Encoding encoding, std::string_view message) {
  OdometryMessage odometry;
  SpaceFrame frame;
  if (encoding == Encoding::json) {
    from_json(place, message, [&](const Json& json) {
      odometry.stamp = stamp_of(json);
      read_frame(place, json.at("pose").at("position"), json.at("pose").at("orientation"), frame);
      return true;
    });
  } else {
    MessageReader reader(place, encoding, message);
    odometry.stamp = reader.header().first;
    odometry.child = reader.text();
    read_frame(place, reader, frame);
  }
  odometry.pose = pose_of(frame);
  return odometry;
}

std::vector<FrameMessage> parse_frames(const std::string& place, Encoding encoding, std::string_view message) {
  std::vector<FrameMessage> frames;
  if (encoding == Encoding::json) {
    from_json(place, message, [&](const Json& json) {
      FrameMessage& frame = frames.emplace_back();
      frame.stamp = stamp_of(json);
      frame.child = json.at("child_frame_id").get<std::string>();
      frame.frame.parent = json.at("parent_frame_id").get<std::string>();
      read_frame(place, json.at("translation"), json.at("rotation"), frame.frame);
      return true;
    });
    return frames;
  }
  MessageReader reader(place, encoding, message);
  const std::uint32_t count = reader.count(frames_max);
  for (std::uint32_t i = 0; i < count; ++i) {
    FrameMessage& frame = frames.emplace_back();
    std::tie(frame.stamp, frame.frame.parent) = reader.header();
    frame.child = reader.text();
    read_frame(place, reader, frame.frame);
  }
  return frames;
}

}  // namespace waitpoint::logs
