// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/explore/target/evidence_text.hpp"

#include <sstream>

#include "fibers/explore/report/event_columns.hpp"
#include "fibers/explore/report/place_text.hpp"
#include "fibers/explore/report/reordered_events.hpp"

namespace waitpoint::exploration {
namespace {

constexpr std::size_t lines_of_events_max = 30, lines_of_switches_max = 12;

}  // namespace

void tell(const Narration& narration, const WantedEvidence& wanted, Evidence& evidence) {
  if (const auto& answer = narration.answer; wanted.decision && answer) {
    evidence.told = "at " + to_string(answer->time) + " s: " + with_lines(std::vector{*answer}).front().words;
    if (narration.instead) evidence.told += "; it passes if it " + with_lines(std::vector{*narration.instead}).front();
  }
  if (wanted.words && !wanted.decision) evidence.told = to_text(with_lines(narration.switches), lines_of_switches_max);
}

void tell(const Timeline& timeline, const WantedEvents& wanted, Evidence& evidence) {
  evidence.last_events = to_text(timeline, lines_of_events_max);
  if (wanted.cause) evidence.cause = cause_in_words(timeline, *wanted.cause);
  if (wanted.page) evidence.columns = to_columns(timeline, wanted.marks());
  if (!wanted.trace) return;
  std::ostringstream text;
  write_trace(text, timeline);
  evidence.trace = text.str();
}

void tell(Time time, const std::string& event, const std::vector<std::string>& calls, Evidence& evidence) {
  evidence.told = with_calls("at " + to_string(time) + " s: " + event, calls);
}

}  // namespace waitpoint::exploration
