// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/kernel/call_stack.hpp"

#include <unwind.h>

#include "fibers/kernel/run.hpp"
#include "fibers/kernel/signal_safe_text.hpp"

namespace waitpoint::kernel {
namespace {

struct Capture {
  void** frames;
  std::size_t room;
  std::size_t found;
};

_Unwind_Reason_Code add_frame(_Unwind_Context* context, void* argument) {
  Capture& capture = *static_cast<Capture*>(argument);
  int is_interrupted = 0;
  char* address = reinterpret_cast<char*>(_Unwind_GetIPInfo(context, &is_interrupted));
  // Above the frame that a signal interrupted are the handler's.
  if (is_interrupted != 0) capture.found = 0;
  // A fiber's first frame has no caller.
  if (address == nullptr || capture.found == capture.room) return _URC_END_OF_STACK;
  capture.frames[capture.found++] = address + is_interrupted;
  return _URC_NO_REASON;
}

}  // namespace

std::size_t capture_call_stack(void** frames, std::size_t room) {
  Capture capture{frames, room, 0};
  _Unwind_Backtrace(add_frame, &capture);
  return capture.found;
}

void describe_run(const Task& task) {
  SignalSafeText text;
  text.add("  at virtual time ").add(task.local_time).add(" s, in task ").add(task.name).add(" of ");
  text.add(task.robot->name).add(", at its event ").add(task.sequence).add(" (").add(name(task.operation));
  text.add(")");
  const Chooser& chooser = kernel::chooser(*task.scheduler);
  if (chooser.order() != Order::explored) text.add(", seed ").add(chooser.seed());  // else a strategy decides
  text.add("\n").write();
  if (task.work.what != nullptr) {
    SignalSafeText work;
    work.add("  in ").add(task.work.what).add(" of ").add(task.work.of).add("\n").write();
  }
  SignalSafeText replay;
  const char* const command = hooks(*task.scheduler).replay;
  if (command[0] != '\0') replay.add("  replay: ").add(command).add("\n").write();
}

}  // namespace waitpoint::kernel
