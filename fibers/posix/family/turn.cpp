// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/family/turn.hpp"

#include <linux/futex.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <ctime>
#include <utility>

#include "core/error.hpp"
#include "fibers/kernel/common_order.hpp"
#include "fibers/kernel/run.hpp"
#include "fibers/kernel/run_window.hpp"
#include "fibers/posix/base/direct_call.hpp"
#include "fibers/posix/base/error_number.hpp"
#include "fibers/posix/base/interposed.hpp"
#include "fibers/posix/base/real_waits.hpp"
#include "fibers/posix/family/order.hpp"
#include "fibers/posix/family/system_processes.hpp"
#include "fibers/posix/program/program.hpp"

namespace waitpoint::posix::family {
namespace {

bool is_joined_ = false;

long futex(std::atomic<std::uint32_t>& word, int operation, std::uint32_t value, const timespec* timeout) {
  return call_directly(SYS_futex, reinterpret_cast<long>(&word), operation, value, reinterpret_cast<long>(timeout));
}

void sleep_really(const timespec& span) { call_directly(SYS_nanosleep, reinterpret_cast<long>(&span)); }

void note_time(const kernel::Scheduler& scheduler) {
  if (family->now < kernel::global_time(scheduler)) family->now = kernel::global_time(scheduler);
}

void give_turn(Process& to) {
  family->holder.store(index_of(to));
  to.has_turn.store(1);
  futex(to.has_turn, FUTEX_WAKE, 1, nullptr);
}

// True if the process that had the turn was killed, and this one has taken it.
bool take_from_killed() {
  std::uint32_t index = family->holder.load();
  Process& holder = family->processes[index];
  const pid_t known_as = holder.real_id.load();
  if (&holder == own || known_as == 0 || is_running(known_as)) return false;
  if (!family->holder.compare_exchange_strong(index, index_of(*own))) return false;
  if (holder.state == Process::State::ended || holder.state == Process::State::none) return true;
  // The same follows, at the same time, whichever process has found it.
  if (kernel::global_time(record->scheduler()) < family->now) kernel::advance(record->scheduler(), family->now);
  const bool concerns_own = holder.parent == own->id || (own->listens_to & of_anything) != 0;
  note_end_of(holder, status_of_zombie(known_as));
  if (concerns_own && (!own->is_rung || own->rung_at > family->now)) {
    own->is_rung = true;
    own->rung_at = family->now;
    own->rung_for = of_anything;
  }
  return true;
}

void await_end_of_leaving() {
  constexpr timespec soon{0, 20'000};
  while (is_running(family->leaving)) sleep_really(soon);
  family->leaving = 0;
}

void await_turn() {
  const ErrorNumberKept kept;
  const RealWait real;
  for (;;) {
    if (own->has_turn.exchange(0) != 0) {
      if (family->leaving != 0) await_end_of_leaving();
      return;
    }
    constexpr timespec patience{0, 20'000'000};
    if (futex(own->has_turn, FUTEX_WAIT, 0, &patience) != -ETIMEDOUT || !take_from_killed()) continue;
    Process* const least = least_other();
    if (least == nullptr || precedes(*own, *least)) return;
    give_turn(*least);
  }
}

}  // namespace

void begin() {
  family = new (reinterpret_cast<void*>(family_address)) Family;
  family->settings = record->settings;
  family->file = record->file;
  family->arena.start(family + 1, reinterpret_cast<char*>(family_address + family_bytes));
  own = add();
  own->real_id = system_id();
}

void join(int index) {
  family = reinterpret_cast<Family*>(family_address);
  if (family->mark != Family::mark_of_version) refuse("the family's memory is of another version");
  own = &family->processes[index];
  own->real_id = system_id();
  is_joined_ = true;
  if (!std::exchange(own->executes, false)) await_turn();
  own->borrows = false;
  ring(of_anything);
}

bool is_joined() { return is_joined_; }

Process* expect_child() {
  Process* const child = add();
  if (child == nullptr) return nullptr;
  child->next = kernel::EventKey::never();
  const auto number = static_cast<int>(child->id);
  std::snprintf(child->name, sizeof child->name, "%.36s#%d", program_invocation_short_name, number);
  return child;
}

void let_begin(Process& child) {
  kernel::Task& task = *kernel::running;
  kernel::Chooser& chooser = kernel::chooser(*task.scheduler);
  const std::uint64_t tie =
      chooser.order() == kernel::Order::seeded ? tie_of_first(chooser.seed(), task.id, child) : kernel::tie_mask;
  child.next = {task.local_time, kernel::make_order(kernel::Phase::tasks, tie)};
}

void note_child(Process& child, pid_t real_id) {
  if (real_id <= 0) return remove(child);
  child.real_id = real_id;
  limit_window(*kernel::running->scheduler);
  kernel::pause(*kernel::running->scheduler);  // from now on the ends of windows depend on the other processes
}

void begin_as_child(Process& child) {
  child.caught = own->caught;
  own = &child;
  own->real_id = system_id();
  await_turn();
}

bool hand_over_if_due(kernel::Scheduler& scheduler) {
  remove_limit(scheduler);
  note_time(scheduler);
  own->next = kernel::next_key(scheduler);
  Process* const least = least_other();
  if (least == nullptr || key_of(*least).time == Time::max()) return false;
  if (precedes(*own, *least)) return false;
  const bool ties =
      kernel::chooser(scheduler).order() == kernel::Order::explored && own->next.time == key_of(*least).time;
  if (ties && kernel::phase_of(key_of(*least).order) >= kernel::Phase::tasks) return false;
  if (family->now < key_of(*least).time) family->now = key_of(*least).time;
  ++family->hand_overs;
  give_turn(*least);
  await_turn();
  return true;
}

void hand_over_to(kernel::Scheduler& scheduler, Process& process) {
  remove_limit(scheduler);
  note_time(scheduler);
  own->next = kernel::next_key(scheduler);
  ++family->hand_overs;
  give_turn(process);
  await_turn();
}

Changes take_ring(kernel::Scheduler& scheduler) {
  if (!own->is_rung || kernel::next_event_time(scheduler) < own->rung_at) return 0;
  own->is_rung = false;
  if (kernel::global_time(scheduler) < own->rung_at) kernel::advance(scheduler, own->rung_at);
  return std::exchange(own->rung_for, 0);
}

void (*before_leaving)() = nullptr;

void leave(int status) {
  if (own == nullptr || own->state == Process::State::ended) return;
  if (before_leaving != nullptr) before_leaving();
  const bool is_alone = !has_others();
  note_time(record->scheduler());
  note_end_of(*own, status);
  if (is_alone) return;
  // What the system does at a process's end must have happened when another continues: see await_turn().
  family->leaving = system_id();
  if (Process* const least = least_other(); least != nullptr) give_turn(*least);
}

void kill_at_once(Process& process) {
  const ErrorNumberKept kept;
  const pid_t known_as = process.real_id;
  WAITPOINT_NEXT(kill)(known_as, SIGKILL);
  constexpr timespec soon{0, 50'000};
  while (is_running(known_as)) sleep_really(soon);
  note_end_of(process, SIGKILL);
}

void stop(int signal) {
  note_stop_of(*own, signal);
  own->next = kernel::EventKey::never();
  while (own->state == Process::State::stopped) {
    Process* const least = least_other();
    if (least == nullptr) refuse("the program has stopped itself, and no other process of it can continue it");
    give_turn(*least);
    await_turn();
  }
}

void let_execute_natively(bool natively) {
  if (natively) ring(of_anything);  // its parent waits for it in the system from now on
  set_native(*own, natively);
  if (natively) {
    if (Process* const least = least_other(); least != nullptr) give_turn(*least);
  } else {
    own->next = {family->now, kernel::make_order(kernel::Phase::tasks, 0)};
    await_turn();
  }
}

}  // namespace waitpoint::posix::family
