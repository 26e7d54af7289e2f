// SPDX-License-Identifier: BSD-3-Clause
// Runs a playback in windows of a second of virtual time, between which progress is shown and signals are polled. The
// windows do not affect the run.
#pragma once

#include <cstdint>
#include <functional>

#include "modules/playback/playback.hpp"

namespace waitpoint::tools {

/// The exit status after a signal.
inline constexpr int interrupted_status = 130;

struct PlaybackRun {
  RunEnd end = RunEnd::time_reached;
  Time reached;  ///< everything before it is done
  bool interrupted = false;
};

/// To the end, `until` or a signal. `after_second` is called after each second, with their number.
PlaybackRun run_playback(playback::Playback& playback, Time until,
                         const std::function<void(std::int64_t second)>& after_second);

}  // namespace waitpoint::tools
