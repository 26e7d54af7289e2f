// SPDX-License-Identifier: BSD-3-Clause
// A module whose codels are C functions, as `waitpoint genom` generates it from a description.
//
// C codels have no `this`: what GenoM's macros give them (SDI_F, CURRENT_ACTIVITY_NUM, the ids of posters and clients)
// is the context of the calling task, which is set while a codel of the module runs in it. So several robots of a run
// may have the same module.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "modules/genom/c_client.hpp"
#include "modules/genom/codels.h"
#include "modules/genom/module.hpp"

namespace waitpoint::genom {

/// A value with declared fields that stands for a value of C.
template <class T>
concept OfC = HasFields<T> && requires(T& value, const T& constant, typename T::CType& c) {
  value.from(c);
  constant.to(c);
};

class CModule : public Module {
 public:
  /// The module whose codel the calling task executes. A call outside of codels is a misuse.
  static CModule& running();

  /// The number of the activity whose codel the calling task executes; -1 in codels of tasks and of control.
  static int activity();
  /// A task's period in seconds, by its number in the description; 0 for an aperiodic one.
  double period_s(int task) const;

  /// A client of the module `name` of this robot, the same for later calls; null if there is no such module.
  CClient* client(const std::string& name);
  /// A poster of this robot by its name here, "demo.Mobile", or in GenoM, "demoMobile"; null if there is none.
  PosterBase* find_poster(const std::string& name) const;

 protected:
  CModule(ModuleSetup& setup, std::uint16_t number) : Module(setup, number), names_(setup.names) {}

  /// Calls a control codel, `codel(&report)`; the report of the request.
  template <class Codel>
  Report control(const Codel& codel) {
    const Running scope(*this, -1);
    int report = OK;
    if (codel(&report) == OK) return ok;
    return report != OK ? static_cast<Report>(report) : this->report(StandardReport::control_codel_error);
  }

  /// Calls a codel of an activity, `codel(&report)`; the state that it returns.
  template <class Activity, class Codel>
  State step(Activity& activity, const Codel& codel) {
    const Running scope(*this, activity.number);
    int report = static_cast<int>(activity.report);
    const ACTIVITY_EVENT event = codel(&report);
    activity.report = static_cast<Report>(report);
    return static_cast<State>(event);
  }

  /// Calls a codel of a task, `codel(&report)`. After an ERROR the task is suspended.
  template <class Codel>
  void permanent(ExecutionTask& task, const Codel& codel) {
    const Running scope(*this, -1);
    int report = OK;
    if (codel(&report) != OK) task.suspend();
  }

 private:
  // While it lives, the calling task executes a codel of the module.
  class Running {
   public:
    Running(CModule& module, int activity);
    ~Running();
    Running(const Running&) = delete;
    Running& operator=(const Running&) = delete;
  };

  NameSpace& names_;
  std::vector<std::pair<std::string, std::unique_ptr<CClient>>> clients_;
};

}  // namespace waitpoint::genom
