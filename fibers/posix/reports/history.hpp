// SPDX-License-Identifier: BSD-3-Clause
// What the processes of a family did: their events and the choices of the strategy, in one order. It is in the family's
// memory, so it is complete however a process ends.
//
// The process with the turn adds to it. Each process has a recorder and a narrator of its own.
#pragma once

#include "fibers/explore/report/narrator.hpp"
#include "fibers/explore/report/timeline_recorder.hpp"

namespace waitpoint::posix {

struct History {
  exploration::Timeline timeline;
  exploration::Narration narration;
};

/// Adds the events of this process from `from` on, and of its children once they are forked.
class HistoryRecorder final : public kernel::Watch {
 public:
  /// Without an explorer no event is a switch; it must outlive the recorder.
  explicit HistoryRecorder(const exploration::Explorer* explorer, Time from = Time());

  /// Before the process hands over the turn.
  void pause();

 private:
  static void record(kernel::Watch& watch, const kernel::EventRecord& record);
  exploration::TimelineRecorder& of_process();

  const exploration::Explorer* explorer_;
  Time from_;
  pid_t process_ = 0;                                  // that `recorder_` is for
  exploration::TimelineRecorder* recorder_ = nullptr;  // in the family's memory: a child leaves its parent's alone
};

class HistoryNarrator final : public exploration::Narrator {
 public:
  using Narrator::Narrator;

 private:
  void keep(const exploration::Told& told, bool is_switch, bool is_answer) override;
};

}  // namespace waitpoint::posix
