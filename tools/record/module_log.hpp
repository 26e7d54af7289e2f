// SPDX-License-Identifier: BSD-3-Clause
// Requests to the modules of a robot and their outcomes, in words: "GoTo: asked", "GoTo: activity 0 started", "GoTo:
// activity 0 ended: ok".
#pragma once

#include <string>
#include <vector>

#include "modules/genom/module_watch.hpp"

namespace waitpoint::tools {

class ModuleLog final : public genom::ModuleWatch {
 public:
  struct Line {
    Time date;
    std::string module, text;
    bool is_bad = false;  ///< ended with a report other than ok
  };

  /// Events are passed on to `next`; null: to none.
  explicit ModuleLog(genom::ModuleWatch* next = nullptr) : next_(next) {}

  void on(const genom::Module& module, const genom::ModuleEvent& event) override;
  /// All lines since the last call, in chronological order.
  std::vector<Line> take();

 private:
  struct Told {
    const genom::Module* module;
    genom::ModuleEvent event;
  };
  genom::ModuleWatch* next_;
  std::vector<Told> told_;  // formatted later: the stacks of the modules' tasks are small
};

}  // namespace waitpoint::tools
