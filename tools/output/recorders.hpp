// SPDX-License-Identifier: BSD-3-Clause
// Files that locate a difference between two runs: digests by robot and second, and all events, as text.
//
// Compare the digest files first (`diff` names the first second and robot), then the event files of that second.
// Neither changes the run.
#pragma once

#include <string>

#include "fibers/kernel/watch.hpp"
#include "fibers/sync/simulation.hpp"
#include "tools/output/output_file.hpp"

namespace waitpoint::tools {

/// Lines "second robot digest events": robots in the scenario's order, then the environment.
class DigestRecorder {
 public:
  explicit DigestRecorder(const std::filesystem::path& path) : file_(path) {}
  void record(const Simulation& simulation, std::int64_t second);
  void finish() { file_.commit(); }
  /// Ends the file with a comment: the process dies for `reason`.
  void cut_off(const std::string& reason);

 private:
  OutputFile file_;
};

/// "time robot task operation object", without a newline.
std::string event_text(const kernel::EventRecord& record);

/// Lines "time robot task operation object", one for each event.
class EventRecorder : private kernel::Watch {
 public:
  explicit EventRecorder(const std::filesystem::path& path);
  void watch(Simulation& simulation) { kernel::set_watch(simulation.scheduler(), this); }
  /// A line from elsewhere.
  void add(const std::string& event_text) { file_.write(event_text + "\n"); }
  void finish() { file_.commit(); }
  void cut_off(const std::string& reason);

 private:
  static void write(kernel::Watch& watch, const kernel::EventRecord& record);

  OutputFile file_;
};

}  // namespace waitpoint::tools
