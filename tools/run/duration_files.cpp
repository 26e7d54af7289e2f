// SPDX-License-Identifier: BSD-3-Clause
#include "tools/run/duration_files.hpp"

#include <fmt/format.h>

#include "core/file_contents.hpp"

namespace waitpoint::tools {
namespace {

// Several million blocks of computation.
constexpr std::size_t record_bytes_max = std::size_t{256} << 20;

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
    record_ = parse_duration_record(name, given_file_contents(name, record_bytes_max));
    replay_.emplace(experiment.simulation(), record_, run, name);
  }
}

void DurationFiles::check(bool ended) const {
  if (replay_ && ended) replay_->check_used_up();
}

void DurationFiles::finish() {
  file_->write(to_text(recorder_->record()));
  file_->commit();
}

void DurationFiles::cut_off(const std::string& reason) {
  DurationRecord record = recorder_->record();
  record.cut_off = reason;
  file_->write(to_text(record));
  file_->commit();
}

}  // namespace waitpoint::tools
