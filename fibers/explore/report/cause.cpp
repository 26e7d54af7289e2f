// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/explore/report/cause.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <vector>

namespace waitpoint::exploration {
namespace {

using kernel::Operation;

bool is_notification(Operation operation) {
  return operation == Operation::notify_one || operation == Operation::notify_all;
}
bool reads(Operation operation) { return operation == Operation::load || operation == Operation::modify; }
bool writes(Operation operation) {
  return operation == Operation::store || operation == Operation::modify || operation == Operation::exchange ||
         operation == Operation::compare_exchange;
}

/// The events of the failing run by their indices, and its tasks by theirs.
class FailingRun {
 public:
  explicit FailingRun(const Timeline& timeline) : timeline_(timeline), last_(timeline.tasks.size()) {
    for (std::size_t i = 0; i < timeline.events.size(); ++i) last_[timeline.events[i].task] = i;
    std::set<std::string> names;
    for (const TimelineTask& task : timeline.tasks)
      are_names_unique_ = are_names_unique_ && names.insert(task.name).second;
  }

  const std::vector<TimelineEvent>& events() const { return timeline_.events; }
  std::uint32_t task_count() const { return static_cast<std::uint32_t>(timeline_.tasks.size()); }
  const TimelineEvent& last_event_of(std::uint32_t task) const { return timeline_.events[last_[task]]; }
  std::size_t index_of_last(std::uint32_t task) const { return last_[task]; }

  std::string task(std::uint32_t index) const {
    return are_names_unique_ ? timeline_.tasks[index].name : timeline_.tasks[index].title;
  }
  std::string object(std::int32_t index) const { return timeline_.object(index); }

  std::optional<std::size_t> index_of(const EventOf& event) const {
    const auto found = std::ranges::find(timeline_.events, event, &TimelineEvent::which);
    if (found == timeline_.events.end()) return std::nullopt;
    return static_cast<std::size_t>(found - timeline_.events.begin());
  }
  std::optional<std::uint32_t> task_with(std::uint64_t id) const {
    for (const TimelineEvent& event : timeline_.events)
      if (event.which.task == id) return event.task;
    return std::nullopt;
  }

 private:
  const Timeline& timeline_;
  std::vector<std::size_t> last_;  // of each task
  bool are_names_unique_ = true;
};

/// The task that holds each lock at the end of a run.
std::map<std::int32_t, std::uint32_t> holders(const FailingRun& run) {
  std::map<std::int32_t, std::uint32_t> holders;
  for (std::size_t i = 0; i < run.events().size(); ++i) {
    const TimelineEvent& event = run.events()[i];
    const bool is_blocked = event.waits_for >= 0 || i == run.index_of_last(event.task);
    if ((event.operation == Operation::lock && !is_blocked) || event.operation == Operation::resume)
      holders[event.object] = event.task;
    if (event.operation == Operation::unlock) holders.erase(event.object);
  }
  return holders;
}

// Each task of the cycle holds the lock that the one before it waits for.
std::string crossed_locks(const FailingRun& run) {
  const std::map<std::int32_t, std::uint32_t> held_by = holders(run);
  const auto next = [&](std::uint32_t task) -> std::optional<std::uint32_t> {
    const TimelineEvent& last = run.last_event_of(task);
    const auto holder = held_by.find(last.object);
    if (last.operation != Operation::lock || holder == held_by.end()) return std::nullopt;
    return holder->second;
  };
  for (std::uint32_t first = 0; first < run.task_count(); ++first) {
    std::vector<std::uint32_t> cycle = {first};
    std::optional<std::uint32_t> at = next(first);
    for (; at && *at != first && cycle.size() < run.task_count(); at = next(*at)) cycle.push_back(*at);
    if (at != first) continue;
    if (cycle.size() == 1)
      return run.task(first) + " locks " + run.object(run.last_event_of(first).object) + ", which it holds";
    std::string text = "locks are taken in opposite orders: ";
    for (std::size_t i = 0; i < cycle.size(); ++i) {
      const std::uint32_t before = cycle[(i + cycle.size() - 1) % cycle.size()];
      text += (i == 0 ? "" : ", ") + run.task(cycle[i]) + " holds " + run.object(run.last_event_of(before).object) +
              " and waits for " + run.object(run.last_event_of(cycle[i]).object);
    }
    return text;
  }
  return "";
}

std::string in_words(const FailingRun& run, const TimelineEvent& event) {
  return std::string(name(event.operation)) + " of " + run.task(event.task);
}

// The task that a notification wakes; nothing if several tasks may be meant.
std::optional<std::uint32_t> woken_by(const FailingRun& run, std::size_t notification) {
  const std::vector<TimelineEvent>& events = run.events();
  const auto waits = [&](std::uint32_t task) {
    for (std::size_t i = notification; i-- > 0;)
      if (events[i].task == task)
        return events[i].operation == Operation::wait && events[i].object == events[notification].object;
    return false;
  };
  std::set<std::uint32_t> woken;
  for (std::size_t i = notification + 1; i < events.size(); ++i)
    if (events[i].operation == Operation::resume && events[i].object == events[notification].object &&
        waits(events[i].task))
      woken.insert(events[i].task);
  if (woken.size() != 1) return std::nullopt;
  return *woken.begin();
}

// Of a task that is blocked at an object which others notify.
std::string missing_notification(const FailingRun& run, std::uint32_t task, bool has_passing_run) {
  const std::size_t wait = run.index_of_last(task);
  const std::int32_t object = run.events()[wait].object;
  std::optional<std::size_t> before;  // the last one
  std::vector<std::size_t> after;
  for (std::size_t i = 0; i < run.events().size(); ++i) {
    if (run.events()[i].object != object || !is_notification(run.events()[i].operation)) continue;
    if (i < wait)
      before = i;
    else
      after.push_back(i);
  }
  const std::string waits = run.task(task) + " waits for " + run.object(object);
  if (after.size() == 1) {
    const std::optional<std::uint32_t> woken = woken_by(run, after.front());
    return (has_passing_run ? "missed notification: " : "") + waits + ", but the only notification since then, " +
           in_words(run, run.events()[after.front()]) + ", wakes " + (woken ? run.task(*woken) : "another");
  }
  if (!after.empty())
    return (has_passing_run ? "missed notification: " : "") + waits + ", but the " + std::to_string(after.size()) +
           " notifications since then wake others";
  if (!before) return waits + ", which no task notifies";
  const TimelineEvent& last = run.events()[*before];
  if (last.task == task) return waits + ", which no task has notified since it did so itself";
  return (has_passing_run ? "lost wake-up: " : "") + in_words(run, last) + " comes before " + waits +
         ", and no notification comes after it";
}

// Only where nothing else is missing: all others have ended, wait for ends, or for the same object.
std::string lost_wake_up(const FailingRun& run, bool has_passing_run) {
  std::optional<std::uint32_t> waiter;
  for (std::uint32_t task = 0; task < run.task_count(); ++task) {
    const TimelineEvent& last = run.last_event_of(task);
    if (last.operation == Operation::end || last.operation == Operation::join) continue;
    if (last.operation != Operation::wait) return "";
    if (waiter && run.last_event_of(*waiter).object != last.object) return "";
    waiter = task;
  }
  return waiter ? missing_notification(run, *waiter, has_passing_run) : "";
}

// A task writes an object that another has written since it was read.
std::string lost_update(const FailingRun& run, std::int32_t object) {
  struct Seen {
    bool has_read = false;
    std::optional<std::uint32_t> overwritten_by = {};
  };
  std::map<std::uint32_t, Seen> seen;
  for (const TimelineEvent& event : run.events()) {
    if (event.object != object) continue;
    Seen& own = seen[event.task];
    if (event.operation == Operation::store && own.has_read && own.overwritten_by)
      return "lost update: " + run.task(*own.overwritten_by) + " writes " + run.object(object) +
             " between the read and the write of " + run.task(event.task);
    if (writes(event.operation))
      for (auto& [task, other] : seen)
        if (task != event.task && other.has_read) other.overwritten_by = event.task;
    if (writes(event.operation)) own = {};
    if (reads(event.operation)) own = {.has_read = true};
  }
  return "";
}

bool is_before(const FailingRun& run, std::size_t index, auto is_wanted) {
  const auto begin = run.events().begin();
  return std::any_of(begin, begin + static_cast<std::ptrdiff_t>(index), is_wanted);
}

// A lock that another task holds is acquired when its task resumes.
std::size_t index_of_acquisition(const FailingRun& run, std::size_t lock) {
  const std::vector<TimelineEvent>& events = run.events();
  std::size_t at = lock;
  if (events[lock].waits_for >= 0)
    for (++at; at < events.size() && events[at].task != events[lock].task;) ++at;
  return at;
}

// The event at `index` is a lock that comes before the follower's lock of the same object.
std::string interrupted_sections(const FailingRun& run, std::size_t index, std::uint32_t follower) {
  const TimelineEvent& lock = run.events()[index];
  const bool has_left = is_before(run, index_of_acquisition(run, index), [&](const TimelineEvent& event) {
    return event.operation == Operation::unlock && event.task == follower && event.object == lock.object;
  });
  if (!has_left) return "";
  return run.task(lock.task) + " locks " + run.object(lock.object) + " between two critical sections of " +
         run.task(follower);
}

// The event at `index` is an access that comes before that of another task.
std::string early_access(const FailingRun& run, std::size_t index, const std::string& follower, Operation then) {
  const TimelineEvent& access = run.events()[index];
  const std::string subject = run.task(access.task), object = run.object(access.object);
  if (writes(access.operation) && reads(then))
    return subject + " writes " + object + " before " + follower + " reads it";
  if (!reads(access.operation) || !writes(then)) return "";
  const bool is_written = is_before(
      run, index, [&](const TimelineEvent& event) { return event.object == access.object && writes(event.operation); });
  return subject + " reads " + object + " before " + follower + (is_written ? " writes it" : " writes it first");
}

}  // namespace

std::string cause_in_words(const Timeline& timeline, const FailureOrder& order) {
  if (timeline.events_before > 0 || timeline.events.empty()) return "";
  const FailingRun run(timeline);
  if (order.is_deadlock) {
    const std::string crossed = crossed_locks(run);
    return crossed.empty() ? lost_wake_up(run, order.has_passing_run) : crossed;
  }
  if (!order.reversed) return "";
  const auto index = run.index_of(order.reversed->first);
  const auto follower = run.task_with(order.reversed->follower);
  if (!index || run.events()[*index].object < 0) return "";
  const Operation first = run.events()[*index].operation, then = order.reversed->then;
  if (first == Operation::lock && then == Operation::lock)
    return follower ? interrupted_sections(run, *index, *follower) : "";
  const std::string lost = lost_update(run, run.events()[*index].object);
  if (!lost.empty()) return lost;
  return early_access(run, *index, follower ? run.task(*follower) : "a task that has not begun", then);
}

}  // namespace waitpoint::exploration
