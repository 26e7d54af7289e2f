// SPDX-License-Identifier: BSD-3-Clause
// Text for tasks and their choices: the woken waiter, a spurious wake-up, the cost of a computation.
#pragma once

#include <string>

#include "fibers/explore/schedules/explorer.hpp"
#include "fibers/sync/report/code_place.hpp"

namespace waitpoint::exploration {

/// "consumer#2 of r1": the number distinguishes tasks of one name. Without robots, the robot is omitted.
std::string title_of(const Task& task);
/// "consumer#2, about to lock mutex #1".
std::string about_to(const Task& task);
/// "lock mutex #1": what the task is about to do.
std::string next_event(const Task& task);

/// An alternative in words, and the code that they name at their end; none without its module.
struct ChoiceText {
  std::string words;
  sync::CodePlace place = {};
};

/// The effect of an alternative other than one between tasks: "wakes thread#3", "wakes up spuriously". During the
/// choice.
ChoiceText in_words(Choice choice, const Task& task, std::uint32_t alternative, std::uint32_t count);

}  // namespace waitpoint::exploration
