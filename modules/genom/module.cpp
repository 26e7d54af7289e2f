// SPDX-License-Identifier: BSD-3-Clause
#include "modules/genom/module.hpp"

namespace waitpoint::genom {

Module::Module(ModuleSetup& setup, std::uint16_t number, threads::kind)
    : names_(setup.names),
      name_(setup.name),
      settings_(setup.settings),
      of_all_tasks_(read_processor(settings_, "", names_)),
      of_control_task_(read_computing(settings_, "tasks.control.", names_, of_all_tasks_)),
      data_(setup.name, number),
      control_(*this, data_, tasks_, names_.create_poster<ModuleStatus>(setup.name + ".control", setup.name)) {
  settings_.describe_map("tasks", "its tasks by name: period, cost and clock, processor, priority of each");
  settings_.describe_map("tasks.control", "the module's control task, which takes requests");
  names_.add(name_, *this);
  add_control<AbortInput>("Abort",
                          [this](const AbortInput& input, Nothing&) { return control_.abort(input.activity); });
}

Module::~Module() = default;

ExecutionTask& Module::add_task(const std::string& name, TaskOptions options) {
  const bool is_periodic = options.period_ms > Duration();
  settings_.describe_map("tasks." + name, "an execution task of the module");
  settings_.read(options, "tasks." + name + ".");
  if (is_periodic) {
    const std::string key = "tasks." + name + ".period_ms";
    if (options.period_ms == Duration()) settings_.reject(key, "more than 0: the task is periodic");
    constexpr double least_ms = 1e-6;
    settings_.check_least(key, options.period_ms.seconds() * 1e3, least_ms);
  }
  const TaskComputing computing = read_computing(settings_, "tasks." + name + ".", names_, of_all_tasks_);
  return tasks_.emplace_back(data_, name, options, computing);
}

// The locks, the links, and the derived class's members, up to a bound: a wake-up touches little of a large class.
void Module::add_to(WorkingSet& set) const {
  constexpr std::size_t of_own_max = 512;
  set.add_between(&data_.control_lock, &data_.functional_lock);
  set.add(data_.functional_lock);
  set.add(data_.activities);
  for (const Link& link : links_) link.poster->add_to(set);
  set.add(reinterpret_cast<const char*>(this) + sizeof(Module), std::min(size_ - sizeof(Module), of_own_max));
}

void Module::check_costs(const Settings& settings) const {
  for (const ExecutionTask& task : tasks_) {
    const std::string key = "tasks." + task.name() + ".cost_us";
    if (!task.has_permanent() && settings.has(key)) settings.reject(key, "left out (the task has no permanent codel)");
  }
}

RequestType& Module::add_request(const std::string& name, RequestKind kind, std::vector<std::string> interrupts) {
  WAITPOINT_CHECK(find_request(name) == nullptr, "a module declares two requests of one name");
  RequestType& type = data_.requests.emplace_back();
  type.name = name;
  type.kind = kind;
  type.number = static_cast<std::uint32_t>(data_.requests.size() - 1);
  type.interrupts = std::move(interrupts);
  return type;
}

const RequestType* Module::find_request(const std::string& name) const {
  for (const RequestType& type : data_.requests)
    if (type.name == name) return &type;
  return nullptr;
}

void Module::connect() {
  for (Link& link : links_) {
    PosterBase* poster = names_.find_poster(link.poster->name());
    const std::string where = "module '" + name_ + "'";
    if (poster == nullptr) {
      if (link.required)
        throw BadInput(where, "reads poster '" + link.poster->name() + "', which no module of this robot writes");
    } else if (!link.poster->connect(*poster)) {
      throw BadInput(where,
                     "reads poster '" + poster->name() + "' as another type than '" + poster->writer() + "' writes");
    } else {
      poster->add_reader();
    }
  }
}

void Module::start() {
  const auto start_task = [this](const std::string& label, const TaskComputing& computing, auto run) {
    const threads::thread_attributes attributes{.name = label.c_str(),
                                                .service = true,
                                                .clock = computing.clock,
                                                .on = computing.on,
                                                .priority = computing.priority};
    threads_.emplace_back(attributes, run);
  };
  start_task(name_ + ".control", of_control_task_, [this] { control_.run(); });
  for (ExecutionTask& task : tasks_) {
    start_task(name_ + "." + task.name(), task.computing(),
               [this, &task] { task.run([this](WorkingSet& set) { add_to(set); }); });
  }
}

void Module::join() {
  for (threads::thread& thread : threads_) thread.join();
  threads_.clear();
}

}  // namespace waitpoint::genom
