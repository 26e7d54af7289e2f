// SPDX-License-Identifier: BSD-3-Clause
#include "modules/logs/log_file.hpp"

#include "core/file_contents.hpp"
#include "modules/logs/carmen_log.hpp"
#include "modules/logs/decompression.hpp"
#include "modules/logs/mcap_log.hpp"
#include "modules/logs/ros_bag_log.hpp"

namespace waitpoint::logs {
namespace {

SensorLog parse(const std::string& name, const std::string& contents, const LogChoice& choice) {
  if (is_ros_bag(contents)) return parse_ros_bag(name, contents, choice);
  if (is_mcap(contents)) return parse_mcap(name, contents, choice);
  return parse_carmen_log(name, contents, choice);
}

}  // namespace

SensorLog parse_log(const std::string& name, std::string contents, const LogChoice& choice) {
  if (is_gzip(contents)) contents = decompressed(name, "gzip", contents);
  SensorLog log = parse(name, contents, choice);
  log.file = name;
  return log;
}

SensorLog read_log(const std::filesystem::path& file, const LogChoice& choice) {
  return parse_log(file.string(), given_file_contents(file, log_bytes_max), choice);
}

}  // namespace waitpoint::logs
