// SPDX-License-Identifier: BSD-3-Clause
// An observer of a module's control task, for recordings and tests. Observation makes no event of the run.
#pragma once

#include <cstdint>

#include "core/time.hpp"
#include "modules/genom/mailbox.hpp"

namespace waitpoint::genom {

class Module;
struct RequestType;

struct ModuleEvent {
  Time date;        ///< of the control task's clock
  LetterKind kind;  ///< a request was taken; its activity starts (intermediate reply); it ended (final reply)
  const RequestType& request;  ///< lives as long as its module
  std::int32_t activity = -1;  ///< its number; -1 for a control request or a rejected one
  Report report = ok;          ///< of a final reply
};

class ModuleWatch {
 public:
  virtual ~ModuleWatch() = default;
  /// Called by the module's control task with its locks held: must not modify, block or throw.
  virtual void on(const Module& module, const ModuleEvent& event) = 0;
};

}  // namespace waitpoint::genom
