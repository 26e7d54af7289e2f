// SPDX-License-Identifier: BSD-3-Clause
// The detector's tasks, and the happens-before edges between them.
#include <cstring>
#include <new>

#include "fibers/explore/races/detector.hpp"
#include "fibers/explore/races/memory_order.hpp"
#include "fibers/kernel/interruption.hpp"
#include "fibers/kernel/task.hpp"

namespace waitpoint::races {
namespace {

constexpr std::uint32_t indices_max = 65'535;
// The number of ended tasks' indices examined for reuse.
constexpr std::uint32_t free_indices_tried = 8;

void clear(Context& context) {
  context.clock = context.released = context.acquirable = VectorClock();
  context.is_task = false;
  context.ignoring = 0;
  context.calls.clear();
}

}  // namespace

// --- runs and tasks ---

void Detector::begin_run() {
  ++run_;
  shadow_.reset();
  weak_.begin_run();
  clocks_.reset();
  tasks_.reset();
  free_indices_.reset();
  race_count_ = 0;
  recent_sync_at_ = nullptr;
  weight_ = 0;
  indices_ = 0;
  contexts_in_use_ = nullptr;
  ended_ = VectorClock();
  outside_left_ = 0;
  if (outside_ == nullptr) outside_ = &fresh_context();
  clear(*outside_);
  take_index(*outside_, *outside_);
  name(*outside_, "outside");
  current_ = outside_;
  update_watching();
}

Context& Detector::fresh_context() { return *new (contexts_.take(sizeof(Context))) Context; }

// Assigns a new index, or reuses that of an ended task whose past the maker knows completely: acquiring the new task's
// clock then implies the old one's.
void Detector::take_index(Context& context, const Context& maker) {
  const std::uint32_t record = tasks_.add();
  Epoch first = 1;
  std::uint32_t index = indices_;
  const std::uint32_t free = free_indices_.size();
  for (std::uint32_t i = 0; i < free && i < free_indices_tried; ++i) {
    FreeIndex& ended = free_indices_[free - 1 - i];
    if (maker.clock.of(ended.index) < ended.accessed) continue;
    index = ended.index;
    first = ended.last + 1;
    ended = free_indices_[free - 1];
    free_indices_.remove_last();
    break;
  }
  if (index == indices_) ++indices_;
  WAITPOINT_CHECK(index < indices_max, "more than 65 535 unjoined tasks in a run with race detection");
  context.index = static_cast<std::uint16_t>(index);
  context.record = record;
  context.accessed = 0;
  extend(context.clock, index + 1, clocks_);
  context.clock.epochs[index] = first;
  tasks_[record] = TaskRecord{{}, context.index, first};
}

Context& Detector::make() {
  Context* made = free_contexts_;
  if (made == nullptr)
    made = &fresh_context();
  else
    free_contexts_ = made->next;
  clear(*made);
  made->is_task = true;
  made->outside_known = 0;
  made->previous = nullptr;
  made->next = contexts_in_use_;
  if (contexts_in_use_ != nullptr) contexts_in_use_->previous = made;
  contexts_in_use_ = made;
  assign(made->clock, current_->clock, clocks_);
  take_index(*made, *current_);
  next_epoch(*current_);
  return *made;
}

void Detector::name(Context& context, const char* name) {
  std::strncpy(tasks_[context.record].name, name, kernel::name_size - 1);
}

void Detector::switch_to(Context& context) {
  if (current_ == outside_ && !outside_is_apart_) leave_outside();
  if (&context == outside_) {
    if (!outside_is_apart_) enter_outside();
  } else if (context.outside_known != outside_left_) {
    context.outside_known = outside_left_;
    join(context.clock, outside_->clock, clocks_);
  }
  current_ = &context;
  update_watching();
}

// Events outside happen before all later events of tasks: each acquires them when it is next resumed.
void Detector::leave_outside() { ++outside_left_; }

// All past events of tasks happen before later events outside.
void Detector::enter_outside() {
  join(outside_->clock, ended_, clocks_);
  for (Context* context = contexts_in_use_; context != nullptr; context = context->next) {
    join(outside_->clock, context->clock, clocks_);
    next_epoch(*context);
  }
  next_epoch(*outside_);
}

void Detector::order_by_outside() {
  enter_outside();
  leave_outside();
}

void Detector::end(Context& context) {
  free_indices_[free_indices_.add()] = {context.index, context.epoch(), context.accessed};
  join(ended_, context.clock, clocks_);
  if (context.next != nullptr) context.next->previous = context.previous;
  (context.previous == nullptr ? contexts_in_use_ : context.previous->next) = context.next;
  context.next = free_contexts_;
  free_contexts_ = &context;
}

void Detector::update_watching() {
  watching_ = current_->is_task && current_->ignoring == 0 &&
              (kernel::running == nullptr || !kernel::is_unwinding(*kernel::running->scheduler));
}

// --- happens-before ---

// An acquired point is usually released next.
VectorClock& Detector::sync_point(const void* at) {
  if (at == recent_sync_at_) return *recent_sync_point_;
  SyncPoint& point = sync_points_[reinterpret_cast<std::uint64_t>(at)];
  if (point.run != run_) point = {VectorClock(), run_};
  recent_sync_at_ = at;
  recent_sync_point_ = &point.clock;
  return point.clock;
}

void Detector::release(const void* at) {
  join(sync_point(at), current_->clock, clocks_);
  next_epoch(*current_);
}

void Detector::use(const void* at) {
  meet(current_->clock, sync_point(at), clocks_);
  next_epoch(*current_);
}

void Detector::acquire(const void* at) { join(current_->clock, sync_point(at), clocks_); }

void Detector::atomic_load(const void* at, int order) {
  VectorClock& point = sync_point(at);
  join(acquires(order) ? current_->clock : current_->acquirable, point, clocks_);
}

// A store starts a new release sequence: acquiring its value gives no knowledge of earlier ones.
void Detector::atomic_store(const void* at, int order) {
  VectorClock& point = sync_point(at);
  if (!releases(order)) return assign(point, current_->released, clocks_);
  assign(point, current_->clock, clocks_);
  next_epoch(*current_);
}

void Detector::atomic_modify(const void* at, int order) {
  atomic_load(at, order);
  VectorClock& point = sync_point(at);
  join(point, releases(order) ? current_->clock : current_->released, clocks_);
  if (releases(order)) next_epoch(*current_);
}

void Detector::fence(int order) {
  if (acquires(order)) join(current_->clock, current_->acquirable, clocks_);
  if (is_weak_ && is_seq_cst(order)) weak_.fence({current_->clock, current_->index, current_->record, 0, order});
  if (!releases(order)) return;
  assign(current_->released, current_->clock, clocks_);
  next_epoch(*current_);
}

}  // namespace waitpoint::races
