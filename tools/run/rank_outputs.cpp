// SPDX-License-Identifier: BSD-3-Clause
#include "tools/run/rank_outputs.hpp"

#include <algorithm>
#include <string_view>
#include <utility>

#include "fibers/kernel/watch.hpp"
#include "modules/run/ranks/archive.hpp"
#include "tools/output/recorders.hpp"

namespace waitpoint::tools {
namespace {

template <class T>
std::string packed(std::vector<T>& items) {
  run::Packing packing;
  packing(items);
  items.clear();
  return std::move(packing.bytes());
}

// Of all ranks, in their order.
template <class T>
std::vector<T> unpacked(std::span<const std::string> loads) {
  std::vector<T> all, part;
  for (const std::string& load : loads) {
    run::Unpacking unpacking(load);
    unpacking(part);
    std::move(part.begin(), part.end(), std::back_inserter(all));
  }
  return all;
}

}  // namespace

RankOutputs::RankOutputs(const scenario::Scenario& scenario, run::Experiment& experiment, RankOutputOptions options)
    : experiment_(experiment) {
  if (options.events) {
    events_.emplace(options.write_event != nullptr, options.write_event);
    kernel::set_watch(experiment.simulation().scheduler(), &*events_);
    experiment.add(*events_);
  }
  if (options.paths) {
    paths_.emplace(experiment, options.write_sample);
    experiment.add(*paths_);
  }
  for (std::size_t i = 0; options.picture && i < experiment.robots().size(); ++i)
    if (experiment.is_here(i)) experiment.robots()[i]->keep_paths();
  if (options.record) {
    recording_.emplace(scenario, experiment, options.recording);
    experiment.add(*recording_);
  }
}

RankOutputs::~RankOutputs() {
  if (events_) kernel::set_watch(experiment_.simulation().scheduler(), nullptr);
}

RankOutputs::Events::Events(bool with_environment, std::function<void(const std::string&)> write)
    : Watch{&Events::note}, with_environment_(with_environment), write_(std::move(write)) {}

void RankOutputs::Events::note(kernel::Watch& watch, const kernel::EventRecord& record) {
  Events& self = static_cast<Events&>(watch);
  const bool is_of_environment = record.task->robot->name == std::string_view("environment");
  if (is_of_environment && !self.with_environment_) return;
  self.lines_.push_back({record.time, event_text(record)});
}

std::string RankOutputs::Events::load() { return packed(lines_); }

void RankOutputs::Events::unload(std::span<const std::string> loads) {
  std::vector<Line> all = unpacked<Line>(loads);
  std::ranges::stable_sort(all, {}, &Line::time);
  for (const Line& line : all) write_(line.text);
}

RankOutputs::Paths::Paths(run::Experiment& experiment, decltype(RankOutputOptions::write_sample) write)
    : write_(std::move(write)) {
  for (std::size_t i = 0; i < experiment.robots().size(); ++i)
    if (experiment.is_here(i))
      experiment.robots()[i]->add_path_sink(robots_.emplace_back(samples_, static_cast<std::uint32_t>(i)));
}

std::string RankOutputs::Paths::load() { return packed(samples_); }

void RankOutputs::Paths::unload(std::span<const std::string> loads) {
  for (const Sample& sample : unpacked<Sample>(loads)) write_(sample.robot, sample.kind, sample.at);
}

}  // namespace waitpoint::tools
