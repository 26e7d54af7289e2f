// SPDX-License-Identifier: BSD-3-Clause
// The back end of programs in the owner's process: shared objects with a main(), each a copy with its own globals,
// whose threads are tasks of the run. It needs the library in front of the C library that has the table of functions
// in_process/layer.hpp, and throws HostingError without it.
#pragma once

#include <vector>

#include "core/hosting/program_host.hpp"
#include "fibers/kernel/task.hpp"
#include "fibers/posix/in_process/layer.hpp"

namespace waitpoint::posix {

class InProcessHost final : public ProgramHost {
 public:
  /// True if the library is loaded.
  static bool is_possible();

  explicit InProcessHost(kernel::Scheduler& scheduler) : scheduler_(scheduler) {}
  /// The programs are left where they are. Before the run is unwound.
  ~InProcessHost() override;

  /// Carries data between programs of different robots; without it data arrive at once. Outlives this.
  void set_carrier(const Carrier& carrier);

  /// Loads the program. HostingError if it cannot be loaded.
  void add(const HostedProgram& program) override;
  /// From outside tasks. HostingError without memory.
  void start(std::size_t program) override;
  std::optional<ProgramEnd> end_of(std::size_t program) const override;

 private:
  struct Program {
    LoadedProgram* loaded;
    kernel::Robot* robot;
    std::string name;
  };

  kernel::Scheduler& scheduler_;
  std::vector<Program> programs_;
};

}  // namespace waitpoint::posix
