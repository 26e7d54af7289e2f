// SPDX-License-Identifier: BSD-3-Clause
// Explains a failed schedule: the last choice from which it could still have passed, the two events that this choice
// reorders, with both call stacks, and the timeline of each task.
#pragma once

#include <optional>
#include <string>

#include "fibers/explore/minimize.hpp"
#include "fibers/explore/report/finding_file.hpp"
#include "fibers/explore/report/reordered_events.hpp"

namespace waitpoint::exploration {

/// The same failure with the tasks' source locations, which take a second to look up.
Failure with_places(Body& body, const Failure& failure);

struct CriticalChoice {
  std::size_t decision;
  std::uint32_t instead;              ///< the alternative that passes
  std::vector<Decision> passing;      ///< all decisions of that run
  std::optional<EventPair> reversed;  ///< the pair of events whose order differs
};

struct Explanation {
  std::string
      text;  ///< lines: the number of switches, and those that are not between tasks; the choice; the last events
  std::optional<CriticalChoice> choice;  ///< the last from which it could still have passed, if one was found
  std::string choice_words, steps;       ///< of the text
};

/// Within `effort`.
Explanation explain(Body& body, const Failure& failure, Effort effort);

/// The two schedules with the pair of events, for a page.
void add_schedules(Body& body, const Failure& failure, const std::optional<CriticalChoice>& choice,
                   FindingFile& finding);

}  // namespace waitpoint::exploration
