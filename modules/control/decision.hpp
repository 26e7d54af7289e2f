// SPDX-License-Identifier: BSD-3-Clause
// Decisions of the execution control: the entries of its log. Each is the value of the poster "control.decision" for a
// time, and so part of the robot's digest.
#pragma once

#include <string>

#include "core/fields.hpp"

namespace waitpoint::control {

enum class Verdict : std::uint8_t {
  accepted,     ///< the request went to its module
  rejected,     ///< final reply REJECTED_BY_CONTROL
  delayed,      ///< the request waits
  interrupted,  ///< the activity was aborted
  unresolved,   ///< a forbidden state that no running activity is the cause of
  withdrawn,    ///< a delayed request, by its client
};

constexpr const char* name(Verdict verdict) {
  constexpr const char* names[] = {"accepted", "rejected", "delayed", "interrupted", "unresolved", "withdrawn"};
  return names[static_cast<int>(verdict)];
}

struct Decision {
  Time date;
  Verdict verdict = Verdict::accepted;
  std::uint32_t number = 0;    ///< of the request, counted by the control from 1; 0: none
  std::uint32_t module = 0;    ///< among the robot's modules by name
  std::uint32_t request = 0;   ///< of that module
  std::int32_t check = -1;     ///< in the order of the rules; -1: none
  std::int32_t activity = -1;  ///< of an interrupted one: its number; -1: not known yet

  static void fields(auto field) {
    field("date", &Decision::date);
    field("verdict", &Decision::verdict);
    field("number", &Decision::number);
    field("module", &Decision::module);
    field("request", &Decision::request);
    field("check", &Decision::check);
    field("activity", &Decision::activity);
  }
};

/// An observer of the decisions, for tests and reports. Observation makes no event of the run.
class DecisionWatch {
 public:
  virtual ~DecisionWatch() = default;
  /// `text` is a line such as "3.200 s rackham: ndd.GoTo #7 delayed by mast.stowed", without the robot's name.
  virtual void on(const Decision& decision, const std::string& text) = 0;
};

}  // namespace waitpoint::control
