// SPDX-License-Identifier: BSD-3-Clause
// The end of a process that runs tasks. One thread has it, and others that come to it wait:
//
//   death     a thread dies (fault_reports.hpp): it has the end for good. Each thread that runs tasks stops at its next
//             event, and does not return from its window
//   commit    the results of a run are written; a death that begins meanwhile in another thread waits until they are
//   exit      exit() or the return of main(): its thread has the end for good
//
// Hence a run during which a death has begun prints no summary, names no complete outputs, and does not end with status
// 0; and a death that begins later finds the results complete.
//
// The end is that of one process: in one that a task forked, and in a copy that reports a death, nothing waits.
#pragma once

#include <pthread.h>

#include <atomic>
#include <optional>

namespace waitpoint::kernel {

class Scheduler;
struct Turn;

/// A thread that runs tasks, for the object's lifetime; made by it. Not two at a time in one thread.
class TaskThread {
 public:
  TaskThread();
  ~TaskThread();
  TaskThread(const TaskThread&) = delete;
  TaskThread& operator=(const TaskThread&) = delete;

  /// The run of the present window; null: none.
  void set_scheduler(Scheduler* scheduler);
  /// True for a thread that runs tasks.
  static bool is_one(pthread_t thread);

 private:
  static bool ask_all_to_stop();
  friend void begin_death();
  friend void wait_if_dying();

  const pthread_t id_ = pthread_self();
  Turn* const turn_;
  Scheduler* scheduler_ = nullptr;
  std::atomic<bool> has_stopped_ = false;
  TaskThread* next_ = nullptr;  // of all
};

/// The process whose end this is: the latest one in which a task thread or its window began.
bool is_process_of_tasks();
/// The calling thread dies: returns with the end. The other threads that run tasks have stopped at an event, except
/// those that reach none within some tenths of a second. Async-signal-safe.
void begin_death();
/// Does not return if another thread is dying.
void wait_if_dying();

/// The results of a run are printed and its files named while the object lives. Does not begin if a death has.
class Commit {
 public:
  Commit();
  ~Commit();
  Commit(const Commit&) = delete;
  Commit& operator=(const Commit&) = delete;

  /// True from the first commit on.
  static bool has_begun();

 private:
  bool is_inner_;
};

/// The calling thread, the main one, is about to return `status` from main().
void set_exit_status(int status);
/// To be called at exit(status) and _exit(status), in any thread. Returns the status to end with: after
/// set_exit_status() another thread's request does not count, nor does one of a static destructor. Takes the end.
int settle_exit_status(int status);
/// The status of the exit that has begun after set_exit_status().
std::optional<int> begun_exit_status();

}  // namespace waitpoint::kernel
