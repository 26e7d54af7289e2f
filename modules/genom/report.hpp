// SPDX-License-Identifier: BSD-3-Clause
// Reports: the outcome of a request. 32 bits: module number << 16 | code; 0 is success.
//
// Codes 1 to 99 are the standard codes, the same for every module, and up to 11 GenoM's; a module's own start at
// first_own_report.
#pragma once

#include <cstdint>

namespace waitpoint::genom {

using Report = std::uint32_t;

inline constexpr Report ok = 0;

enum class StandardReport : std::uint16_t {
  activity_interrupted = 1,
  too_many_activities = 2,
  activity_failed = 3,
  wait_abort_zombie_activity = 4,
  unknown_activity = 5,
  forbidden_activity_transition = 6,
  system_error = 7,
  activity_already_ended = 8,
  wait_init_request = 9,
  control_codel_error = 10,
  exec_task_suspended = 11,
  rejected_by_control = 12,  ///< by the rules of the robot's execution control: modules/control
};

inline constexpr std::uint16_t first_own_report = 100;

constexpr Report make_report(std::uint16_t module_number, std::uint16_t code) {
  return std::uint32_t{module_number} << 16 | code;
}
constexpr Report make_report(std::uint16_t module_number, StandardReport code) {
  return make_report(module_number, static_cast<std::uint16_t>(code));
}
constexpr std::uint16_t module_of(Report report) { return static_cast<std::uint16_t>(report >> 16); }
constexpr std::uint16_t code_of(Report report) { return static_cast<std::uint16_t>(report & 0xFFFF); }
constexpr bool is(Report report, StandardReport code) { return code_of(report) == static_cast<std::uint16_t>(code); }

/// The name of a standard report; "own report" for a module's own, "ok" for success.
constexpr const char* name(Report report) {
  constexpr const char* names[] = {"ok",
                                   "ACTIVITY_INTERRUPTED",
                                   "TOO_MANY_ACTIVITIES",
                                   "ACTIVITY_FAILED",
                                   "WAIT_ABORT_ZOMBIE_ACTIVITY",
                                   "UNKNOWN_ACTIVITY",
                                   "FORBIDDEN_ACTIVITY_TRANSITION",
                                   "SYSTEM_ERROR",
                                   "ACTIVITY_ALREADY_ENDED",
                                   "WAIT_INIT_RQST",
                                   "CONTROL_CODEL_ERROR",
                                   "EXEC_TASK_SUSPENDED",
                                   "REJECTED_BY_CONTROL"};
  const std::uint16_t code = code_of(report);
  return code < sizeof names / sizeof *names ? names[code] : "own report";
}

}  // namespace waitpoint::genom
