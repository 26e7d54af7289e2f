// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/family/lasting_waits.hpp"

#include <cstdio>

#include "core/lasting_wait.hpp"
#include "fibers/kernel/task.hpp"
#include "fibers/posix/family/family.hpp"
#include "fibers/posix/family/processes.hpp"
#include "fibers/posix/family/task_names.hpp"

namespace waitpoint::posix {
namespace {

constexpr int waits_max = 256;

struct Waits {
  struct Wait {
    bool is_used;
    pid_t process;
    Time since;
    LastingWait told;
  } all[waits_max];
};

// Null if waits are not noted.
Waits* noted() {
  if (family::family == nullptr) return nullptr;
  return static_cast<Waits*>(family::common(family::Part::waits, 0));
}

// A negative number if they are not noted, or too many.
int note(const char* what, bool is_told) {
  Waits* const waits = noted();
  if (waits == nullptr || kernel::running == nullptr) return -1;
  for (int place = 0; place < waits_max; ++place) {
    Waits::Wait& wait = waits->all[place];
    if (wait.is_used) continue;
    wait = {true, family::own->id, kernel::running->local_time, {}};
    BoundedText thread(wait.told.thread, sizeof wait.told.thread);
    add_name(thread, *kernel::running);
    std::snprintf(wait.told.what, sizeof wait.told.what, "%s", what);
    wait.told.is_told = is_told;
    return place;
  }
  return -1;
}

void forget(int place) {
  if (Waits* const waits = noted(); waits != nullptr && place >= 0 && place < waits_max)
    waits->all[place].is_used = false;
}

// Those of a process that has ended have ended with it.
bool is_there(pid_t id) {
  for (const family::Process& process : family::entries())
    if (process.id == id && process.state != family::Process::State::none)
      return process.state != family::Process::State::ended;
  return false;
}

}  // namespace

NotedWait::NotedWait(const kernel::Task& owner) {
  if (noted() == nullptr) return;
  char what[sizeof(LastingWait::what)];
  BoundedText text(what, sizeof what);
  text.add("a mutex that ");
  add_name(text, owner);
  text.add(" holds");
  place_ = note(what, false);
}

NotedWait::~NotedWait() { forget(place_); }

}  // namespace waitpoint::posix

using waitpoint::LastingWait;
namespace posix = waitpoint::posix;

extern "C" {

[[gnu::visibility("default")]] void waitpoint_note_waits() {
  if (posix::family::family != nullptr) (void)posix::family::common(posix::family::Part::waits, sizeof(posix::Waits));
}

[[gnu::visibility("default")]] int waitpoint_begin_wait(const char* what) { return posix::note(what, true); }

[[gnu::visibility("default")]] void waitpoint_end_wait(int wait) { posix::forget(wait); }

[[gnu::visibility("default")]] int waitpoint_next_wait(int place, LastingWait* wait) {
  posix::Waits* const waits = posix::noted();
  for (; waits != nullptr && place >= 0 && place < posix::waits_max; ++place) {
    posix::Waits::Wait& found = waits->all[place];
    found.is_used = found.is_used && posix::is_there(found.process);
    if (!found.is_used) continue;
    *wait = found.told;
    wait->lasts_ns = (posix::family::family->now - found.since).ns();
    return place + 1;
  }
  return -1;
}

}  // extern "C"
