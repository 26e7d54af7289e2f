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

std::span<const Program> plain_programs();    ///< kinds of accesses
std::span<const Program> ordered_programs();  ///< ordered by primitives
std::span<const Program> atomic_programs();   ///< ordered by the standard's atomics

// Used by separate tests.
void count_twice_without_lock();    ///< check() fails if an increment is lost
void publish_in_two_steps();        ///< check() fails if a reader runs in between
void wait_for_nobody();             ///< spins on an atomic that is never set
void share_late();                  ///< shares an atomic unless its first thread comes first
void two_heaps();                   ///< accesses new memory from two threads, in order
void write_and_read(bool records);  ///< two tasks, one atomic; check() fails if the recorded history is wrong
void race_and_lose();               ///< two races in each order; check() fails if an update of an atomic is lost
extern int planted;                 ///< a global
void write_planted();               ///< written by two threads, named "ada" and "bob"

}  // namespace waitpoint::races
