// SPDX-License-Identifier: BSD-3-Clause
// The data shared by all tasks of one module, and the two locks that guard it.
//
//   control data      requests, activities, mailbox: used by the frame
//   functional data   the members of the module's class: used by its codels
//
// Each wake-up of a task takes both locks.
#pragma once

#include <deque>
#include <mutex>
#include <string>

#include "modules/genom/activity_table.hpp"
#include "modules/genom/mailbox.hpp"
#include "modules/genom/report.hpp"
#include "modules/genom/request.hpp"

namespace waitpoint::genom {

struct ModuleData {
  ModuleData(const std::string& module, std::uint16_t number) : number(number), name(module), mailbox(module) {}

  /// A standard report of this module.
  Report report(StandardReport code) const { return make_report(number, code); }

  const std::uint16_t number;  ///< identifies the module in its reports
  const std::string name;
  Mailbox mailbox;
  // On as few cache lines as possible: every wake-up of every task touches them.
  alignas(64) threads::mutex control_lock{"control data"};
  bool ending = false;  ///< set by an Abort with end_module
  alignas(64) threads::mutex functional_lock{"functional data"};
  std::deque<RequestType> requests;
  ActivityTable activities;
};

/// Holds both locks of a module, always taken in the order control data, functional data.
class BothLocks {
 public:
  explicit BothLocks(ModuleData& data) : control_(data.control_lock), functional_(data.functional_lock) {}

 private:
  std::lock_guard<threads::mutex> control_;
  std::lock_guard<threads::mutex> functional_;
};

}  // namespace waitpoint::genom
