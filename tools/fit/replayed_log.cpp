// SPDX-License-Identifier: BSD-3-Clause
#include "tools/fit/replayed_log.hpp"

#include <algorithm>
#include <utility>

#include "core/error.hpp"
#include "modules/playback/playback.hpp"
#include "tools/replay/log_source.hpp"
#include "tools/replay/playback_run.hpp"

namespace waitpoint::tools {

using playback::PoseSource;
using playback::StampedPose;

std::optional<ReplayedLog> replayed_log(const LogOptions& options, std::span<const genom::ModuleType> types) {
  const LogSource source = log_source(options);
  ReplayedLog result{.log = source.read(), .order = {}, .measured = {}, .localised = {}, .scans = {}};
  playback::Playback playback(result.log, source.robot, types, {});
  if (!playback.has(PoseSource::segloc))
    throw BadInput("--modules", "expected segloc, with whose poses the odometry is compared");
  if (run_playback(playback, Time::max(), [](std::int64_t) {}).interrupted) return std::nullopt;
  result.order = playback.order();
  const std::vector<StampedPose> odometry = playback.trajectory(PoseSource::odometry);
  auto at = odometry.begin();
  for (const StampedPose& localised : playback.trajectory(PoseSource::segloc)) {
    at = std::find_if(at, odometry.end(), [&](const StampedPose& pose) { return pose.scan == localised.scan; });
    if (at == odometry.end()) break;
    result.measured.push_back(at->pose);
    result.localised.push_back(localised.pose);
    result.scans.push_back(localised.scan);
  }
  return result;
}

}  // namespace waitpoint::tools
