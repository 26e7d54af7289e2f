// SPDX-License-Identifier: BSD-3-Clause
// The processes of a program: the one that was started, and those that it and its children fork.
//
// Each is its own simulation, with its own schedule. They can share primitives in shared memory, and named semaphores.
// Such an object holds its state in its own bytes, which change only within a Section, exclusive among the family; a
// process that changes one rings the processes that wait. For these the change comes from outside: see descriptors.hpp.
#pragma once

#include <signal.h>
#include <sys/types.h>

#include <cstddef>

namespace waitpoint::posix::family {

/// Starts a family with this process alone, at the beginning of a run.
void begin();
/// Before a child is made, and after; -1 if that failed.
void expect_child();
void note_child(pid_t child);
/// In the child.
void begin_as_child();

/// True if another process of the family is alive.
bool has_others();
/// True if there may have been another.
bool had_others();
/// True if the process is alive; a zombie is not.
bool lives(pid_t process);
/// getpid(), without the system call.
pid_t this_process();

/// Zeroed memory at the same address in all processes; null if exhausted. Within a Section.
void* take(std::size_t bytes);
void give(void* memory);
/// The same in whole pages, untouched; to be given back with the same size.
void* take_pages(std::size_t bytes);
void give_pages(void* pages, std::size_t bytes);

/// The shared state of a part of the layer, zeroed at the first call with a size; before that null. Within a Section.
enum class Part { names, futexes, semaphores, memory, messages, count };
void* common(Part part, std::size_t bytes);

/// A critical section, exclusive among the processes of the family. Not to be nested; no waits within.
class Section {
 public:
  /// No effect if not `needed`.
  explicit Section(bool needed = true);
  ~Section();
  Section(const Section&) = delete;
  Section& operator=(const Section&) = delete;

 private:
  const bool entered_;
};

/// Threads of this process wait, or no longer wait, for other processes of the family.
void note_waiting(bool waiting);
/// This process waits for a file lock of `holder`; with 0, for none. False if `holder` waits for this process, directly
/// or through others.
bool note_waiting_for(pid_t holder);
/// After a change: makes the processes that wait check again.
void ring();
/// True if a signal is the ring of another process.
bool is_ring(const siginfo_t& information);

}  // namespace waitpoint::posix::family
