// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/in_process/loaded_program.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <new>

#include "core/error.hpp"
#include "fibers/kernel/run.hpp"
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

pid_t home = 0;  // the process in which the programs are

void* run_loaded_program(void* argument) {
  LoadedProgram& program = *static_cast<LoadedProgram*>(argument);
  std::exit(call_main(program.image, program.argc, program.argv));
}

// Handlers registered by a handler are called next.
void call_handlers(LoadedProgram& program) {
  while (program.handlers != nullptr) {
    ExitHandler* const handler = program.handlers;
    program.handlers = handler->next;
    handler->function(handler->argument);
    std::free(handler);
  }
  call_destructors(program.image);
}

void end_by_signal(int signal) { end_program(W_EXITCODE(0, signal)); }

void end_with_last_thread() {
  if (!runs_in_loaded_program() || this_loaded_program().exiting) return;
  for (const kernel::Task* task = kernel::first_task(*kernel::running->scheduler); task != nullptr; task = task->next)
    if (task != kernel::running && is_thread(*task) && thread_of(*task).program == &this_program()) return;
  exit_program(0);
}

void forget_what_is_sent_to(LoadedProgram& program) {
  forget_timers_of(program);
  program.signals.pending.drop(~SignalSet{0});
}

void forget_directory(LoadedProgram& program) {
  if (program.directory != directory_of_process) WAITPOINT_NEXT(close)(program.directory);
  program.directory = directory_of_process;
}

void free_words(LoadedProgram& program) {
  for (int i = 0; i < program.argc; ++i) std::free(program.argv[i]);
  std::free(program.argv);
}

}  // namespace

LoadedProgram* load(const char* name, int argc, const char* const* argv, LoadError& error) {
  WAITPOINT_CHECK(argc > 0 && argv != nullptr && argv[0] != nullptr, "a program has no file");
  void* const memory = std::calloc(1, sizeof(LoadedProgram));
  auto** const words = static_cast<char**>(std::calloc(static_cast<std::size_t>(argc) + 1, sizeof(char*)));
  if (memory == nullptr || words == nullptr) {
    std::free(memory);
    std::free(words);
    std::snprintf(error, sizeof error, "there is no memory for it");
    return nullptr;
  }
  LoadedProgram& program = *new (memory) LoadedProgram();
  std::snprintf(program.label_text, sizeof program.label_text, "%s: ", name);
  for (int i = 0; i < argc; ++i) words[i] = strdup(argv[i]);
  program.label = program.label_text;
  program.is_service = true;
  program.argc = argc;
  program.argv = words;
  if (load(program.image, argv[0], error)) return &program;
  free_words(program);
  std::free(memory);
  return nullptr;
}

bool start(LoadedProgram& program, kernel::Scheduler& scheduler) {
  WAITPOINT_CHECK(program.robot != nullptr && program.image.program != nullptr && !program.ended,
                  "a program starts before it is loaded, or after it has ended");
  home = getpid();
  program.is_loaded = true;
  program.thread_ends = end_with_last_thread;
  program.ends_by = end_by_signal;
  // A write without a reader ends the program that makes it.
  for (const int signal : {SIGPIPE, SIGXFSZ}) install(signal);
  return make_main_thread(program, scheduler, run_loaded_program, &program) != nullptr;
}

void drop(LoadedProgram* program, kernel::Scheduler& scheduler) {
  WAITPOINT_CHECK(kernel::running == nullptr, "a program is dropped from within a task");
  end_other_threads(*program, scheduler);
  forget_what_is_sent_to(*program);
  close_descriptors_of(*program);
  while (program->handlers != nullptr) {
    ExitHandler* const handler = program->handlers;
    program->handlers = handler->next;
    std::free(handler);
  }
  forget_directory(*program);
  unload(program->image);
  free_words(*program);
  std::free(program);
}

bool runs_in_loaded_program() { return is_simulated() && this_program().is_loaded && getpid() == home; }

void exit_program(int exit_status) {
  LoadedProgram& program = this_loaded_program();
  // Only the first thread that exits calls the handlers; no thread waits for the others.
  if (program.exiting) end_running_thread();
  program.exiting = true;
  destroy_variables();
  call_handlers(program);
  std::fflush(nullptr);
  end_program(W_EXITCODE(exit_status & 0xFF, 0));
}

void end_program(int status) {
  LoadedProgram& program = this_loaded_program();
  kernel::Scheduler& scheduler = *kernel::running->scheduler;
  end_other_threads(program, scheduler);
  forget_what_is_sent_to(program);
  close_descriptors_of(program);
  system_v::undo_semaphores_of(program);
  program.ended = true;
  program.status = status;
  end_running_thread();
}

}  // namespace waitpoint::posix
