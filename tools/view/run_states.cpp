// SPDX-License-Identifier: BSD-3-Clause
#include "tools/view/run_states.hpp"

#include "fibers/kernel/run.hpp"
#include "fibers/kernel/waiting_calls.hpp"
#include "modules/genom/module.hpp"

namespace waitpoint::tools::view {
namespace {

// Longer texts of posters, such as maps, are of no use to a reader.
constexpr std::size_t text_max = 20'000;

Json object_state(const kernel::Object& object) {
  Json json = {{"kind", object.kind},
               {"number", object.number},
               {"label", object.label},
               {"robot", object.robot != nullptr ? object.robot->name : ""},
               {"owner", nullptr}};
  if (object.owner != nullptr) json["owner"] = std::string(object.owner->name) + " of " + object.owner->robot->name;
  return json;
}

Json task_state(const kernel::Task& task, const kernel::Scheduler& scheduler) {
  constexpr const char* states[] = {"ready", "running", "blocked", "ended"};
  Json json = {{"number", task.number},
               {"name", task.name},
               {"robot", task.robot->name},
               {"state", states[static_cast<int>(task.state)]},
               {"local", task.local_time.ns()},
               {"operation", kernel::name(task.operation)},
               {"object", nullptr},
               {"work", task.work.what != nullptr ? std::string(task.work.what) + " " + task.work.of : ""},
               {"events", task.sequence}};
  const kernel::Object* const at = task.blocked_on != nullptr ? task.blocked_on : task.at;
  if (at != nullptr && kernel::has_entered(scheduler, *at)) json["object"] = object_state(*at);
  return json;
}

const char* state_of(const genom::Activity& activity) { return genom::name(activity.state); }

Json module_state(const genom::Module& module) {
  Json json = {{"name", module.name()}, {"activities", Json::array()}, {"tasks", Json::array()}};
  for (const genom::Activity& activity : module.activities().used())
    json["activities"].push_back({{"number", activity.number},
                                  {"request", activity.type != nullptr ? activity.type->name : ""},
                                  {"state", state_of(activity)},
                                  {"input", activity.input.text()}});
  for (const genom::ExecutionTask& task : module.tasks())
    json["tasks"].push_back({{"name", task.name()},
                             {"period", task.options().period_ms.ns()},
                             {"missed_periods", task.missed_periods()},
                             {"missed_deadlines", task.missed_deadlines()},
                             {"greatest_lateness", task.greatest_lateness().ns()},
                             {"suspended", task.suspended()}});
  return json;
}

Json poster_state(const genom::PosterBase& poster) {
  Json json = {{"name", poster.name()}, {"date", nullptr}, {"text", nullptr}};
  if (const std::optional<Time> date = poster.look_date()) {
    json["date"] = date->ns();
    std::string text = poster.look_text().value_or("");
    json["text"] = text.size() <= text_max ? Json(std::move(text)) : Json(nullptr);
  }
  return json;
}

}  // namespace

Json task_states(run::Experiment& experiment) {
  const kernel::Scheduler& scheduler = experiment.simulation().scheduler();
  Json json = {{"kind", "tasks"}, {"time", kernel::global_time(scheduler).ns()}, {"tasks", Json::array()}};
  for (const kernel::Task* task = kernel::roster(scheduler).first_task(); task != nullptr; task = task->next)
    json["tasks"].push_back(task_state(*task, scheduler));
  return json;
}

Json module_states(run::Experiment& experiment, std::size_t robot) {
  const genom::NameSpace& names = experiment.robots()[robot]->names();
  Json json = {{"kind", "modules"},
               {"time", experiment.simulation().global_time().ns()},
               {"robot", robot},
               {"modules", Json::array()},
               {"posters", Json::array()}};
  for (const auto& [name, module] : names.modules()) json["modules"].push_back(module_state(*module));
  for (const auto& [name, poster] : names.posters()) json["posters"].push_back(poster_state(*poster));
  return json;
}

}  // namespace waitpoint::tools::view
