// SPDX-License-Identifier: BSD-3-Clause
// The processes of a program: the one that was started, and those that it and its children fork.
//
// Each is a simulation of its own, with its own order of its own threads. What they may share are primitives in memory
// that they share, and named semaphores. Such an object keeps its state in its own bytes, changed only within a
// Section, where no other process of the family is; and a process that changes one rings for those that wait. To these
// it is something from outside: see descriptors.hpp.
#pragma once

#include <signal.h>
#include <sys/types.h>

#include <cstddef>

namespace waitpoint::posix::family {

/// A run begins, in this process: it is a family of its own.
void begin();
/// A child is about to be made; it was made, or, with -1, was not.
void expect_child();
void note_child(pid_t child);
/// In the child.
void begin_as_child();

/// Whether any other process of the family lives.
bool has_others();
/// Whether one may have lived.
bool had_others();
/// Whether the process lives: one that has ended and was not waited for does not.
bool lives(pid_t process);
/// Its number; asking the system takes longer.
pid_t this_process();

/// Memory at one address in all of them, zeroed; null without any. Within a Section.
void* take(std::size_t bytes);
void give(void* memory);
/// The same of whole pages, which nobody has touched: for as many as it was asked for, to be given back with their
/// count.
void* take_pages(std::size_t bytes);
void give_pages(void* pages, std::size_t bytes);

/// What parts of the layer keep there, zeroed when it is first asked for with a size; null without it. Within a
/// Section.
enum class Part { names, futexes, semaphores, memory, messages, count };
void* common(Part part, std::size_t bytes);

/// While it lives, no other process of the family is in one. Not to be nested, and nothing in it waits.
class Section {
 public:
  /// Nothing, if not `needed`.
  explicit Section(bool needed = true);
  ~Section();
  Section(const Section&) = delete;
  Section& operator=(const Section&) = delete;

 private:
  const bool entered_;
};

/// Threads of this process wait for what others of the family do, or do no longer.
void note_waiting(bool waiting);
/// This process waits for what `holder` has, or for nothing, with 0; false if that process waits for this one in turn,
/// directly or by others.
bool note_waiting_for(pid_t holder);
/// After a change: the processes that wait look again.
void ring();
/// Whether a signal is that of another process.
bool is_ring(const siginfo_t& information);

}  // namespace waitpoint::posix::family
