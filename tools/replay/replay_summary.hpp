// SPDX-License-Identifier: BSD-3-Clause
// The results of a replayed log, as text and as JSON.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "modules/logs/sensor_log.hpp"
#include "modules/playback/playback.hpp"
#include "tools/replay/relations.hpp"

namespace waitpoint::tools {

struct ReplayResult {
  std::string outcome;  ///< "finished", "time limit", ...
  Digest digest;
  std::uint64_t events = 0;
  Duration simulated;  ///< virtual time
  double wall_s = 0;
  std::string pose_source;                        ///< "segloc"
  std::vector<playback::StampedPose> trajectory;  ///< by it
  std::vector<Relation> relations;                ///< may be none
};

/// Ends with a newline.
std::string replay_text(const logs::SensorLog& log, const playback::Playback& playback, const ReplayResult& result);
/// One JSON object, with `relations` if there are any. Ends with a newline.
std::string replay_json(const logs::SensorLog& log, const playback::Playback& playback, const ReplayResult& result);

}  // namespace waitpoint::tools
