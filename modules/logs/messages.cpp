// SPDX-License-Identifier: BSD-3-Clause
#include "modules/logs/messages.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <tuple>

#include "modules/logs/byte_reader.hpp"

namespace waitpoint::logs {
namespace {

using Json = nlohmann::json;

constexpr std::uint32_t beams_max = 100'000, frames_max = 100'000;

/// Of ROS 1, without padding; or CDR, whose numbers are aligned after its head of four bytes.
class MessageReader {
 public:
  MessageReader(const std::string& name, Encoding encoding, std::string_view bytes)
      : is_cdr_(encoding == Encoding::cdr), bytes_(name, is_cdr_ ? behind_head(name, bytes) : bytes) {}

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
  static std::string_view behind_head(const std::string& name, std::string_view bytes) {
    constexpr std::size_t head = 4;
    if (bytes.size() < head || bytes[0] != 0 || bytes[1] != 1)
      throw BadInput(name, "expected messages in little-endian CDR");
    return bytes.substr(head);
  }

  bool is_cdr_;
  ByteReader bytes_;
};

double finite(const std::string& name, double value) {
  constexpr double most = 1e9;
  if (!(std::fabs(value) <= most)) throw BadInput(name, "expected a number of metres or radians in a message");
  return value;
}

/// Calls `read` with the parsed message; what is missing or of another type in it is BadInput.
template <class Read>
auto from_json(const std::string& name, std::string_view message, Read read) {
  try {
    return read(Json::parse(message));
  } catch (const Json::exception&) {
    throw BadInput(name, "expected a message of Foxglove's schemas in JSON");
  }
}

Time stamp_of(const Json& json) {
  constexpr std::int64_t second = 1'000'000'000, seconds_max = 4'000'000'000;
  const Json& stamp = json.at("timestamp");
  const auto seconds = std::clamp<std::int64_t>(stamp.at("sec").get<std::int64_t>(), -seconds_max, seconds_max);
  return Time::from_ns(seconds * second + std::clamp<std::int64_t>(stamp.at("nsec").get<std::int64_t>(), 0, second));
}

void read_frame(const std::string& name, const Json& translation, const Json& rotation, SpaceFrame& frame) {
  frame.x = finite(name, translation.at("x").get<double>());
  frame.y = finite(name, translation.at("y").get<double>());
  frame.z = finite(name, translation.at("z").get<double>());
  frame.qx = finite(name, rotation.at("x").get<double>());
  frame.qy = finite(name, rotation.at("y").get<double>());
  frame.qz = finite(name, rotation.at("z").get<double>());
  frame.qw = finite(name, rotation.at("w").get<double>());
}

void read_frame(const std::string& name, MessageReader& reader, SpaceFrame& frame) {
  for (double* const value : {&frame.x, &frame.y, &frame.z, &frame.qx, &frame.qy, &frame.qz, &frame.qw})
    *value = finite(name, reader.number<double>());
}

Pose pose_of(const SpaceFrame& frame) { return {frame.x, frame.y, heading_of(frame.qx, frame.qy, frame.qz, frame.qw)}; }

ScanMessage scan_of_json(const std::string& name, const Json& json) {
  ScanMessage scan;
  scan.stamp = stamp_of(json);
  scan.frame = json.at("frame_id").get<std::string>();
  scan.first_angle_rad = finite(name, json.at("start_angle").get<double>());
  const double last_rad = finite(name, json.at("end_angle").get<double>());
  for (const Json& range : json.at("ranges"))
    scan.range_m.push_back(range.is_null() ? std::numeric_limits<float>::infinity() : range.get<float>());
  if (scan.range_m.size() > 1)
    scan.angle_step_rad = (last_rad - scan.first_angle_rad) / static_cast<double>(scan.range_m.size() - 1);
  return scan;
}

}  // namespace

double heading_of(double qx, double qy, double qz, double qw) {
  return exact::atan2(2 * (qw * qz + qx * qy), qw * qw + qx * qx - qy * qy - qz * qz);
}

ScanMessage parse_scan(const std::string& name, Encoding encoding, std::string_view message) {
  if (encoding == Encoding::json)
    return from_json(name, message, [&](const Json& json) { return scan_of_json(name, json); });
  MessageReader reader(name, encoding, message);
  ScanMessage scan;
  std::tie(scan.stamp, scan.frame) = reader.header();
  scan.first_angle_rad = finite(name, reader.number<float>());
  reader.number<float>();  // the last angle
  scan.angle_step_rad = finite(name, reader.number<float>());
  reader.number<float>();  // time between beams
  reader.number<float>();  // time between scans
  scan.range_min_m = finite(name, reader.number<float>());
  scan.range_max_m = finite(name, reader.number<float>());
  const std::uint32_t beams = reader.count(beams_max);
  for (std::uint32_t i = 0; i < beams; ++i) scan.range_m.push_back(reader.number<float>());
  return scan;
}

OdometryMessage parse_odometry(const std::string& name, Encoding encoding, std::string_view message) {
  OdometryMessage odometry;
  SpaceFrame frame;
  if (encoding == Encoding::json) {
    from_json(name, message, [&](const Json& json) {
      odometry.stamp = stamp_of(json);
      read_frame(name, json.at("pose").at("position"), json.at("pose").at("orientation"), frame);
      return true;
    });
  } else {
    MessageReader reader(name, encoding, message);
    odometry.stamp = reader.header().first;
    odometry.child = reader.text();
    read_frame(name, reader, frame);
  }
  odometry.pose = pose_of(frame);
  return odometry;
}

std::vector<FrameMessage> parse_frames(const std::string& name, Encoding encoding, std::string_view message) {
  std::vector<FrameMessage> frames;
  if (encoding == Encoding::json) {
    from_json(name, message, [&](const Json& json) {
      FrameMessage& frame = frames.emplace_back();
      frame.stamp = stamp_of(json);
      frame.child = json.at("child_frame_id").get<std::string>();
      frame.frame.parent = json.at("parent_frame_id").get<std::string>();
      read_frame(name, json.at("translation"), json.at("rotation"), frame.frame);
      return true;
    });
    return frames;
  }
  MessageReader reader(name, encoding, message);
  const std::uint32_t count = reader.count(frames_max);
  for (std::uint32_t i = 0; i < count; ++i) {
    FrameMessage& frame = frames.emplace_back();
    std::tie(frame.stamp, frame.frame.parent) = reader.header();
    frame.child = reader.text();
    read_frame(name, reader, frame.frame);
  }
  return frames;
}

}  // namespace waitpoint::logs
