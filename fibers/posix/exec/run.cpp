// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/exec/run.hpp"

#include <malloc.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "core/error.hpp"
#include "fibers/clocks/clock_text.hpp"
#include "fibers/kernel/common_order.hpp"
#include "fibers/kernel/run.hpp"
#include "fibers/kernel/run_window.hpp"
#include "fibers/kernel/scheduler.hpp"
#include "fibers/kernel/watch.hpp"
#include "fibers/posix/base/import_binding.hpp"
#include "fibers/posix/base/interposed.hpp"
#include "fibers/posix/base/preload.hpp"
#include "fibers/posix/descriptors/descriptors.hpp"
#include "fibers/posix/descriptors/pace.hpp"
#include "fibers/posix/exec/exploration.hpp"
#include "fibers/posix/exec/family_run.hpp"
#include "fibers/posix/exec/idle_watch.hpp"
#include "fibers/posix/exec/own_machine.hpp"
#include "fibers/posix/exec/passed_calls.hpp"
#include "fibers/posix/exec/run_memory.hpp"
#include "fibers/posix/family/turn.hpp"
#include "fibers/posix/links/air.hpp"
#include "fibers/posix/processes/children.hpp"
#include "fibers/posix/processes/process_end.hpp"
#include "fibers/posix/program/randomness.hpp"
#include "fibers/posix/program/thread_area.hpp"
#include "fibers/posix/program/waitable.hpp"
#include "fibers/posix/program/waiting.hpp"
#include "fibers/posix/reports/account.hpp"
#include "fibers/posix/reports/last_calls.hpp"
#include "fibers/posix/reports/misuse_log.hpp"
#include "fibers/posix/reports/race_log.hpp"
#include "fibers/posix/reruns/fork_server.hpp"
#include "fibers/posix/reruns/rerun.hpp"
#include "fibers/posix/reruns/snapshot.hpp"
#include "fibers/posix/signals/signals.hpp"
#include "fibers/posix/threads/deadlock.hpp"
#include "fibers/posix/threads/thread.hpp"
#include "fibers/posix/time/clocks.hpp"
#include "fibers/posix/traps/generated_code.hpp"
#include "fibers/posix/traps/library_calls.hpp"
#include "fibers/posix/traps/processor_counter.hpp"
#include "fibers/posix/traps/processor_features.hpp"
#include "fibers/posix/traps/raw_calls.hpp"
#include "fibers/posix/traps/vdso.hpp"

// Of sync/freed_memory.cpp.
extern "C" [[gnu::visibility("hidden")]] void waitpoint_look_up_allocator();

namespace waitpoint::posix {

const bool has_host = false;

namespace {

int (*program_body)() = nullptr;

// The result of main() is passed to exit(), as in the C library; main() may also end by pthread_exit().
void* run_body(void*) { std::exit(program_body()); }

[[noreturn]] void end_process(int status) {
  family::leave(W_EXITCODE(status, 0));
  rerun_instead_of_ending(status);
  WAITPOINT_NEXT(_exit)(status);
  __builtin_unreachable();
}

// At the end of an instant: takes in external input; returns the end of the run's next window.
Time keep_pace(kernel::Scheduler& scheduler) {
  // What is there by now, as from the program itself over the loopback, is of this instant.
  if (look_outside(false)) return later(kernel::global_time(scheduler), nanosecond);
  const Time next = kernel::next_event_time(scheduler);
  const Duration left = next == Time::max() ? Duration::max() : left_until(next);
  if (left == Duration()) {
    look_outside(false);
    return later(kernel::next_event_time(scheduler), nanosecond);
  }
  wait_outside_for(left);
  return later(look_at_pace(scheduler, next), nanosecond);
}

// Of one process of the run: its program's computing may take another time than that of others.
void take_own_clock() {
  const char* const text = WAITPOINT_NEXT(getenv)(clock_variable);
  if (text != nullptr && kernel::read_clock(text, record->settings.clock)) record->settings.has_clock = true;
}

// The C library calls this constructor before those of libraries, which may make threads that must be simulated.
[[gnu::constructor(101)]] void begin() {
  if (record != nullptr) return;
  bind_imports();
  look_up_passed_calls();
  const char* const descriptor = WAITPOINT_NEXT(getenv)(record_variable);
  if (descriptor == nullptr) refuse("this library is for programs that `waitpoint exec` starts");
  const int joined = map_run(descriptor);
  WAITPOINT_NEXT(unsetenv)(record_variable);
  leave_preload();
  if (has_race_runtime()) leave_library_path();
  inherit_signals();
  register_fork();
  if (joined >= 0) {
    answer_inherited_traps();
    family::join(joined);
    inherit_inside();
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) trap_stream(stream);
  }
  notice_stream = trap_stream;
  // Each thread would reserve a heap of its own, which no other thread of the system competes for.
  if (record->settings.order == kernel::Order::explored) mallopt(M_ARENA_MAX, 1);
  begin_to_answer();
  draw_random_bytes_of_the_process();
  begin_air();
  take_own_clock();
  if (record->settings.trap_rdtsc) trap_processor_counter();
  if (record->settings.trap_library) trap_library_calls();
  trap_processor_features();
  trap_raw_calls();
  replace_vdso();
}

}  // namespace

void refuse(const char* reason) {
  std::fprintf(stderr, "waitpoint: exec: %s\n", reason);
  end_process(status_of_own_errors);
}

namespace {

// The choices from there on are those of another request.
void begin_at_snapshot() {
  const Asked& asked = *record->settings.asked;
  record->explored->begin_again(asked);
  family::family->settings.asked = shared_copy(asked);
}

// Its scheduler has no robot yet.
kernel::Scheduler& begin_run() {
  begin();
  waitpoint_look_up_allocator();
  if (const int server = record->settings.server; server >= 0 && !family::is_joined()) {
    prepare_reruns();
    serve_runs(server);
    trap_raw_calls_of_child();
    instead_of_ending = rerun_instead_of_ending;
    begin_crash_log();
    begin_reruns();
    begin_snapshots(begin_at_snapshot);
  } else {
    // Addresses are those of the server's runs.
    if (has_race_runtime() && record->settings.asked != nullptr && !family::is_joined()) prepare_reruns();
    begin_crash_log();
  }
  if (record->settings.own_machine && !family::is_joined()) enter_own_machine();
  WAITPOINT_CHECK(kernel::running == nullptr, "a run begins within a task");
  reserve_waitables();
  if (record->began) begin_anew();
  if (!family::is_joined()) family::begin();
  count_generated_code(family::family->generated_code);
  note_caught_signals();
  const Asked* const asked = record->settings.asked;
  if (has_race_runtime()) {
    if (asked == nullptr)
      begin_race_log(false, false, Memory::sc, {});
    else if (!asked->accesses.empty())
      asked->conflicts ? begin_conflict_log(asked->accesses, asked->libraries)
                       : begin_access_log(asked->learn, asked->notes, asked->accesses, asked->libraries, asked->code);
    else
      begin_race_log(asked->learn, asked->notes, asked->memory, asked->code);
  }
  begin_misuse_log();
  if (!kernel::Scheduler::has_address_space())
    refuse("there is no address space for the run's tables (a limit such as ulimit -v)");
  static_assert(sizeof(kernel::Scheduler) <= scheduler_bytes);
  kernel::Scheduler& scheduler =
      *new (record->scheduler_memory) kernel::Scheduler(record->settings.order, record->settings.seed);
  if (!record->settings.fast_paths) kernel::use_fast_paths(scheduler, false);
  if (family::is_joined()) kernel::advance(scheduler, family::own->next.time);
  kernel::hooks(scheduler).deliver_signals = deliver_signals;
  kernel::hooks(scheduler).continues_after_cycle = continues_after_cycle;
  kernel::hooks(scheduler).computes_long = spend_for_computing;
  if (asked != nullptr) {
    record->explored = new Explored(scheduler, *asked);
    if (!family::is_joined()) family::family->settings.asked = shared_copy(*asked);
  }
  names_waitables =
      record->settings.traced ||
      (asked != nullptr && (asked->words || asked->events || asked->stops || asked->decision != Asked::none));
  if (record->settings.traced) kernel::set_watch(scheduler, record->recorder = new HistoryRecorder(nullptr));
  if (record->explored != nullptr && record->explored->recorder) record->recorder = &*record->explored->recorder;
  begin_idle_watch(scheduler);
  before_partner = prepare_to_keep_pace;
  record->began = true;
  return scheduler;
}

// While threads wait for external input, the run returns at the end of each instant.
Ending run_to_end(kernel::Scheduler& scheduler) {
  const Time end = record->settings.until;
  for (Time until = end;;) {
    family::limit_window(scheduler);
    const kernel::RunState state =
        kernel::run_before(scheduler, std::min({until, next_idle_check(), end_of_left_over()}));
    if (state == kernel::RunState::stopped) break;
    report_if_ahead(scheduler);
    if (is_idle(scheduler)) {
      family::family->is_over = family::family->is_idle = true;
      break;
    }
    if (family::has_others() || !family::is_first()) {
      if (!step_in_family(scheduler, until)) break;
      continue;
    }
    if (family::take_ring(scheduler)) {  // the last of the others has ended
      look_outside(false);
      until = end;
      continue;
    }
    const bool is_idle = state == kernel::RunState::idle;
    if (is_paced(scheduler) && (!is_idle || anybody_waits_outside())) {
      until = keep_pace(scheduler);
    } else if (is_idle && anybody_waits_outside() && !anybody_awaits_outsiders()) {
      // All wait for each other, at sockets: a deadlock, unless something is still under way.
      wait_outside_for(time_under_way);
      if (!look_outside(false)) break;
      until = later(kernel::global_time(scheduler), nanosecond);
    } else if (look_outside(is_idle)) {
      until = later(kernel::global_time(scheduler), nanosecond);
    } else if (is_idle) {
      break;
    } else if (kernel::next_event_time(scheduler) >= end) {
      return record->ending = Ending::cut_off;
    } else {
      until = anybody_waits_outside() ? later(kernel::next_event_time(scheduler), nanosecond) : end;
    }
  }
  if (family::family->is_cut_off) end_process(0);
  if (family::family->is_idle) return record->ending = Ending::idle;
  if (kernel::stop_cause(scheduler) == kernel::StopCause::ended) return record->ending = Ending::own;
  if (kernel::stop_cause(scheduler) == kernel::StopCause::requested) {
    WAITPOINT_CHECK(record->explored != nullptr, "a run is stopped without an exploration");
    record->explored->note_stop();
    return record->ending = Ending::cut_off;
  }
  const bool stuck = kernel::stop_cause(scheduler) != kernel::StopCause::no_progress;
  return record->ending = stuck ? Ending::deadlock : Ending::no_progress;
}

// Null if the run has not failed.
const char* failure_in_words(Ending ending) {
  switch (ending) {
    case Ending::deadlock: return "deadlock";
    case Ending::no_progress: return "no progress";
    case Ending::idle: return "idle (only timers expire, and no thread wakes another: --idle-limit)";
    default: return nullptr;
  }
}

// The process ends with `status`, unless the run has failed.
[[noreturn]] void end_run(const kernel::Scheduler& scheduler, int status) {
  const char* const why = failure_in_words(record->ending);
  std::fflush(nullptr);  // the program's own output comes before the report
  if (why != nullptr) {
    report_end(scheduler, why);
    log_waits(scheduler);
  }
  end_process(why != nullptr ? status_of_deadlock : status);
}

// The first program has the first process's name; further ones, by exec too, names with their process's number.
void begin_robot(kernel::Scheduler& scheduler, const char* name) {
  if (!family::is_joined()) {
    kernel::add_robot(scheduler, record->robot, name);
    return kernel::copy_name(family::own->name, name);
  }
  // A session has given it one.
  if (const char* const given = getenv(name_variable); given != nullptr) {
    kernel::add_robot(scheduler, record->robot, given);
    kernel::copy_name(family::own->name, given);
    unsetenv(name_variable);
    record->robot.digest_in_use = &family::own->digest;
    return;
  }
  char numbered[kernel::name_size];
  std::snprintf(numbered, sizeof numbered, "%.36s#%d", name, static_cast<int>(family::own->id));
  kernel::add_robot(scheduler, record->robot, numbered);
  kernel::copy_name(family::own->name, numbered);
  record->robot.digest_in_use = &family::own->digest;
}

}  // namespace

void run_program(int (*body)(), const char* name) {
  program_body = body;
  kernel::Scheduler& scheduler = begin_run();
  note_exit_status();
  const char* const slash = std::strrchr(name, '/');
  process_program.robot = &record->robot;
  begin_robot(scheduler, slash != nullptr ? slash + 1 : name);
  static constinit Thread thread;
  thread.start.posix = run_body;
  if (!begin_main_thread(thread, process_program, scheduler))
    refuse("there is no address space for the stacks of threads");
  // No frame on this stack now ever returns.
  set_stack_guard(thread.area, draw_random());
  // All threads have ended, main()'s too: by POSIX the process ends as by exit(0).
  if (run_to_end(scheduler) == Ending::own) std::exit(0);
  end_run(scheduler, 0);
}

}  // namespace waitpoint::posix
