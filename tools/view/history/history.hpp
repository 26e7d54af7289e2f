// SPDX-License-Identifier: BSD-3-Clause
// The past of a run, and what might have been: lines of time, each with copies of the run (run_copy.hpp) that stand at
// instants of it, the snapshots. To look at an instant, the last snapshot before it is asked for a copy, a cursor,
// which goes on to that instant. So nothing is recorded, and every event of the past can be seen.
//
//   line 0    the run, with a snapshot every so often
//   others    branches: they leave another line at an instant, where something was intervened
//
// In the process of the viewer: nothing here waits.
#pragma once

#include <functional>
#include <list>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/time.hpp"
#include "tools/view/history/peer.hpp"
#include "tools/view/view_json.hpp"

namespace waitpoint::tools::view {

/// Calls back when a descriptor can be read: the viewer's loop.
struct Loop {
  std::function<void(int descriptor, std::function<void()> ready)> watch;
  std::function<void(int descriptor)> forget;
};

class History {
 public:
  /// The text of a JSON object; with "error" if it was refused.
  using Reply = std::function<void(std::string text)>;
  using Owner = std::uint64_t;  ///< of cursors

  explicit History(Loop loop) : loop_(std::move(loop)) { lines_.push_back({.name = "run"}); }
  ~History();
  History(const History&) = delete;
  History& operator=(const History&) = delete;

  /// A snapshot of line 0, later than those before.
  void add_snapshot(Time time, std::uint64_t events, Channel channel);
  /// Of line 0: fewer than before if they were too many.
  std::size_t snapshots() const { return lines_.front().snapshots.size(); }
  /// The run has come so far.
  void set_reached(Time time) { lines_.front().reached = time; }

  /// Requests of run_copy.hpp at the owner's cursor of that line: "seek" {line, time}, and step, tasks, modules,
  /// journal where the last one has left it.
  /// A negative count of steps is back.
  void ask_cursor(Owner owner, const Json& request, const Reply& reply);
  /// events, plot, stack, digests, counts of a line: in a copy of their own, few at a time, in the order of asking.
  void ask_once(Owner owner, const Json& request, const Reply& reply);
  /// {line, time, interventions}: a new line.
  void branch(const Json& request, const Reply& reply);
  /// The owner has gone: its cursors, and what it still waits for.
  void forget(Owner owner);

  struct Span {
    Time from, to;
  };
  /// Where two lines may differ: from the one's leaving the other to where both have come. BadInput if neither is a
  /// branch of the other.
  Span apart(std::size_t line, std::size_t other) const;
  /// For the status: [{"line", "from", "to", "parent", "name"}].
  Json lines() const;

 private:
  struct Snapshot {
    Time time;
    std::uint64_t events;  // so far
    std::shared_ptr<Peer> peer;
  };
  struct Line {
    std::string name;
    int parent = -1;
    Time from = {}, reached = {};
    std::vector<Snapshot> snapshots = {};  // by time
  };
  struct Cursor {
    std::shared_ptr<Peer> peer;  // null: it is being made
    Time time;                   // that it was last sent to
    std::uint64_t events = 0;    // as its last reply has it
    bool is_made = false;
    std::vector<std::pair<std::string, Reply>> waiting;

    void note(const std::string& frame);
  };
  using CursorKey = std::pair<Owner, int>;  // with the line

  struct Question {
    Owner owner;
    Json request;
    Reply reply;
  };

  Line& line_of(const Json& request);
  const Snapshot& last_snapshot(const Line& line, const std::function<bool(const Snapshot&)>& is_early) const;
  const Snapshot& snapshot_before(const Line& line, Time time) const;
  void thin_out(Line& line);
  std::shared_ptr<Peer> join(Channel channel);
  void leave(const std::shared_ptr<Peer>& peer);
  using Use = std::function<void(const std::shared_ptr<Peer>& peer)>;
  void copy(const Snapshot& from, const Reply& reply, Use use);
  Cursor& cursor_at(const CursorKey& key, const Line& line, Time time);
  Cursor& new_cursor(const CursorKey& key, const Snapshot& from);
  Reply noting(const CursorKey& key, const Reply& reply);
  void go_to_event(const CursorKey& key, std::uint64_t event, const Reply& reply);
  void step_back(const CursorKey& key, const Json& request, std::uint64_t events, const Reply& reply);
  void ask(Cursor& cursor, std::string request, const Reply& reply);
  void ask_next();
  void ask_now(const Question& question);
  void add_line(const std::shared_ptr<Peer>& peer, Line line, const Reply& reply);
  void intervene(const std::shared_ptr<Peer>& peer, std::vector<std::string> texts, const Line& line,
                 const Reply& reply);

  Loop loop_;
  std::vector<Line> lines_;
  std::map<CursorKey, std::shared_ptr<Cursor>> cursors_;
  std::list<Question> questions_;  // that wait for others
  int under_way_ = 0;              // of those in copies of their own
};

}  // namespace waitpoint::tools::view
