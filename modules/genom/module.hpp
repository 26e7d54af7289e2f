// SPDX-License-Identifier: BSD-3-Clause
// A module: a component of a robot's software, to the semantics of GenoM. It has one control task, execution tasks,
// requests (calls to it), activities (requests under execution), whose code is split into codels, and posters (values
// that it publishes).
//
// A user's module derives from Module, declares everything in its constructor and keeps its state in members: they are
// the functional data, guarded by the frame's locks while any of its codels runs.
//
//   class Blinker : public waitpoint::genom::Module {
//    public:
//     explicit Blinker(ModuleSetup& setup) : Module(setup, 42), task_(add_task("main", {.period_ms = 100ms})) {
//       setup.settings.read(parameters_);
//       add_activity<BlinkInput>("Blink", task_, {.exec = [this](auto& a) { ... return State::exec; }}, {"Blink"});
//     }
//   };
//
// control_task.hpp and execution_task.hpp describe the two kinds of tasks.
#pragma once

#include <deque>
#include <memory>
#include <string>
#include <vector>

#include "core/occupancy_grid.hpp"
#include "modules/genom/control_task.hpp"
#include "modules/genom/execution_task.hpp"
#include "modules/genom/module_data.hpp"
#include "modules/genom/module_type.hpp"
#include "modules/genom/name_space.hpp"
#include "modules/genom/request.hpp"
#include "modules/genom/settings.hpp"

namespace waitpoint::io {
class Network;
}

namespace waitpoint::genom {

/// Constructor arguments of a module.
struct ModuleSetup {
  NameSpace& names;   ///< of its robot
  std::string name;   ///< of the module on this robot
  Settings settings;  ///< from the scenario
  /// For sockets to other robots and named mailboxes (fibers/io); null without a network.
  io::Network* network = nullptr;
  /// The planner's map before the run; null without one.
  std::shared_ptr<const OccupancyGrid> known_map = nullptr;
};

class Module {
 public:
  virtual ~Module();
  Module(const Module&) = delete;
  Module& operator=(const Module&) = delete;

  const std::string& name() const { return name_; }
  Mailbox& mailbox() { return data_.mailbox; }
  const std::deque<RequestType>& requests() const { return data_.requests; }
  /// Null if the module has no request with that name.
  const RequestType* find_request(const std::string& name) const;
  Report report(StandardReport code) const { return data_.report(code); }
  const std::deque<ExecutionTask>& tasks() const { return tasks_; }
  /// For observers between events.
  const ActivityTable& activities() const { return data_.activities; }

  /// Throws BadInput if `settings`, from which the module was made, has a cost for a task without permanent codels.
  void check_costs(const Settings& settings) const;
  /// Reports the module's activity to `watch`, which must outlive the module's tasks. Call before start(). Null: no
  /// watch.
  void set_watch(ModuleWatch* watch) { control_.set_watch(watch); }
  /// Connects the posters that the module reads. A missing required poster, or one of another type, is BadInput.
  void connect();
  /// Starts the tasks; from a task of the module's robot, once all its modules are connected.
  void start();
  /// Waits for the end of the tasks, after an Abort with end_module.
  void join();

 protected:
  /// `number` identifies the module in its reports. The frame and its modules must be compiled for the same kind of
  /// threads.
  Module(ModuleSetup& setup, std::uint16_t number, threads::kind = {});

  /// The scenario may override `options` under `tasks.<name>`, and set the task's clock, processor and priority there.
  ExecutionTask& add_task(const std::string& name, TaskOptions options);

  /// A control request: the control task runs `codel` at once.
  template <HasFields In, HasFields Out = Nothing>
  RequestType& add_control(const std::string& name,
                           std::type_identity_t<std::function<Report(const In& input, Out& output)>> codel,
                           std::vector<std::string> interrupts = {});

  /// An execution request, executed by `task`.
  template <HasFields In, HasFields Out = Nothing>
  RequestType& add_activity(const std::string& name, ExecutionTask& task, std::type_identity_t<Codels<In, Out>> codels,
                            std::vector<std::string> interrupts = {});

  /// As add_activity, for an initialisation request: execution requests are rejected until it has succeeded.
  template <HasFields In, HasFields Out = Nothing>
  RequestType& add_init(const std::string& name, ExecutionTask& task, std::type_identity_t<Codels<In, Out>> codels);

  /// A poster named "<module>.<name>", written by the codels of `task`; `automatic`, if given, is copied to it at the
  /// end of every wake-up.
  template <HasFields T>
  OutputPoster<T>& add_poster(const std::string& name, ExecutionTask& task, const T* automatic = nullptr);

  /// The same, with a value that `compute` makes at the end of every wake-up.
  template <HasFields T>
  OutputPoster<T>& add_computed_poster(const std::string& name, ExecutionTask& task,
                                       std::type_identity_t<std::function<void(T& value)>> compute);

  /// Links the poster "<module>.<name>" or, if `name` has a dot, "<other module>.<name>". With `required` false it may
  /// be absent.
  template <HasFields T>
  PosterLink<T>& read_poster(const std::string& name, bool required = true);

  /// A report of the module's own; `code` is at least first_own_report.
  Report own_report(std::uint16_t code) const { return make_report(data_.number, code); }

  /// True (the default): an activity can be interrupted in its END state, as in GenoM's code; false: not, as in its
  /// guide.
  void set_interrupt_end(bool value) { control_.set_interrupt_end(value); }

 private:
  template <class M>
  friend ModuleType module_type(std::string name);

  template <HasFields T>
  OutputPoster<T>& add_output(ExecutionTask& task, std::unique_ptr<OutputPoster<T>> output);
  RequestType& add_request(const std::string& name, RequestKind kind, std::vector<std::string> interrupts);
  void add_to(WorkingSet& set) const;

  struct Link {
    std::unique_ptr<PosterLinkBase> poster;
    bool required;
  };

  NameSpace& names_;
  std::string name_;
  Settings& settings_;  // of the setup: valid only during construction
  TaskComputing of_all_tasks_, of_control_task_;
  ModuleData data_;
  std::deque<ExecutionTask> tasks_;
  std::vector<std::unique_ptr<OutputPosterBase>> outputs_;
  std::vector<Link> links_;
  ControlTask control_;
  std::vector<threads::thread> threads_;
  std::size_t size_ = sizeof(Module);  // of the derived class
};

// --- templates ---

template <HasFields In, HasFields Out>
RequestType& Module::add_control(const std::string& name,
                                 std::type_identity_t<std::function<Report(const In&, Out&)>> codel,
                                 std::vector<std::string> interrupts) {
  RequestType& type = add_request(name, RequestKind::control, std::move(interrupts));
  type.accepts = internal::accepts<In>;
  type.read_input = internal::read_input<In>;
  type.has_input = internal::has_input<In>;
  type.input_shape = internal::input_shape<In>;
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
  type.has_input = internal::has_input<In>;
  type.input_shape = internal::input_shape<In>;
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
OutputPoster<T>& Module::add_output(ExecutionTask& task, std::unique_ptr<OutputPoster<T>> output) {
  OutputPoster<T>& reference = *output;
  task.add(reference);
  outputs_.push_back(std::move(output));
  return reference;
}

template <HasFields T>
OutputPoster<T>& Module::add_poster(const std::string& name, ExecutionTask& task, const T* automatic) {
  Poster<T>& poster = names_.create_poster<T>(name_ + "." + name, name_);
  return add_output(task, std::make_unique<OutputPoster<T>>(poster, automatic));
}

template <HasFields T>
OutputPoster<T>& Module::add_computed_poster(const std::string& name, ExecutionTask& task,
                                             std::type_identity_t<std::function<void(T& value)>> compute) {
  Poster<T>& poster = names_.create_poster<T>(name_ + "." + name, name_);
  return add_output(task, std::make_unique<OutputPoster<T>>(poster, std::move(compute)));
}

template <HasFields T>
PosterLink<T>& Module::read_poster(const std::string& name, bool required) {
  const std::string full = name.find('.') == std::string::npos ? name_ + "." + name : name;
  auto link = std::make_unique<PosterLink<T>>(full);
  PosterLink<T>& reference = *link;
  links_.push_back({std::move(link), required});
  return reference;
}

/// Registers a module class, constructible from ModuleSetup&, under a name.
template <class M>
ModuleType module_type(std::string name) {
  return {std::move(name), [](ModuleSetup& setup) -> std::unique_ptr<Module> {
            auto module = std::make_unique<M>(setup);
            static_cast<Module&>(*module).size_ = sizeof(M);
            return module;
          }};
}

}  // namespace waitpoint::genom
