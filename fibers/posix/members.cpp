// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/members.hpp"

#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "fibers/posix/interposed.hpp"
#include "fibers/posix/program.hpp"
#include "fibers/posix/waiting.hpp"

extern "C" void __call_tls_dtors();  // of the C library

namespace waitpoint::posix {
namespace {

constexpr char separator[] = "::";

pid_t home = 0;  // the process in which the members are

void* run_member(void* argument) {
  Member& member = *static_cast<Member*>(argument);
  std::exit(call_main(member.image, member.argc, member.argv));
}

// What is registered meanwhile comes next.
void call_handlers(Member& member) {
  while (member.handlers != nullptr) {
    ExitHandler* const handler = member.handlers;
    member.handlers = handler->next;
    handler->function(handler->argument);
    std::free(handler);
  }
  call_destructors(member.image);
}

// 0 if it is that of all, else that of the first on the command line that has another.
int status_of_all(const Record& all) {
  const ProgramRecord* failed = nullptr;
  for (const ProgramRecord& one : all.several())
    if (one.status != 0 && (failed == nullptr || one.place < failed->place)) failed = &one;
  return failed == nullptr ? 0 : failed->status;
}

// The words of one program: those up to the next separator, in whose place is the end of its arguments.
int count_words(char** words) {
  int count = 0;
  while (words[count] != nullptr && std::strcmp(words[count], separator) != 0) ++count;
  return count;
}

}  // namespace

bool start(Member& member, kernel::Scheduler& scheduler) {
  home = getpid();
  member.is_member = true;
  return make_main_thread(member, scheduler, run_member, &member) != nullptr;
}

void drop(Member& member, kernel::Scheduler& scheduler) {
  end_other_threads(member, scheduler);
  while (member.handlers != nullptr) {
    ExitHandler* const handler = member.handlers;
    member.handlers = handler->next;
    std::free(handler);
  }
  unload(member.image);
}

bool runs_in_member() { return is_simulated() && this_program().is_member && getpid() == home; }

void exit_member(int status) {
  Member& member = this_member();
  // Whoever exits first does it; the others are waited for by nobody.
  if (member.exiting) end_running_thread();
  member.exiting = true;
  __call_tls_dtors();
  call_handlers(member);
  std::fflush(nullptr);
  end_member(status);
}

void end_member(int status) {
  Member& member = this_member();
  kernel::Scheduler& scheduler = *kernel::running->scheduler;
  end_other_threads(member, scheduler);
  member.ended = true;
  member.status = status & 0xFF;
  if (member.record != nullptr) {
    member.record->ended = true;
    member.record->status = member.status;
  }
  end_running_thread();
}

void end_member_with_last_thread() {
  if (!runs_in_member() || this_member().exiting) return;
  for (const kernel::Task* task = kernel::running->scheduler->first_task(); task != nullptr; task = task->next)
    if (task != kernel::running && is_thread(*task) && thread_of(*task).program == &this_program()) return;
  exit_member(0);
}

// Loaded before the run, of which there may be many by a fork each.
void run_members(int argc, char** argv) {
  const std::uint32_t count = record->program_count;
  auto* const members = static_cast<Member*>(std::calloc(count, sizeof(Member)));
  if (members == nullptr) refuse("there is no memory for the programs");
  char** words = argv + 1;
  for (std::uint32_t i = 0; i < count; ++i) {
    Member& member = *new (members + i) Member();
    member.argc = count_words(words);
    member.argv = words;
    words += member.argc + 1;
    if (words - argv <= argc) words[-1] = nullptr;
    LoadError error;
    if (!load(member.image, member.argv[0], error)) refuse(error);
  }
  kernel::Scheduler& scheduler = begin_run();
  for (std::uint32_t i = 0; i < count; ++i) {
    Member& member = members[i];
    member.record = record->programs + i;
    member.robot = &member.record->robot;
    scheduler.add(member.record->robot, member.record->name);
    if (!start(member, scheduler)) refuse("there is no address space for the stacks of threads");
  }
  run_to_end(scheduler);
  end_run(scheduler, status_of_all(*record));
}

}  // namespace waitpoint::posix
