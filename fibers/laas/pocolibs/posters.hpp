// SPDX-License-Identifier: BSD-3-Clause
// A robot's local posters. Each has a unit that a task takes to use it; a task that is about to read looks first
// whether it was written.
#pragma once

#include <deque>
#include <string>

#include "fibers/laas/include/posterLib.h"
#include "fibers/laas/semaphore.hpp"

namespace waitpoint::laas {

struct Poster {
  explicit Poster(kernel::Robot& robot, std::string name_of) : access(robot, ""), name(std::move(name_of)) {}
  Semaphore access;
  std::string name;
  int device = 0;
  bool open = true;
  bool fresh = false;  ///< written, and not resized since
  POSTER_OP operation = POSTER_IOCTL;
  H2TIMESPEC date{};  ///< of the last write
  void* memory = nullptr;
  std::size_t size = 0;
  H2_ENDIANNESS endianness = H2_LITTLE_ENDIAN;
  H2_POSTER_STAT_STR statistics{};
};

class Posters : public sync::RobotState {
 public:
  explicit Posters(kernel::Robot& robot) : robot_(robot) {}
  static Posters& here() { return sync::state_of<Posters>(*sync::running_task().robot); }

  /// Null, with the caller's error code, if the name is taken or there is no memory.
  Poster* create(const char* name, std::size_t size);
  /// Null if there is none.
  Poster* find(int device);
  /// Frees its name and memory; waiting tasks return.
  void close(int device);
  /// All that were created, closed ones too: their ids stay known until the end of the run.
  const std::deque<Poster>& all() const { return all_; }

 private:
  kernel::Robot& robot_;
  std::deque<Poster> all_;
};

}  // namespace waitpoint::laas
