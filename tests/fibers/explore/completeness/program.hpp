// SPDX-License-Identifier: BSD-3-Clause
// Small programs of up to four threads over two objects of each kind, as data: the abstract machine, the interpreter on
// the library's primitives and the one on POSIX threads (program.c) execute them.
//
// Thread 0 exists at the start; the others are created. A thread's result is the sequence of what it reads. As text:
// the semaphores' units, then the threads, each instruction a letter, an object and an operand:
//
//   01|c10 l00 w00 u00 j10|l00 n00 u00
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace waitpoint::completeness {

inline constexpr std::size_t threads_max = 4, objects = 2;

enum class Step : char {
  create = 'c',       ///< thread `object`, which is created at one place only
  join = 'j',         ///< thread `object`; a misuse unless the thread has created it, and not joined it
  lock = 'l',         ///< mutex `object`
  lock_for = 'L',     ///< for `operand` instants; reads its success
  try_lock = 't',     ///< reads its success
  unlock = 'u',       ///< a misuse unless the thread holds it
  wait = 'w',         ///< on condition `object`, with mutex `object`; a misuse unless the thread holds that
  wait_for = 'W',     ///< for `operand` instants; reads 0 if they ran out
  signal = 'n',       ///< one waiter
  broadcast = 'b',    ///< all waiters
  acquire = 'a',      ///< a unit of semaphore `object`
  acquire_for = 'A',  ///< for `operand` instants; reads its success
  try_acquire = 'q',  ///< reads its success
  release = 'r',      ///< a unit
  count = 'v',        ///< reads the semaphore's units; of POSIX threads only
  load = 'g',         ///< reads atomic `object`
  store = 'p',        ///< `operand`
  add = 'f',          ///< `operand`; reads the value before
  replace = 'x',      ///< 0 by `operand`; reads the value before
  sleep = 'z',        ///< until `operand` instants later
  skip = 's',         ///< the next `operand` instructions if the last value read is 0
  exit = 'e',         ///< ends the thread
  exit_all = 'k',     ///< ends the program
};

struct Instruction {
  Step step = Step::load;
  std::uint8_t object = 0, operand = 0;
};

struct Program {
  std::uint8_t units[objects] = {};  ///< of the semaphores at the start
  std::vector<std::vector<Instruction>> threads;

  std::size_t size() const;  ///< number of instructions
};

std::string to_text(const Program& program);
/// The inverse; BadInput for another text.
Program read_program(std::string_view text);

/// The smallest programs that can be made from `program` by a single omission: of an instruction, of a thread with its
/// creation and its join, of a semaphore's unit.
std::vector<Program> smaller(const Program& program);

}  // namespace waitpoint::completeness
