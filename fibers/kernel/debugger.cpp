// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/kernel/debugger.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>

#include "fibers/kernel/task.hpp"

namespace waitpoint::kernel {

DebuggerView debugger_view;

// Empty functions for a debugger's breakpoints; the calls are not optimised away.
[[gnu::noinline]] void debugger_run() { asm volatile(""); }
[[gnu::noinline]] void debugger_stop() { asm volatile(""); }
[[gnu::noinline]] void debugger_checkpoint() { asm volatile(""); }

void tell_debugger(Scheduler& scheduler) {
  std::atomic_ref(debugger_view.scheduler).store(&scheduler, std::memory_order_relaxed);
  debugger_run();
}

void tell_debugger_of_end(const Scheduler& scheduler) {
  auto* ended = const_cast<Scheduler*>(&scheduler);
  std::atomic_ref(debugger_view.scheduler).compare_exchange_strong(ended, nullptr);
}

void show_debugger(Time now, const Task& task, Operation operation, const Object* object) {
  DebuggerView& view = debugger_view;
  view.before = view.last;
  view.last = {now, task.id, object != nullptr ? object->identity : 0, operation};
  ++view.events;
  const bool stops = view.events == view.stop_at_event || now >= view.stop_at_time || task.id == view.stop_at_task;
  if (view.events >= view.checkpoint_at) {
    view.restarted = false;
    debugger_checkpoint();
    if (view.restarted) return;  // `stops` belongs to the time of the checkpoint
  }
  if (stops) debugger_stop();
}

namespace {

// Beyond a program's descriptors, so that files opened in a replay get the same numbers as before.
constexpr int kept_from = 1000;

struct Muted {
  int descriptor;
  int kept = -1;
};
Muted outputs[] = {{1}, {2}};

bool is_file(int descriptor) {
  struct stat status {};
  return fstat(descriptor, &status) != 0 || S_ISREG(status.st_mode);
}

}  // namespace

/// Called by the debugger: redirects the process's standard output and error to /dev/null, or restores them. For
/// replays, whose output would appear a second time. Regular files are left alone: a checkpoint holds their offsets,
/// and the replay writes the same content.
[[gnu::used]] void debugger_mute(int muted) {
  for (Muted& output : outputs) {
    if (muted == 0) {
      if (output.kept < 0) continue;
      dup2(output.kept, output.descriptor);
      close(output.kept);
      output.kept = -1;
    } else if (output.kept < 0 && !is_file(output.descriptor)) {
      output.kept = fcntl(output.descriptor, F_DUPFD_CLOEXEC, kept_from);
      const int nowhere = output.kept < 0 ? -1 : open("/dev/null", O_WRONLY | O_CLOEXEC);
      if (nowhere < 0) continue;
      dup2(nowhere, output.descriptor);
      close(nowhere);
    }
  }
}

}  // namespace waitpoint::kernel
