// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/reports/history.hpp"

#include <new>

#include "fibers/posix/family/family.hpp"
#include "fibers/posix/program/program.hpp"
#include "fibers/posix/reports/memory.hpp"

namespace waitpoint::posix {

using family::Part;

namespace {

History& history() {
  if (void* const made = family::common(Part::history, 0); made != nullptr) return *static_cast<History*>(made);
  void* const memory = family::common(Part::history, sizeof(History));
  if (memory == nullptr) refuse("there is no memory for the events of several processes");
  return *new (memory) History();
}

}  // namespace

HistoryRecorder::HistoryRecorder(const exploration::Explorer* explorer, Time from) : explorer_(explorer), from_(from) {
  event = &HistoryRecorder::record;
}

exploration::TimelineRecorder& HistoryRecorder::of_process() {
  const family::Process& own = *family::own;
  if (process_ != own.id) {
    process_ = own.id;
    recorder_ = new exploration::TimelineRecorder(history().timeline, explorer_, from_);
    recorder_->begin_process({own.id, own.name});
  }
  return *recorder_;
}

void HistoryRecorder::record(kernel::Watch& watch, const kernel::EventRecord& record) {
  const NewInFamily here;
  exploration::TimelineRecorder& recorder = static_cast<HistoryRecorder&>(watch).of_process();
  recorder.event(recorder, record);
}

void HistoryRecorder::pause() {
  if (process_ != family::own->id) return;
  const NewInFamily here;
  recorder_->pause();
}

void HistoryNarrator::keep(const exploration::Told& told, bool is_switch, bool is_answer) {
  const NewInFamily here;
  history().narration.add(told, is_switch, is_answer);
}

}  // namespace waitpoint::posix
