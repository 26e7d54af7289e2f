// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/family/processes.hpp"

#include <fcntl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <new>

#include "core/error.hpp"
#include "fibers/posix/base/error_number.hpp"
#include "fibers/posix/base/interposed.hpp"
#include "fibers/posix/family/order.hpp"
#include "fibers/posix/family/system_processes.hpp"
#include "fibers/posix/program/program.hpp"

namespace waitpoint::posix::family {

namespace {

bool is_listed(const Process& process) { return process.state != Process::State::none; }
bool is_alive(const Process& process) { return is_listed(process) && process.state != Process::State::ended; }

// Its digest, while the process may still be in the table.
void count_digest(Process& process) {
  keep_digest_of(process, process.digest);
  process.digest = PairDigest();
}

// The parent finds the status with wait(); unless it ignores its children's ends.
void tell_parent(Process& process, int code) {
  Process* const parent = find(process.parent);
  if (parent == nullptr || !is_alive(*parent)) {
    if (process.state == Process::State::ended) remove(process);
    return;
  }
  const bool is_dropped = parent->drops_children && process.state == Process::State::ended;
  siginfo_t information{};
  information.si_signo = SIGCHLD;
  information.si_code = code;
  information.si_pid = process.id;
  information.si_uid = getuid();
  information.si_status = WIFEXITED(process.status) ? WEXITSTATUS(process.status) : process.status & 0x7F;
  if (is_dropped) remove(process);
  if (!is_dropped) send_letter(*parent, information, 0);
  ring(*parent);
}

}  // namespace

Process* find(pid_t id) {
  if (family == nullptr || id <= no_parent) return nullptr;
  for (Process& each : entries())
    if (is_listed(each) && each.id == id) return &each;
  return nullptr;
}

pid_t in_system(pid_t id) {
  const Process* const process = find(id);
  return process != nullptr ? process->real_id.load() : id;
}

pid_t next_id() { return ++family->last_id; }

Process* add() {
  // The first entry stays the first process's.
  const auto is_free = [](const Process& each) { return !is_listed(each) && &each != family->processes; };
  const std::span<Process> used = entries();
  auto free = std::find_if(used.begin(), used.end(), is_free);
  if (free == used.end() && family->entries == processes_max) return nullptr;
  if (free == used.end()) ++family->entries;
  free->~Process();
  Process& made = *new (&*free) Process();
  made.state = Process::State::alive;
  made.id = next_id();
  if (own != nullptr) {
    made.parent = own->id;
    made.group = own->group;
    made.session = own->session;
    made.drops_children = own->drops_children;
  } else {
    made.group = made.session = made.id;
  }
  ++family->made;
  ++family->alive;
  return &made;
}

void keep_digest_of(const Process& process, const PairDigest& digest) {
  family->digest_of_ended += share_of_digest(process.id, digest);
  family->events_of_ended += digest.pairs();
}

void set_native(Process& process, bool is_native) {
  if (process.is_native == is_native) return;
  process.is_native = is_native;
  is_native ? --family->alive : ++family->alive;
}

bool has_native_child() {
  return std::ranges::any_of(
      entries(), [](const Process& each) { return is_listed(each) && each.is_native && each.parent == own->id; });
}

bool has_natives() {
  return std::ranges::any_of(entries(), [](const Process& each) { return is_alive(each) && each.is_native; });
}

void remove(Process& process) {
  if (is_alive(process) && !process.is_native) --family->alive;
  process.state = Process::State::none;
}

void note_end_of(Process& process, int status) {
  WAITPOINT_CHECK(is_alive(process), "a process ends twice");
  process.state = Process::State::ended;
  process.status = status;
  process.next = kernel::EventKey::never();
  process.listens_to = 0;
  process.is_rung = process.waits_outside = false;
  count_digest(process);
  ++family->actions;
  if (!process.is_native) --family->alive;
  if (&process == family->processes) family->first_ended_at = family->now;
  for (Process& each : entries()) {
    if (!is_listed(each) || each.parent != process.id) continue;
    each.parent = no_parent;
    if (each.state == Process::State::ended) remove(each);
  }
  ring(of_anything);
  tell_parent(process, WIFEXITED(status) ? CLD_EXITED : WCOREDUMP(status) ? CLD_DUMPED : CLD_KILLED);
}

void note_stop_of(Process& process, int signal) {
  if (process.state != Process::State::alive) return;
  process.state = Process::State::stopped;
  process.is_unnoted = true;
  process.continued = false;
  process.status = signal << 8 | 0x7F;
  tell_parent(process, CLD_STOPPED);
}

void note_continuation_of(Process& process) {
  if (process.state != Process::State::stopped) return;
  process.state = Process::State::alive;
  process.is_unnoted = false;
  process.continued = true;
  process.status = 0xFFFF;
  tell_parent(process, CLD_CONTINUED);
}

Process* find_in_system(pid_t system_id) {
  if (family == nullptr || system_id <= 0) return nullptr;
  for (Process& each : entries())
    if (is_listed(each) && each.real_id.load() == system_id) return &each;
  return nullptr;
}

bool send_letter(Process& to, const siginfo_t& information, pid_t thread) {
  if (to.letters == Process::letters_max) return false;
  to.inbox[to.letters++] = {information, thread};
  ring(to);
  return true;
}

pid_t this_process() { return own != nullptr ? own->id : system_id(); }

bool lives(pid_t process) {
  if (own == nullptr) return is_running(process);
  const Process* const found = find(process);
  return found != nullptr && is_alive(*found);
}

bool note_waiting_for(pid_t holder) {
  if (own == nullptr) return true;
  own->waits_for = holder;
  for (int steps = 0; holder != 0 && steps < processes_max; ++steps) {
    const Process* const next = find(holder);
    holder = next != nullptr ? next->waits_for : 0;
    if (holder == own->id) {
      own->waits_for = 0;
      return false;
    }
  }
  return true;
}

}  // namespace waitpoint::posix::family
