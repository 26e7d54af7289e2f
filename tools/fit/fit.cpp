// SPDX-License-Identifier: BSD-3-Clause
#include "tools/fit/fit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <vector>

#include "core/error.hpp"
#include "tools/command/interruption.hpp"
#include "tools/command/option_values.hpp"
#include "tools/fit/fit_json.hpp"
#include "tools/fit/replayed_log.hpp"
#include "tools/fit/robot_type.hpp"
#include "tools/output/json_document.hpp"
#include "tools/output/output_file.hpp"
#include "tools/replay/playback_run.hpp"
#include "tools/run/run_watchdog.hpp"

namespace waitpoint::tools {
namespace {

constexpr std::string_view letters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-";

/// Each by the median of itself and its neighbours: a jump of the odometry is no speed of the robot.
std::vector<double> without_spikes(const std::vector<double>& speeds) {
  std::vector<double> smooth;
  for (std::size_t i = 1; i + 1 < speeds.size(); ++i) {
    const auto [least, greatest] = std::minmax({speeds[i - 1], speeds[i], speeds[i + 1]});
    smooth.push_back(speeds[i - 1] + speeds[i] + speeds[i + 1] - least - greatest);
  }
  return smooth;
}

/// The speeds over half a second that are exceeded once in a thousand times.
void find_speeds(const logs::PlayingOrder& order, RobotFit& fit) {
  std::vector<double> v, w;
  const logs::Played* before = nullptr;
  for (const logs::Played& record : order.records) {
    if (!record.scan) continue;
    constexpr double least_s = 0.5;  // stamps of shorter times jitter too much
    if (before != nullptr && (record.date - before->date).seconds() < least_s) continue;
    if (before != nullptr) {
      const Pose moved = between(before->odometry, record.odometry);
      const double time_s = (record.date - before->date).seconds();
      v.push_back(length(moved.position()) / time_s);
      w.push_back(std::fabs(moved.heading) / time_s);
    }
    before = &record;
  }
  const auto greatest = [](const std::vector<double>& all) {
    std::vector<double> speeds = without_spikes(all);
    if (speeds.empty()) return 0.0;
    const auto at = speeds.begin() + static_cast<std::ptrdiff_t>(speeds.size() - 1 - speeds.size() / 1000);
    std::nth_element(speeds.begin(), at, speeds.end());
    return *at;
  };
  fit.v_max_m_s = greatest(v);
  fit.w_max_rad_s = greatest(w);
}

/// Errors of this size are not a base's: the localisation has followed something else.
void check_plausible(const OdometryFit& of, const std::string& log) {
  constexpr double scale_most = 3, drift_most_rad_per_m = 1;
  const auto is_scale = [](double scale) { return scale > 1 / scale_most && scale < scale_most; };
  if (is_scale(of.travel_scale) && is_scale(of.turn_scale) && std::fabs(of.drift_rad_per_m) < drift_most_rad_per_m)
    return;
  throw BadInput(log,
                 fmt::format("expected odometry that is right within a factor of {:g} and {:g} rad/m, found a travel "
                             "scale of {:.4g}, a turn scale of {:.4g} and a drift of {:.4g} rad/m: was the "
                             "localisation lost? (waitpoint play --picture)",
                             scale_most, drift_most_rad_per_m, of.travel_scale, of.turn_scale, of.drift_rad_per_m));
}

OptionValue type_name(std::string& into) {
  OptionValue value{.placeholder = "NAME"};
  value.take = [&into](const std::string& source, const std::string& text) {
    if (text.find_first_not_of(letters) != text.npos) refuse(source, "letters, digits, '_' and '-'", text);
    if (text == "include" || text.front() == '-')
      refuse(source, "a name that begins with no '-', and is not the key 'include' of robot_types", text);
    into = text;
  };
  return value;
}

}  // namespace

void declare(Command& command, FitOptions& options) {
  command.description = "Prints a robot type with the errors of a log's odometry and laser (docs/replay.md).";
  command.examples = {"intel.log --name intel --out intel.yaml"};
  declare_log(command, options.source);
  command.section("Results");
  command.add("--name", type_name(options.name), "name of the robot type", {.usual = options.name});
  command.add("--out", written_file(options.out, "FILE.yaml"), "write the robot type to this file",
              {.usual = "standard output"});
  command.json(options.json);
}

int fit(const FitOptions& options, std::span<const genom::ModuleType> types) {
  heed_signals();
  const RunWatchdog watchdog(RunWatchdog::usual_limit_s);
  std::optional<OutputFile> file;
  if (options.out || !options.json) file.emplace(options.out.value_or("-"));
  const std::optional<ReplayedLog> replayed = replayed_log(options.source, types);
  if (!replayed) return interrupted_status;
  RobotFit fitted;
  fitted.name = options.name;
  fitted.log = options.source.log.filename().string();
  fitted.mount = replayed->log.mount;
  fitted.odometry = fit_odometry(replayed->measured, replayed->localised, replayed->log.file);
  check_plausible(fitted.odometry, replayed->log.file);
  fitted.laser = fit_laser(replayed->log);
  find_speeds(replayed->order, fitted);
  if (file) {
    file->write(robot_type_text(fitted));
    file->commit();
  }
  return options.json ? end_with_json("fit", 0, fit_json(fitted)) : 0;
}

}  // namespace waitpoint::tools
