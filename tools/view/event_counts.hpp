// SPDX-License-Identifier: BSD-3-Clause
// The number of events and of missed deadlines of each task in periods of the run: the timeline as seen from afar, for
// which no event need be kept. When there are many periods, two become one.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "modules/run/experiment.hpp"

namespace waitpoint::tools::view {

class EventCounts {
 public:
  /// Before the run, which must outlive this.
  explicit EventCounts(run::Experiment& experiment);

  /// Call after each step of the world, between events: takes the counts of the periods that have ended by `now`, and
  /// notes new collisions, the first thousand.
  void take(Time now);
  /// {"kind":"counts","period":...,...}.
  std::string text() const;

 private:
  struct OfTask {
    std::string head;       // as JSON
    std::size_t first = 0;  // the period of its first count
    std::uint64_t last_events = 0;
    std::int64_t last_missed = 0;
    std::vector<std::uint32_t> events, missed;  // by period, from `first`
  };

  void halve();
  void note_collisions(Time now);

  run::Experiment& experiment_;
  Duration period_ = std::chrono::seconds(1);
  std::size_t periods_ = 0;
  std::map<std::uint32_t, OfTask> tasks_;               // by number
  std::vector<std::uint64_t> collisions_;               // so far, by robot
  std::vector<std::pair<Time, std::size_t>> collided_;  // with the robot
};

}  // namespace waitpoint::tools::view
