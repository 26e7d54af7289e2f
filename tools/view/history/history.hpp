// SPDX-License-Identifier: BSD-3-Clause
// The past of a run, and its branches: lines of time, each with copies of the run (run_copy.hpp) that stand at
// instants of it, the snapshots. To look at an instant, the last snapshot before it is asked for a copy, which goes on
// to that instant. So nothing is recorded, and every event of the past can be seen.
//
// In the process of the viewer: nothing here waits.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/time.hpp"
#include "tools/view/history/copies.hpp"
#include "tools/view/history/cursors.hpp"
#include "tools/view/history/questions.hpp"
#include "tools/view/history/time_lines.hpp"

namespace waitpoint::tools::view {

class History {
 public:
  using Reply = view::Reply;
  using Owner = view::Owner;

  /// The run ends at `limit` at the latest.
  History(Loop loop, Time limit) : copies_(std::move(loop)), lines_(limit) {}
  ~History();
  History(const History&) = delete;
  History& operator=(const History&) = delete;

  /// A snapshot of line 0, later than those before, until which the run has written `copied_bytes` of the one before.
  void add_snapshot(Time time, std::uint64_t events, std::uint64_t copied_bytes, Channel channel);
  /// Of line 0: fewer than before if they were too many, or held too much memory.
  std::size_t snapshots() const { return lines_.all().front().snapshots.size(); }
  /// The run has come so far.
  void set_reached(Time time) { lines_[0].reached = time; }

  /// See Cursors::ask().
  void ask_cursor(Owner owner, const Json& request, const Reply& reply) { cursors_.ask(owner, request, reply); }
  /// See Questions::ask().
  void ask_once(Owner owner, const Json& request, const Reply& reply) { questions_.ask(owner, request, reply); }
  /// {line, time, interventions}: a new line.
  void branch(const Json& request, const Reply& reply);
  /// The owner has gone: its cursors and pending questions are dropped.
  void forget(Owner owner);

  /// See TimeLines::apart().
  TimeLines::Span apart(std::size_t line, std::size_t other) const { return lines_.apart(line, other); }
  /// The number of the line that the request has as `key`; BadInput if there is none.
  std::size_t line_in(const Json& request, const char* key) const { return lines_.number_in(request, key); }
  /// For the status: [{"line", "from", "to", "parent", "name"}].
  Json lines() const { return lines_.status(); }

 private:
  void intervene(const std::shared_ptr<Peer>& peer, std::vector<std::string> texts, TimeLine line, const Reply& reply);
  void add_line(const std::shared_ptr<Peer>& peer, TimeLine line, const Reply& reply);

  Copies copies_;
  TimeLines lines_;
  Cursors cursors_{copies_, lines_};
  Questions questions_{copies_, lines_};
};

}  // namespace waitpoint::tools::view
