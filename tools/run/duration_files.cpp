// SPDX-License-Identifier: BSD-3-Clause
#include "tools/run/duration_files.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>

namespace waitpoint::tools {
namespace {

std::string read_file(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::string text((std::istreambuf_iterator<char>(file)), {});
  if (!file.is_open() || file.bad())
    throw BadInput(path.string(), std::string("cannot be read: ") + std::strerror(errno));
  return text;
}

/// The run that durations belong to: the scenario's content, regardless of its path, the seed and the order.
std::string name_of_run(const RunOptions& options, const scenario::Scenario& scenario) {
  return fmt::format("{:016x} seed {} order {}", scenario.fingerprint, options.seed,
                     options.order == kernel::Order::seeded ? "seeded" : "fifo");
}

}  // namespace

DurationFiles::DurationFiles(const RunOptions& options, const scenario::Scenario& scenario,
                             run::Experiment& experiment) {
  const std::string run = name_of_run(options, scenario);
  if (options.record_durations) {
    file_.emplace(*options.record_durations);
    recorder_.emplace(experiment.simulation(), run);
  }
  if (options.replay_durations) {
    const std::string name = options.replay_durations->string();
    record_ = parse_duration_record(name, read_file(name));
    replay_.emplace(experiment.simulation(), record_, run, name);
  }
}

void DurationFiles::finish(bool ended) {
  if (replay_ && ended) replay_->check_used_up();
  if (!file_) return;
  file_->write(to_text(recorder_->record()));
  file_->commit();
}

}  // namespace waitpoint::tools
