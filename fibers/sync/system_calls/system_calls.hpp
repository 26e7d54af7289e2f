// SPDX-License-Identifier: BSD-3-Clause
// Notices calls of the C library that take a task out of virtual time: threads of the operating system, fork(), waits
// and sleeps in real time. The library's own definitions of these functions stand before the C library's:
//
//   pthread_create  fork  system  popen  posix_spawn              start what runs in real time: not repeatable
//   sleeps, polls, joins, waits for conditions, children, sockets  hold up every task of the run
//   semaphores, mutexes, rwlocks, futexes                          the same, until a system thread acts
//
// Outside of tasks they cost a comparison, and call the C library's. In a task, the first call from each place is noted
// with its call stack; a lock that is free is no wait. std::thread, std::mutex and std::this_thread::sleep_for() are
// made of these calls. A mutex that another task holds can never be unlocked: a misuse, reported at once.
// Programs under `waitpoint exec` and programs of robots have a layer of their own for all of these calls.
#pragma once

#include <string>

namespace waitpoint::sync {

/// While it exists, calls of this thread are noted. At its end, each place of a call that is new in this process is
/// told on the error stream, 16 at most:
///
///   waitpoint: warning: task sick.scan of rackham calls nanosleep() at 3.200000000 s: it holds up all tasks of the run
///     at (anonymous namespace)::settle() at sick_driver.cpp:40
class SystemCalls {
 public:
  SystemCalls();
  ~SystemCalls();
  SystemCalls(const SystemCalls&) = delete;
  SystemCalls& operator=(const SystemCalls&) = delete;
};

/// True if robots' programs are simulated in this process: such calls are theirs, for the layer behind this one.
bool has_program_layer();
/// Tells the calls noted so far at once: when the process dies in a task.
void tell_system_calls();
/// Tells the same of threads that were started before, outside of tasks: in a static initializer, for one.
void tell_threads_outside();
/// While it lives, threads that are started outside of tasks are not noted: a library's, which have no part in the run.
class UnnotedThreads {
 public:
  UnnotedThreads();
  ~UnnotedThreads();
  UnnotedThreads(const UnnotedThreads&) = delete;
  UnnotedThreads& operator=(const UnnotedThreads&) = delete;
};
/// From now on, calls are not told, but returned by collected_system_calls(), each once, in the same words.
void collect_system_calls();
std::string collected_system_calls();
/// True if a task started a thread or a process since the last forget_started().
bool has_started_outside_of_virtual_time();
void forget_started();
/// The failure of a schedule in which one did.
inline constexpr char started_outside_of_virtual_time[] =
    "a task starts a thread or process of the operating system, whose steps are not explored";

}  // namespace waitpoint::sync
