// SPDX-License-Identifier: BSD-3-Clause
// Decides if processes are prepared for further runs, by copying their memory before the first one: by the time that it
// has gained so far. Where it is in vain, it is tried again at intervals only.
#pragma once

namespace waitpoint::tools {

class RerunGain {
 public:
  /// The process of the run can make the next one.
  void note_kept() {
    if (loss_ > 0) --loss_;
  }
  /// It cannot, or is not to.
  void note_lost() {
    loss_ += of_a_process;
    if (loss_ > loss_max) pause_ = runs_paused;
  }
  /// To be asked once before each run.
  bool is_worth_preparing() {
    if (pause_ == 0) return true;
    if (--pause_ == 0) loss_ = loss_max;
    return false;
  }

 private:
  static constexpr int of_a_process = 3, loss_max = 9, runs_paused = 100;
  int loss_ = 0, pause_ = 0;
};

}  // namespace waitpoint::tools
