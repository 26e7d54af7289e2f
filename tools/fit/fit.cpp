// SPDX-License-Identifier: BSD-3-Clause
#include "tools/fit/fit.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <vector>

#include "core/error.hpp"
#include "modules/logs/log_file.hpp"
#include "modules/playback/playback.hpp"
#include "tools/command/distinct_files.hpp"
#include "tools/command/interruption.hpp"
#include "tools/command/option_values.hpp"
#include "tools/fit/robot_type.hpp"
#include "tools/output/output_file.hpp"
#include "tools/replay/playback_run.hpp"
#include "tools/replay/replayed_robot.hpp"
#include "tools/run/run_watchdog.hpp"

namespace waitpoint::tools {
namespace {

using playback::PoseSource;
using playback::StampedPose;

constexpr int status_interrupted = 130;
constexpr std::string_view letters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-";

struct PosePairs {
  std::vector<Pose> measured, localised;
};

/// Of the scans that have both.
PosePairs pairs_of(const playback::Playback& playback) {
  PosePairs pairs;
  const std::vector<StampedPose> odometry = playback.trajectory(PoseSource::odometry);
  auto at = odometry.begin();
  for (const StampedPose& localised : playback.trajectory(PoseSource::segloc)) {
    at = std::find_if(at, odometry.end(), [&](const StampedPose& pose) { return pose.scan == localised.scan; });
    if (at == odometry.end()) break;
    pairs.measured.push_back(at->pose);
    pairs.localised.push_back(localised.pose);
  }
  return pairs;
}

/// The speeds over half a second that are exceeded once in a thousand times.
void find_speeds(const playback::Playback& playback, RobotFit& fit) {
  std::vector<double> v, w;
  const logs::Played* before = nullptr;
  for (const logs::Played& record : playback.order().records) {
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
  const auto greatest = [](std::vector<double>& speeds) {
    if (speeds.empty()) return 0.0;
    const auto at = speeds.begin() + static_cast<std::ptrdiff_t>(speeds.size() - 1 - speeds.size() / 1000);
    std::nth_element(speeds.begin(), at, speeds.end());
    return *at;
  };
  fit.v_max_m_s = greatest(v);
  fit.w_max_rad_s = greatest(w);
}

}  // namespace

FitArguments::FitArguments(CommandLine& line)
    : command_(line.add_command(
          "fit", "Prints a robot type with the errors of a log's odometry and laser (docs/replay.md).")) {
  source_.add(command_);
  command_.option("--name", name_, "NAME", "of the robot type (default: fitted)");
  command_.option("--out", out_, "FILE.yaml", "write it to this file (default: to standard output)");
}

FitOptions FitArguments::options() const {
  FitOptions options;
  options.source = source_.options();
  if (!name_.empty()) options.name = name_;
  if (options.name.find_first_not_of(letters) != options.name.npos)
    refuse("--name", "letters, digits, '_' and '-'", options.name);
  if (!out_.empty()) options.out = out_;
  check_distinct({{"--out", out_}, {"LOG", source_.log(), NamedFile::Use::read}});
  return options;
}

int fit(const FitOptions& options, std::span<const genom::ModuleType> types) {
  heed_signals();
  const RunWatchdog watchdog(RunWatchdog::usual_limit_s);
  const scenario::RobotScenario robot = replayed_robot(options.source);
  const logs::SensorLog log = logs::read_log(options.source.log, options.source.choice);
  playback::Playback playback(log, robot, types, {});
  if (!playback.has(PoseSource::segloc))
    throw BadInput("--modules", "expected segloc, to whose poses the odometry is fitted");
  OutputFile file(options.out.value_or("-"));
  const PlaybackRun run = run_playback(playback, Time::max(), [](std::int64_t) {});
  if (run.interrupted) return status_interrupted;
  RobotFit fitted;
  fitted.name = options.name;
  fitted.log = options.source.log.filename().string();
  fitted.mount = log.mount;
  const PosePairs pairs = pairs_of(playback);
  fitted.odometry = fit_odometry(pairs.measured, pairs.localised);
  fitted.laser = fit_laser(log);
  find_speeds(playback, fitted);
  file.write(robot_type_text(fitted));
  file.commit();
  return 0;
}

}  // namespace waitpoint::tools
