// SPDX-License-Identifier: BSD-3-Clause
#include "tools/replay/playback_run.hpp"

#include <unistd.h>

#include <algorithm>
#include <cstdio>

#include "tools/command/interruption.hpp"
#include "tools/output/progress.hpp"

namespace waitpoint::tools {

PlaybackRun run_playback(playback::Playback& playback, Time until,
                         const std::function<void(std::int64_t second)>& after_second) {
  constexpr Duration second = std::chrono::seconds(1);
  Progress progress(stderr, isatty(STDERR_FILENO) != 0, playback.last().since_start());
  PlaybackRun run;
  for (std::int64_t k = 1; run.end == RunEnd::time_reached && run.reached < until; ++k) {
    run.interrupted = interruption() != 0;
    if (run.interrupted) break;
    run.reached = std::min(until, Time() + second * k);
    run.end = playback.run_before(run.reached);
    after_second(k);
    progress.update(run.reached, 0, 0);
  }
  progress.finish();
  return run;
}

}  // namespace waitpoint::tools
