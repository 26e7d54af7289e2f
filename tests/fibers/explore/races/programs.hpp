// SPDX-License-Identifier: BSD-3-Clause
// Small programs of simulated threads, compiled with -fsanitize=thread: each races, or has a twin that does not.
#pragma once

#include <span>

namespace waitpoint::races {

struct Program {
  const char* name;
  void (*body)();
  bool races;
};

std::span<const Program> plain_programs();    ///< what is accessed, and how
std::span<const Program> ordered_programs();  ///< by primitives
std::span<const Program> atomic_programs();   ///< by the standard's atomics

// For tests of their own.
void count_twice_without_lock();  ///< check() fails where an increment is lost
void publish_in_two_steps();      ///< check() fails where a reader comes between
void wait_for_nobody();           ///< spins on an atomic that nobody sets
void two_heaps();                 ///< accesses new memory from two threads, in order
extern int planted;               ///< a global
void write_planted();             ///< two threads do, named "ada" and "bob"

}  // namespace waitpoint::races
