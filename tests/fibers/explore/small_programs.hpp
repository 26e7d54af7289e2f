// SPDX-License-Identifier: BSD-3-Clause
// Programs of two or three tasks with a few operations each on an atomic, a semaphore and a mutex, drawn from a number;
// and all that can come of them, by an interpreter that shares nothing with the kernel: it keeps the state in a struct
// and takes, in every state, every step that is possible.
#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <vector>

namespace waitpoint::small {

enum class Step : std::uint8_t {
  load,         ///< the atomic, into the task's register
  store,        ///< the register and the operand
  add,          ///< the operand, to the atomic
  swap,         ///< the operand against the atomic's value, which goes to the register
  replace,      ///< nought by the operand; the register takes whether that was so
  acquire,      ///< a unit of the semaphore
  try_acquire,  ///< the same if there is one; the register takes whether there was
  release,
  lock,
  unlock,
};

struct Instruction {
  Step step;
  int operand;
};

struct Program {
  int units = 0;  ///< of the semaphore at first
  std::vector<std::vector<Instruction>> tasks;
};

/// In words, for messages.
std::string to_text(const Program& program);

/// The `number`-th program.
Program make_program(std::uint64_t number);

/// What a run comes to: the registers and values, or that not all tasks came to their ends.
struct Result {
  bool stuck = false;
  int value = 0, units = 0;
  std::vector<int> registers;
};

std::string to_text(const Result& result);

/// All results that `program` can have.
std::set<std::string> enumerate(const Program& program);

}  // namespace waitpoint::small
