// SPDX-License-Identifier: BSD-3-Clause
#include "modules/playback/log_settings.hpp"

#include <span>

#include "core/exact_math.hpp"
#include "core/number_text.hpp"

namespace waitpoint::playback {
namespace {

struct LogSetting {
  std::string_view module_type, key;
  double (*value)(const logs::SensorLog& log);
};

constexpr LogSetting log_settings[] = {
    {"rflex", "units_per_m", [](const logs::SensorLog&) { return units_per_metre; }},
    {"rflex", "units_per_rad", [](const logs::SensorLog&) { return units_per_radian; }},
    {"sick", "mount_x_m", [](const logs::SensorLog& log) { return log.mount.x; }},
    {"sick", "mount_y_m", [](const logs::SensorLog& log) { return log.mount.y; }},
    {"sick", "mount_heading_deg", [](const logs::SensorLog& log) { return log.mount.heading / (exact::pi / 180); }},
};

}  // namespace

std::string said_by_log(std::string_view module_type, std::string_view key) {
  for (const LogSetting& each : log_settings) {
    if (each.module_type != module_type || each.key != key) continue;
    return module_type == "sick" ? "the laser's mount is the log's, or 'log: {mount: [x, y, degrees]}' of a scenario"
                                 : "the base's reports are made of the log, in units of their own";
  }
  return "";
}

void set_by_log(std::string_view module_type, const logs::SensorLog& log, std::vector<Setting>& settings) {
  for (const LogSetting& each : log_settings) {
    if (each.module_type != module_type) continue;
    std::erase_if(settings, [&](const Setting& setting) { return setting.key == each.key; });
    settings.push_back({std::string(each.key), number_text(each.value(log)), log.file, 0});
  }
}

}  // namespace waitpoint::playback
