// SPDX-License-Identifier: BSD-3-Clause
// A family of processes in a host's simulation: programs of robots, each a process with all that it starts, whose
// events have one common order with those of the host's scheduler.
//
// The host is the first entry of the family's table, and the parent of the programs (see family/turn.hpp). In its event
// list is a timer's event with the key of the family's least one: there the host hands over the turn, and waits until
// it has come back. The library of `waitpoint exec` is preloaded into the programs.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "fibers/kernel/scheduler.hpp"
#include "fibers/posix/family/family.hpp"

namespace waitpoint::posix {

class HostedFamily {
 public:
  /// `library` is preloaded. False in has_memory() if the system gives none: then nothing else may be called.
  HostedFamily(kernel::Scheduler& scheduler, std::filesystem::path library);
  ~HostedFamily();
  HostedFamily(const HostedFamily&) = delete;
  HostedFamily& operator=(const HostedFamily&) = delete;

  bool has_memory() const { return family_ != nullptr; }
  /// Starts a program at the present instant, from outside tasks; its hand-overs go into the robot's digest. Returns
  /// its number; -1 if the system makes no process, or the table is full.
  int start(const std::string& name, const std::vector<std::string>& words, kernel::Robot& robot);
  /// The status as a shell reports it; none if it has not ended.
  std::optional<int> exit_status(int program) const;

 private:
  struct Program {
    family::Process* process;
    kernel::Robot* robot;
  };
  struct Limit {
    kernel::EventNode node;  // first: its address is the event's
    HostedFamily* family = nullptr;
  };

  static void fire(kernel::EventNode& node);
  family::Process& own() const { return family_->processes[0]; }
  family::Process* add(const family::Process* parent);
  void set_limit();
  void hand_over();
  void await_turn();
  void take_from_killed();
  void await_end_of_leaving();
  std::uint64_t digest() const;

  kernel::Scheduler& scheduler_;
  std::filesystem::path library_;
  int file_ = -1;
  family::Family* family_ = nullptr;
  Limit limit_;
  std::vector<Program> programs_;
};

}  // namespace waitpoint::posix
