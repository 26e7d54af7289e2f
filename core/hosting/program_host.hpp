// SPDX-License-Identifier: BSD-3-Clause
// The interface between the owner of a run and the programs that it hosts. Owners are the experiment (modules/run), the
// session of several programs (tools/session), and the launch of nodes of ROS (modules/nodes); conditions of starts are
// the same for all of them (hosted_programs.hpp). A host is one of two back ends:
//
//   processes   each program is a process, with all that it starts. An owner that is itself simulated starts them as
//               any program does (spawned_processes.hpp); one that has the run's scheduler takes turns with them
//               (fibers/posix/host/process_host.hpp)
//   in-process  each program is a copy of a shared object in the owner's process, and its threads are tasks of the run
//               (fibers/posix/host/in_process_host.hpp)
//
// docs/decisions/hosting-programs.md: what each of them can do, and costs.
#pragma once

#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "core/hosting/program_end.hpp"
#include "core/hosting/start_condition.hpp"

namespace waitpoint {

enum class Hosting : unsigned char { processes, in_process };
inline constexpr std::string_view hosting_words[] = {"processes", "in-process"};

struct EnvironmentVariable {
  std::string name, value;
};

/// A program that is to be hosted.
struct HostedProgram {
  enum class Output : unsigned char { output, errors, nothing };

  std::string name;
  std::string robot = {};                             ///< its events are the robot's, and conditions name its programs
  std::vector<std::string> words;                     ///< its file and arguments
  std::vector<StartCondition> after = {};             ///< its start waits for all
  std::vector<EnvironmentVariable> environment = {};  ///< in front of the owner's; of several with one name the last
  // Of processes. Programs in the owner's process have its streams.
  bool has_input = false;          ///< the owner's standard input; else it is empty
  Output output = Output::output;  ///< the owner's stream that is its standard output
};

/// A program that cannot be hosted: what() is the reason.
class HostingError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

class ProgramHost {
 public:
  virtual ~ProgramHost() = default;
  ProgramHost() = default;
  ProgramHost(const ProgramHost&) = delete;
  ProgramHost& operator=(const ProgramHost&) = delete;

  /// Prepares a program. Its number is the count of those added before. Throws HostingError.
  virtual void add(const HostedProgram& program) = 0;
  /// Begins it at the present instant, once. Throws HostingError; the program has ended then, with status 127.
  virtual void start(std::size_t program) = 0;
  /// None while it runs.
  virtual std::optional<ProgramEnd> end_of(std::size_t program) const = 0;
};

}  // namespace waitpoint
