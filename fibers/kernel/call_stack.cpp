// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/kernel/call_stack.hpp"

#include <unwind.h>

#include <cstdio>

#include "fibers/kernel/scheduler.hpp"

namespace waitpoint::kernel {
namespace {

struct Capture {
  void** frames;
  std::size_t room;
  std::size_t found;
};

_Unwind_Reason_Code add_frame(_Unwind_Context* context, void* argument) {
  Capture& capture = *static_cast<Capture*>(argument);
  void* address = reinterpret_cast<void*>(_Unwind_GetIP(context));
  // Beyond a fiber's first frame there is no caller.
  if (address == nullptr || capture.found == capture.room) return _URC_END_OF_STACK;
  capture.frames[capture.found++] = address;
  return _URC_NO_REASON;
}

}  // namespace

std::size_t capture_call_stack(void** frames, std::size_t room) {
  Capture capture{frames, room, 0};
  _Unwind_Backtrace(add_frame, &capture);
  return capture.found;
}

void describe_run(const Task& task) {
  const long long ns = task.local_time.ns();
  std::fprintf(stderr, "  at virtual time %lld.%09lld s, in task %s of %s, at its event %llu (%s), seed %llu\n",
               ns / 1'000'000'000, ns % 1'000'000'000, task.name, task.robot->name,
               static_cast<unsigned long long>(task.sequence), name(task.operation),
               static_cast<unsigned long long>(task.scheduler->chooser().seed()));
  if (task.scheduler->replay()[0] != '\0') std::fprintf(stderr, "  replay: %s\n", task.scheduler->replay());
}

}  // namespace waitpoint::kernel
