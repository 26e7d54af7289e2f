// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/program.hpp"

#include <sys/mman.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "fibers/posix/clocks.hpp"
#include "fibers/posix/deadlock.hpp"
#include "fibers/posix/descriptors.hpp"
#include "fibers/posix/interposed.hpp"

namespace waitpoint::posix {

Record* record = nullptr;

namespace {

constexpr char preload_variable[] = "LD_PRELOAD";

constexpr Duration nanosecond = Duration(std::chrono::nanoseconds(1));

int (*program_body)() = nullptr;

// main() returns into exit(), as in the C library; but it may leave by pthread_exit() too.
void* run_body(void*) { std::exit(program_body()); }

// Programs that this one starts are not simulated: what was put in front of the libraries they preload is taken away.
void clear_environment() {
  unsetenv(record_variable);
  const char* const preloaded = std::getenv(preload_variable);
  const char* const others = preloaded == nullptr ? nullptr : std::strchr(preloaded, ':');
  if (others == nullptr)
    unsetenv(preload_variable);
  else
    setenv(preload_variable, others + 1, 1);
}

void map_record() {
  const char* const text = std::getenv(record_variable);
  if (text == nullptr) return;
  const int descriptor = std::atoi(text);
  void* memory = mmap(nullptr, sizeof(Record), PROT_READ | PROT_WRITE, MAP_SHARED, descriptor, 0);
  close(descriptor);
  if (memory == MAP_FAILED || static_cast<Record*>(memory)->mark != Record::mark_of_version)
    refuse("this library and the waitpoint that started it are not of one version");
  record = static_cast<Record*>(memory);
}

// While threads wait for what comes from outside, the run comes out at the end of each instant.
void run_to_end(kernel::Scheduler& scheduler) {
  Time until = Time::max();
  for (;;) {
    const kernel::RunState state = scheduler.run_before(until);
    if (state == kernel::RunState::stopped) return;
    if (look_outside(state == kernel::RunState::idle)) {
      until = later(scheduler.global_time(), nanosecond);
    } else if (state == kernel::RunState::idle) {
      return;
    } else {
      until = anybody_waits_outside() ? later(scheduler.next_event_time(), nanosecond) : Time::max();
    }
  }
}

// The C library calls it before those of libraries that are made with threads: by then they must be simulated.
[[gnu::constructor(101)]] void begin() {
  if (record != nullptr) return;
  map_record();
  if (record == nullptr) refuse("this library is for programs that `waitpoint exec` starts");
  clear_environment();
}

}  // namespace

void refuse(const char* reason) {
  std::fprintf(stderr, "waitpoint: exec: %s\n", reason);
  _exit(status_of_own_errors);
}

void run_program(int (*body)(), const char* name) {
  begin();
  program_body = body;
  new (&record->scheduler) kernel::Scheduler(record->settings.order, record->settings.seed);
  kernel::Scheduler& scheduler = record->scheduler;
  const char* const slash = std::strrchr(name, '/');
  scheduler.add(record->robot, slash != nullptr ? slash + 1 : name);
  scheduler.set_delivery(deliver_signals);
  record->running = &kernel::running;
  record->began = true;
  static constinit Thread thread;
  thread.start.posix = run_body;
  kernel::Task* const task =
      scheduler.spawn(record->robot, {.name = "main", .stack = kernel::StackSize::program}, run_thread, &thread);
  if (task == nullptr) refuse("there is no address space for the stacks of threads");
  adopt_main_thread(thread, *task);
  run_to_end(scheduler);
  // All threads have ended, main()'s too: POSIX has the process end as if it had called exit(0).
  if (scheduler.stop_cause() == kernel::StopCause::ended) std::exit(0);
  report_deadlock(scheduler);
  std::fflush(nullptr);
  _exit(status_of_deadlock);
}

}  // namespace waitpoint::posix
