// SPDX-License-Identifier: BSD-3-Clause
// A module: one control task, execution tasks, requests, activities and posters, to the semantics of GenoM.
//
// A module of one's own derives from Module, declares everything in its constructor and keeps its state in members:
// they are the functional data, guarded by the frame's locks while any of its codels runs.
//
//   class Blinker : public waitpoint::genom::Module {
//    public:
//     explicit Blinker(ModuleSetup& setup) : Module(setup, 42), task_(add_task("main", {.period_ms = 100ms})) {
//       setup.settings.read(parameters_);
//       add_activity<BlinkInput>("Blink", task_, {.exec = [this](auto& a) { ... return State::exec; }}, {"Blink"});
//     }
//   };
//
// See control_task.hpp and execution_task.hpp for what the tasks do with it.
#pragma once

#include <deque>
#include <memory>
#include <string>
#include <vector>

#include "modules/genom/control_task.hpp"
#include "modules/genom/execution_task.hpp"
#include "modules/genom/module_data.hpp"
#include "modules/genom/name_space.hpp"
#include "modules/genom/request.hpp"
#include "modules/genom/settings.hpp"

namespace waitpoint::io {
class Network;
}

namespace waitpoint::genom {

struct ModuleType;

/// What a module is made from.
struct ModuleSetup {
  NameSpace& names;   ///< of its robot
  std::string name;   ///< of the module on this robot
  Settings settings;  ///< what the scenario says of it
  /// For sockets to other robots, and mailboxes with names (fibers/io); null outside any scenario.
  io::Network* network = nullptr;
};

class Module {
 public:
  virtual ~Module();
  Module(const Module&) = delete;
  Module& operator=(const Module&) = delete;

  const std::string& name() const { return name_; }
  Mailbox& mailbox() { return data_.mailbox; }
  const std::deque<RequestType>& requests() const { return data_.requests; }
  /// Null if the module has no request of that name.
  const RequestType* find_request(const std::string& name) const;
  Report report(StandardReport code) const { return data_.report(code); }
  const std::deque<ExecutionTask>& tasks() const { return tasks_; }

  /// Throws BadInput for a cost in `settings`, those it was made from, that no codel of the module has.
  void check_costs(const Settings& settings) const;
  /// Tells `watch` what the module does from its start on; it must outlive the module's tasks. Null: nobody.
  void set_watch(ModuleWatch* watch) { control_.set_watch(watch); }
  /// Finds the posters that the module reads. One that nobody writes, or of another type, is BadInput.
  void connect();
  /// Starts the tasks; from a task of the module's robot, once all its modules are connected.
  void start();
  /// Waits until the tasks have ended, after an Abort with end_module.
  void join();

 protected:
  /// `number` distinguishes the module's reports from others'. The frame and its modules must be compiled for the same
  /// kind of threads.
  Module(ModuleSetup& setup, std::uint16_t number, threads::kind = {});

  /// The scenario may overwrite `options` under `tasks.<name>`, and say there how the task computes.
  ExecutionTask& add_task(const std::string& name, TaskOptions options);

  /// A control request: `codel` does it at once, from the control task.
  template <HasFields In, HasFields Out = Nothing>
  RequestType& add_control(const std::string& name,
                           std::type_identity_t<std::function<Report(const In& input, Out& output)>> codel,
                           std::vector<std::string> interrupts = {});

  /// An execution request of `task`.
  template <HasFields In, HasFields Out = Nothing>
  RequestType& add_activity(const std::string& name, ExecutionTask& task, std::type_identity_t<Codels<In, Out>> codels,
                            std::vector<std::string> interrupts = {});

  /// As add_activity, for a request that must have succeeded before execution requests are taken.
  template <HasFields In, HasFields Out = Nothing>
  RequestType& add_init(const std::string& name, ExecutionTask& task, std::type_identity_t<Codels<In, Out>> codels);

  /// A poster named "<module>.<name>", given by the codels of `task`; `automatic` is copied to it at every wake-up.
  template <HasFields T>
  OutputPoster<T>& add_poster(const std::string& name, ExecutionTask& task, const T* automatic = nullptr);

  /// The poster "<module>.<name>" or, with a dot in it, "<other module>.<name>". With `required` false it may be
  /// absent.
  template <HasFields T>
  PosterLink<T>& read_poster(const std::string& name, bool required = true);

  /// A report of the module's own, by its code from first_own_report on.
  Report own_report(std::uint16_t code) const { return make_report(data_.number, code); }

  /// Whether an activity whose END codel runs can be interrupted: GenoM's code says so, its guide says not. Default:
  /// yes.
  void set_interrupt_end(bool value) { control_.set_interrupt_end(value); }

 private:
  template <class M>
  friend ModuleType module_type(std::string name);

  RequestType& add_request(const std::string& name, RequestKind kind, std::vector<std::string> interrupts);
  void add_to(WorkingSet& set) const;

  struct Link {
    std::unique_ptr<PosterLinkBase> poster;
    bool required;
  };

  NameSpace& names_;
  std::string name_;
  Settings& settings_;  // of the setup: only while the module is being made
  TaskComputing of_all_tasks_, of_control_task_;
  ModuleData data_;
  std::deque<ExecutionTask> tasks_;
  std::vector<std::unique_ptr<OutputPosterBase>> outputs_;
  std::vector<Link> links_;
  ControlTask control_;
  std::vector<threads::thread> threads_;
  std::size_t size_ = sizeof(Module);  // with what a class of its own adds
};

// --- templates ---

template <HasFields In, HasFields Out>
RequestType& Module::add_control(const std::string& name,
                                 std::type_identity_t<std::function<Report(const In&, Out&)>> codel,
                                 std::vector<std::string> interrupts) {
  RequestType& type = add_request(name, RequestKind::control, std::move(interrupts));
  type.accepts = internal::accepts<In>;
  type.read_input = internal::read_input<In>;
  type.control = [codel = std::move(codel)](const Payload& input, Payload& output) {
    Out out{};
    const Report report = codel(input.as<In>(), out);
    output = Payload(out);
    return report;
  };
  return type;
}

template <HasFields In, HasFields Out>
RequestType& Module::add_activity(const std::string& name, ExecutionTask& task,
                                  std::type_identity_t<Codels<In, Out>> codels, std::vector<std::string> interrupts) {
  RequestType& type = add_request(name, RequestKind::execution, std::move(interrupts));
  type.task = &task;
  type.accepts = internal::accepts<In>;
  type.read_input = internal::read_input<In>;
  type.control = [control = codels.control](const Payload& input, Payload&) {
    return control ? control(input.as<In>()) : ok;
  };
  type.codel = [codels = std::move(codels)](State state, Activity& activity) {
    return internal::call_codel(codels, state, activity);
  };
  return type;
}

template <HasFields In, HasFields Out>
RequestType& Module::add_init(const std::string& name, ExecutionTask& task,
                              std::type_identity_t<Codels<In, Out>> codels) {
  RequestType& type = add_activity<In, Out>(name, task, std::move(codels));
  type.kind = RequestKind::init;
  control_.expect_init();
  return type;
}

template <HasFields T>
OutputPoster<T>& Module::add_poster(const std::string& name, ExecutionTask& task, const T* automatic) {
  auto output = std::make_unique<OutputPoster<T>>(names_.create_poster<T>(name_ + "." + name, name_), automatic);
  OutputPoster<T>& reference = *output;
  task.add(reference);
  outputs_.push_back(std::move(output));
  return reference;
}

template <HasFields T>
PosterLink<T>& Module::read_poster(const std::string& name, bool required) {
  const std::string full = name.find('.') == std::string::npos ? name_ + "." + name : name;
  auto link = std::make_unique<PosterLink<T>>(full);
  PosterLink<T>& reference = *link;
  links_.push_back({std::move(link), required});
  return reference;
}

}  // namespace waitpoint::genom
