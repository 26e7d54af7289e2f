// SPDX-License-Identifier: BSD-3-Clause
#include "tools/view/event_counts.hpp"

#include <fmt/format.h>

#include <utility>

#include "fibers/kernel/run.hpp"
#include "modules/genom/module.hpp"
#include "tools/view/view_json.hpp"

namespace waitpoint::tools::view {
namespace {

constexpr std::size_t periods_max = 2048, collisions_max = 1000;

/// Missed deadlines so far, by robot and task.
using Missed = std::map<std::pair<std::string, std::string>, std::int64_t>;

Missed missed_deadlines(const run::Experiment& experiment) {
  Missed missed;
  for (const auto& robot : experiment.robots())
    for (const auto& [name, module] : robot->names().modules())
      for (const genom::ExecutionTask& task : module->tasks())
        if (task.missed_deadlines() > 0) missed[{robot->name(), name + "." + task.name()}] = task.missed_deadlines();
  return missed;
}

}  // namespace

EventCounts::EventCounts(run::Experiment& experiment)
    : experiment_(experiment), collisions_(experiment.robots().size()) {}

void EventCounts::note_collisions(Time now) {
  for (std::size_t i = 0; i < collisions_.size() && collided_.size() < collisions_max; ++i) {
    const std::uint64_t collisions = experiment_.world().body(world::BodyId(i)).collisions;
    if (std::exchange(collisions_[i], collisions) < collisions) collided_.emplace_back(now, i);
  }
}

void EventCounts::take(Time now) {
  note_collisions(now);
  if (now.since_start() < period_ * static_cast<std::int64_t>(periods_ + 1)) return;
  const Missed missed = missed_deadlines(experiment_);
  const kernel::Roster& roster = kernel::roster(experiment_.simulation().scheduler());
  for (const kernel::Task* task = roster.first_task(); task != nullptr; task = task->next) {
    OfTask& counts = tasks_[task->number];
    if (counts.head.empty()) {
      counts.head = text_of(Json{task->number, task->name, task->robot->name});
      counts.first = periods_;
    }
    counts.events.resize(periods_ - counts.first);
    counts.events.push_back(
        static_cast<std::uint32_t>(task->sequence - std::exchange(counts.last_events, task->sequence)));
    const auto late = missed.find({task->robot->name, task->name});
    const std::int64_t now_missed = late != missed.end() ? late->second : 0;
    counts.missed.resize(periods_ - counts.first);
    counts.missed.push_back(static_cast<std::uint32_t>(now_missed - std::exchange(counts.last_missed, now_missed)));
  }
  if (++periods_ == periods_max) halve();
}

void EventCounts::halve() {
  for (auto& [number, task] : tasks_) {
    for (std::vector<std::uint32_t>* of_task : {&task.events, &task.missed}) {
      std::vector<std::uint32_t> sums((task.first + of_task->size() + 1) / 2 - task.first / 2);
      for (std::size_t i = 0; i < of_task->size(); ++i) sums[(task.first + i) / 2 - task.first / 2] += (*of_task)[i];
      *of_task = std::move(sums);
    }
    task.first /= 2;
  }
  periods_ /= 2;
  period_ = period_ * 2;
}

std::string EventCounts::text() const {
  std::string text =
      fmt::format("{{\"kind\":\"counts\",\"period\":{},\"from\":0,\"periods\":{},\"tasks\":[", period_.ns(), periods_);
  std::string events, missed;
  const auto append = [](std::string& to, const OfTask& task, const std::vector<std::uint32_t>& counts) {
    if (!to.empty()) to += ',';
    to += '[';
    for (std::size_t i = 0; i < task.first; ++i) to += i > 0 ? ",0" : "0";
    for (std::size_t i = 0; i < counts.size(); ++i) {
      if (task.first + i > 0) to += ',';
      to += std::to_string(counts[i]);
    }
    to += ']';
  };
  bool any = false;
  for (const auto& [number, task] : tasks_) {
    text += (std::exchange(any, true) ? "," : "") + task.head;
    append(events, task, task.events);
    append(missed, task, task.missed);
  }
  std::string collided;
  for (const auto& [time, robot] : collided_)
    collided += fmt::format("{}[{},{}]", collided.empty() ? "" : ",", time.ns(), robot);
  return text + "],\"events\":[" + events + "],\"missed\":[" + missed + "],\"collisions\":[" + collided + "]}";
}

}  // namespace waitpoint::tools::view
