// SPDX-License-Identifier: BSD-3-Clause
// The back end of programs as processes, for an owner that has the run's scheduler: each is a process with all that it
// starts, whose events have one common order with those of the scheduler.
//
// The owner is the first entry of the family's table, and the parent of the programs (see family/turn.hpp). In its
// event list is a timer's event with the key of the family's least one: there the owner hands over the turn, and waits
// until it has come back. The library of `waitpoint exec` is preloaded into the programs.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <optional>
#include <vector>

#include "core/hosting/program_host.hpp"
#include "fibers/kernel/task.hpp"
#include "fibers/posix/family/family.hpp"
#include "fibers/posix/host/robot_of.hpp"

namespace waitpoint::posix {

class ProcessHost final : public ProgramHost {
 public:
  /// `library` is preloaded.
  ProcessHost(kernel::Scheduler& scheduler, std::filesystem::path library);
  /// The programs are left where they are.
  ~ProcessHost() override;

  /// HostingError if there is no such program.
  void add(const HostedProgram& program) override;
  /// From outside tasks. The hand-overs go into the robot's digest. HostingError if the system makes no process.
  void start(std::size_t program) override;
  std::optional<ProgramEnd> end_of(std::size_t program) const override;

 private:
  struct Program {
    HostedProgram hosted;
    kernel::Robot* robot;
    family::Process* process = nullptr;  // null: not started
  };
  struct Limit {
    kernel::EventNode node;  // first: its address is the event's
    ProcessHost* host = nullptr;
  };

  static void fire(kernel::EventNode& node);
  family::Process& own() const { return family_->processes[0]; }
  family::Process* add_process(const family::Process* parent);
  [[noreturn]] void execute(const Program& program, pid_t host) const;
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
