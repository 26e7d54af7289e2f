// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/explore/schedules/trace_hash.hpp"

namespace waitpoint::exploration {
namespace {

constexpr std::uint64_t hash_of(std::uint64_t first, std::uint64_t second) {
  return Digest::mix(first + Digest::mix(second));
}

}  // namespace

void TraceHash::clear() {
  last_.clear();
  objects_.clear();
  barrier_ = sum_ = 0;
}

std::uint64_t& TraceHash::last_of(const kernel::Task& task) {
  if (last_.size() <= task.number) last_.resize(task.number + 1, 0);
  std::uint64_t& last = last_[task.number];
  if (last == 0) last = Digest::mix(task.id);
  return last;
}

// As for the strategy dpor, whose relation is of pairs of events. A blocked task is about to time out.
bool TraceHash::depends_on_all(const kernel::Task& task) {
  using kernel::Operation;
  const Operation operation = task.operation;
  return acts_on_any(operation) || is_of_channel(operation) || is_of_timer(operation) || releases_unseen(operation) ||
         operation == Operation::exit || task.state == kernel::TaskState::blocked || task.seat != nullptr;
}

// Whether a join comes before or behind the end that it waits for makes no difference.
void TraceHash::add(const kernel::Task& task) {
  if (task.operation == kernel::Operation::join) return;
  std::uint64_t& last = last_of(task);
  std::uint64_t event = hash_of(last ^ barrier_, static_cast<std::uint64_t>(task.operation));
  if (depends_on_all(task)) {
    event = hash_of(event, sum_);
    barrier_ = event;
  } else if (task.at != nullptr || acts_on_unknown(task.operation)) {
    ObjectState& object = objects_[task.at != nullptr ? task.at->identity : 0];
    if (object.change == 0) object.change = Digest::mix(event);
    event = hash_of(event, object.change);
    if (is_read_only(task.operation)) {
      object.looks += event;
    } else {
      event = hash_of(event, object.looks);
      object = {event, 0};
    }
  }
  last = event;
  sum_ += event;
}

void TraceHash::add(kernel::Choice choice, const kernel::Task& task, std::uint32_t chosen) {
  std::uint64_t& last = last_of(task);
  last = hash_of(last, (std::uint64_t{chosen} << 8) + static_cast<std::uint64_t>(choice));
  sum_ += last;
}

}  // namespace waitpoint::exploration
