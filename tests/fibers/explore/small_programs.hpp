// SPDX-License-Identifier: BSD-3-Clause
// Random programs of two or three tasks with a few operations each on an atomic, a semaphore and a mutex, by number;
// and all their possible results, by an interpreter that is independent of the kernel: it keeps the state in a struct
// and takes, in every state, every possible step.
#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <vector>

namespace waitpoint::small {

enum class Step : std::uint8_t {
  load,         ///< the atomic, into the task's register
  store,        ///< the register and the operand
  add,          ///< adds the operand to the atomic
  swap,         ///< exchanges the atomic's value with the operand; the old one goes to the register
  replace,      ///< zero by the operand; the register gets the success
  acquire,      ///< a unit of the semaphore
  try_acquire,  ///< without waiting; the register gets the success
  release,
  lock,
  unlock,
};

struct Instruction {
  Step step;
  int operand;
};

struct Program {
  int units = 0;  ///< initial units of the semaphore
  std::vector<std::vector<Instruction>> tasks;
};

/// As text, for messages.
std::string to_text(const Program& program);

/// The `number`-th program.
Program make_program(std::uint64_t number);

/// The result of a run: the registers and values, or that some tasks did not end.
struct Result {
  bool stuck = false;
  int value = 0, units = 0;
  std::vector<int> registers;
};

std::string to_text(const Result& result);

/// All results that `program` can have.
std::set<std::string> enumerate(const Program& program);

}  // namespace waitpoint::small
