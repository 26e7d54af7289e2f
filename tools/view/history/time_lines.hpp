// SPDX-License-Identifier: BSD-3-Clause
// The lines of time of a run, and the snapshots on them: copies that stand at an instant, from which others are made.
//
//   line 0    the run, with a snapshot every so often
//   others    branches: they leave another line at an instant, where something was intervened
//
// Before that instant a branch is the line that it leaves: states, events and their numbers are the same there.
#pragma once

#include <algorithm>
#include <functional>
#include <string>
#include <vector>

#include "core/time.hpp"
#include "tools/view/history/copies.hpp"
#include "tools/view/history/snapshots.hpp"
#include "tools/view/view_json.hpp"

namespace waitpoint::tools::view {

struct TimeLine {
  std::string name;
  int parent = -1;  ///< the line that it leaves; -1: none
  Time from = {}, reached = {};
  std::vector<DatedText> interventions = {};  ///< with which it leaves that line
  std::vector<Snapshot> snapshots = {};       ///< by time
};

class TimeLines {
 public:
  /// The run ends at `limit` at the latest; so do branches.
  explicit TimeLines(Time limit) : limit_(limit) { lines_.push_back({.name = "run"}); }

  std::size_t size() const { return lines_.size(); }
  TimeLine& operator[](std::size_t number) { return lines_[number]; }
  const std::vector<TimeLine>& all() const { return lines_; }
  /// The number of the line that a request has; BadInput if there is none.
  std::size_t number_in(const Json& request, const char* key = "line") const;
  /// Returns the number of the new line; BadInput as from check_room().
  std::size_t add(TimeLine line);
  /// BadInput if there are too many lines.
  void check_room() const;
  /// How far the line can be looked at: a branch goes on when it is asked.
  Time end(std::size_t line) const { return line == 0 ? lines_.front().reached : limit_; }

  /// A snapshot of line 0, later than those before, until which the run has written `copied_bytes` of the one before.
  /// `leave` is called with those that are given up for it: see thin_out().
  void add_snapshot(Snapshot snapshot, std::uint64_t copied_bytes, const Copies::Use& leave);

  using IsEarly = std::function<bool(const Snapshot& snapshot)>;
  /// For a copy of the line: its last snapshot, or one of the lines before it, that is early enough; else the first.
  /// BadInput if no snapshot is left.
  Origin origin(std::size_t line, const IsEarly& is_early) const;
  Origin origin_before(std::size_t line, Time time) const {
    return origin(line, [time](const Snapshot& snapshot) { return snapshot.time <= time; });
  }
  /// The line that this one is at `time`: one that it has left later, or itself.
  std::size_t line_at(std::size_t line, Time time) const;

  struct Span {
    Time from, to;
  };
  /// Where two lines may differ: from where one of them, or a line on the way to it, leaves the last line that they
  /// have in common, to where both have come. BadInput for one line twice.
  Span apart(std::size_t line, std::size_t other) const;

  /// For the status: [{"line", "from", "to", "parent", "name"}]; "to": its end().
  Json status() const;

 private:
  std::vector<std::size_t> way_to(std::size_t line) const;

  Time limit_;
  std::vector<TimeLine> lines_;
  std::uint64_t bytes_max_ = snapshot_bytes_max();
};

}  // namespace waitpoint::tools::view
