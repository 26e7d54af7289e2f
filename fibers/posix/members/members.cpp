// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/members/members.hpp"

#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "core/error.hpp"
#include "fibers/posix/base/interposed.hpp"
#include "fibers/posix/input_output/descriptor_table.hpp"
#include "fibers/posix/ipc/system_v_ends.hpp"
#include "fibers/posix/program/program.hpp"
#include "fibers/posix/signals/signals.hpp"
#include "fibers/posix/threads/thread.hpp"
#include "fibers/posix/threads/variables.hpp"
#include "fibers/posix/timers/program_timers.hpp"

namespace waitpoint::posix {

namespace {

pid_t home = 0;  // the process in which the members are

void* run_member(void* argument) {
  Member& member = *static_cast<Member*>(argument);
  std::exit(call_main(member.image, member.argc, member.argv));
}

// Handlers registered by a handler are called next.
void call_handlers(Member& member) {
  while (member.handlers != nullptr) {
    ExitHandler* const handler = member.handlers;
    member.handlers = handler->next;
    handler->function(handler->argument);
    std::free(handler);
  }
  call_destructors(member.image);
}

// As a shell reports it.
void end_by_signal(int signal) { end_member(128 + signal); }

void end_with_last_thread() {
  if (!runs_in_member() || this_member().exiting) return;
  for (const kernel::Task* task = kernel::running->scheduler->first_task(); task != nullptr; task = task->next)
    if (task != kernel::running && is_thread(*task) && thread_of(*task).program == &this_program()) return;
  exit_member(0);
}

void forget_what_is_sent_to(Member& member) {
  forget_timers_of(member);
  member.signals.pending.drop(~SignalSet{0});
}

void forget_directory(Member& member) {
  if (member.directory != directory_of_process) WAITPOINT_NEXT(close)(member.directory);
  member.directory = directory_of_process;
}

}  // namespace

bool start(Member& member, kernel::Scheduler& scheduler) {
  WAITPOINT_CHECK(member.robot != nullptr && member.image.program != nullptr && !member.ended,
                  "a member starts before it is loaded, or after it has ended");
  home = getpid();
  member.is_member = true;
  member.thread_ends = end_with_last_thread;
  member.ends_by = end_by_signal;
  // A write without a reader ends the program that makes it.
  for (const int signal : {SIGPIPE, SIGXFSZ}) install(signal);
  return make_main_thread(member, scheduler, run_member, &member) != nullptr;
}

void drop(Member& member, kernel::Scheduler& scheduler) {
  WAITPOINT_CHECK(kernel::running == nullptr, "a member is dropped from within a task");
  end_other_threads(member, scheduler);
  forget_what_is_sent_to(member);
  close_descriptors_of(member);
  while (member.handlers != nullptr) {
    ExitHandler* const handler = member.handlers;
    member.handlers = handler->next;
    std::free(handler);
  }
  forget_directory(member);
  unload(member.image);
}

bool runs_in_member() { return is_simulated() && this_program().is_member && getpid() == home; }

void exit_member(int status) {
  Member& member = this_member();
  // Only the first thread that exits calls the handlers; no thread waits for the others.
  if (member.exiting) end_running_thread();
  member.exiting = true;
  destroy_variables();
  call_handlers(member);
  std::fflush(nullptr);
  end_member(status);
}

void end_member(int status) {
  Member& member = this_member();
  kernel::Scheduler& scheduler = *kernel::running->scheduler;
  end_other_threads(member, scheduler);
  forget_what_is_sent_to(member);
  close_descriptors_of(member);
  system_v::undo_semaphores_of(member);
  member.ended = true;
  member.status = status & 0xFF;
  end_running_thread();
}

}  // namespace waitpoint::posix
