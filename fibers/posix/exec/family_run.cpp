// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/exec/family_run.hpp"

#include <algorithm>
#include <span>

#include "fibers/kernel/run.hpp"
#include "fibers/kernel/run_window.hpp"
#include "fibers/posix/descriptors/descriptors.hpp"
#include "fibers/posix/descriptors/pace.hpp"
#include "fibers/posix/exec/exploration.hpp"
#include "fibers/posix/family/turn.hpp"
#include "fibers/posix/program/program.hpp"
#include "fibers/posix/reports/history.hpp"
#include "fibers/posix/time/clocks.hpp"

namespace waitpoint::posix {
namespace {

using family::Process;

// A native process may be at the other end of whatever others wait for.
bool waits_for_others(bool outside, const Process& process) {
  return family::takes_turns(process) && (outside || (process.listens_to != 0 && family::has_natives()));
}
bool waits_outside(const Process& process) { return waits_for_others(process.waits_outside, process); }
bool awaits_outsiders(const Process& process) { return waits_for_others(process.awaits_outsiders, process); }

// True if natives are at the other end of whatever the family's processes wait for.
bool is_in_real_time() {
  return family::has_natives() || std::ranges::any_of(family::entries(), [](const Process& process) {
           return family::takes_turns(process) && process.has_partner;
         });
}

// Notes whether a thread of this process has run since the last call: it may have acted on a socket, say.
void note_actions(const kernel::Scheduler& scheduler) {
  static std::uint64_t switches_before = 0;
  if (kernel::switches(scheduler) == switches_before) return;
  switches_before = kernel::switches(scheduler);
  ++family::family->actions;
  // Alone it may have acted by the C library's output, which is not noticed.
  if (!family::has_others()) family::own->is_to_look = true;
}

// True if the process is to look outside at the end of this instant: after an action of its own, a wait's begin, or the
// wait for what may be under way at sockets of the family; with a partner or a native process in real time, at each
// instant once, and again after each action of the family; with a possible partner from time to time. What others of
// the family do rings it.
bool is_to_look(const Process& process, Time now) {
  if (!waits_outside(process)) return false;
  if (process.is_to_look || process.looked_after < family::family->settled_after) return true;
  if (process.looked_at == now) return is_in_real_time() && process.looked_after != family::family->actions;
  constexpr Duration from_time_to_time = Duration(std::chrono::milliseconds(1));
  return is_in_real_time() || (process.awaits_outsiders && later(process.looked_at, from_time_to_time) <= now);
}

bool let_all_look(Time now) {
  bool any = false;
  for (Process& process : family::entries()) {
    if (!is_to_look(process, now)) continue;
    process.is_to_look = false;
    process.looked_at = now;
    process.looked_after = family::family->actions;
    if (&process == family::own)
      any = look_outside(false) || any;
    else
      family::ring(process);
  }
  return any;
}

// True if another process waits for descriptors: the C library's output makes no call that could be noticed.
bool anybody_listens() {
  for (const Process& process : family::entries())
    if (&process != family::own && (process.listens_to & family::of_descriptors) != 0) return true;
  return false;
}

// The next process after this one, in the table's order, that waits outside; null if none does.
Process* next_waiting_outside() {
  const std::span<Process> all = family::entries();
  const std::size_t own = family::index_of(*family::own);
  for (std::size_t i = 1; i <= all.size(); ++i)
    if (Process& process = all[(own + i) % all.size()]; waits_outside(process)) return &process;
  return nullptr;
}

// No process can continue by itself. False if none waits for something outside, or all wait for each other at sockets.
bool wait_outside_together(kernel::Scheduler& scheduler) {
  Process* const next = next_waiting_outside();
  if (next == nullptr) return false;
  if (std::ranges::none_of(family::entries(), awaits_outsiders)) {
    family::Family& all = *family::family;
    if (all.settled_after == all.actions) return false;
    wait_outside_for(time_under_way);
    all.settled_after = ++all.actions;  // so that all look once more
    return true;
  }
  if (!waits_outside(*family::own)) {
    family::hand_over_to(scheduler, *next);
    return true;
  }
  // Each in turn, for a short time, if there are several.
  const bool is_only = next == family::own;
  wait_outside_for(is_only ? Duration::max() : Duration(std::chrono::milliseconds(2)));
  if (!look_outside(false) && !is_only) family::hand_over_to(scheduler, *next);
  return true;
}

// True while the next event, of any process, must wait for real time.
bool must_wait(const kernel::Scheduler& scheduler, Time next, Time now) {
  return next > now && next != Time::max() && is_paced(scheduler) && left_until(next) > Duration();
}

// Waits for the next event in real time, in short parts, in which the other processes look outside, too. True if
// something has come to this one.
bool wait_for_pace(const kernel::Scheduler& scheduler, Time next, Time now) {
  constexpr Duration part = Duration(std::chrono::milliseconds(2));
  while (must_wait(scheduler, next, now)) {
    wait_outside_for(std::min(left_until(next), part));
    if (look_outside(false)) return true;
    bool any = false;
    for (Process& process : family::entries()) {
      if (&process == family::own || !waits_outside(process)) continue;
      family::ring(process);
      any = true;
    }
    if (any) return false;
  }
  return false;
}

}  // namespace

Time end_of_left_over() {
  const family::Family& all = *family::family;
  const Process::State first = all.processes[0].state;
  if (first != Process::State::ended && first != Process::State::none) return Time::max();
  return later(later(all.first_ended_at, family::left_over_at_most), nanosecond);
}

bool step_in_family(kernel::Scheduler& scheduler, Time& until) {
  family::Family& all = *family::family;
  if (record->recorder != nullptr) record->recorder->pause();
  do {
    if (all.is_over) return false;
    note_actions(scheduler);
    if (const family::Changes changes = family::take_ring(scheduler); changes != 0) look_outside(false, changes);
    if (anybody_listens() && has_unnoticed_output()) family::ring(family::of_descriptors);
    const Time ring = family::own->is_rung ? family::own->rung_at : Time::max();
    const Time own = std::min(kernel::next_event_time(scheduler), ring);
    const Time next = std::min(own, family::least_of_others().time);
    const Time now = std::max(all.now, kernel::global_time(scheduler));
    if (next > now && let_all_look(now)) break;
    if (wait_for_pace(scheduler, next, now)) break;
    if (const Time end = end_of_left_over(); end != Time::max() && next >= end) {
      all.is_over = all.is_cut_off = true;
      return false;
    }
    if (record->explored != nullptr) {
      if (Process* const chosen = record->explored->processes->take_chosen(); chosen != nullptr) {
        chosen->is_chosen = true;
        family::hand_over_to(scheduler, *chosen);
        continue;
      }
    }
    // A ring made above is an event of this instant.
    if (family::hand_over_if_due(scheduler)) continue;
    if (own == Time::max() && family::least_of_others().time == Time::max() && !wait_outside_together(scheduler)) {
      all.is_over = true;
      return false;
    }
  } while ((family::own->is_rung && family::own->rung_at <= kernel::next_event_time(scheduler)) ||
           must_wait(scheduler, kernel::next_event_time(scheduler), std::max(all.now, kernel::global_time(scheduler))));
  until = record->settings.until;
  if (next_waiting_outside() != nullptr || (anybody_listens() && may_have_unnoticed_output()))
    until = std::min(until, later(std::max(kernel::next_event_time(scheduler), all.now), nanosecond));
  return true;
}

}  // namespace waitpoint::posix
