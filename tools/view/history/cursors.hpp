// SPDX-License-Identifier: BSD-3-Clause
// Cursors: copies of a run at the instants that viewers look at, one for each viewer and line of time. A cursor goes on
// from where it is; to go back, another one is made.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "tools/view/history/copies.hpp"
#include "tools/view/history/time_lines.hpp"

namespace waitpoint::tools::view {

using Owner = std::uint64_t;  ///< a viewer

class Cursors {
 public:
  /// Both must outlive this.
  Cursors(Copies& copies, TimeLines& lines) : copies_(copies), lines_(lines) {}
  ~Cursors();
  Cursors(const Cursors&) = delete;
  Cursors& operator=(const Cursors&) = delete;

  /// Requests of run_copy.hpp at the owner's cursor of that line: "seek" {line, time}, and step, tasks, modules,
  /// journal where the last one has left it. A negative count of steps is back.
  void ask(Owner owner, const Json& request, const Reply& reply);
  /// The owner has gone.
  void forget(Owner owner);

 private:
  struct Cursor {
    std::shared_ptr<Peer> peer;  // null: it is being made
    Time time;                   // that it was last sent to
    std::uint64_t events = 0;    // as its last reply has it
    bool is_made = false;
    std::vector<std::pair<std::string, Reply>> waiting;

    void note(const std::string& frame);
  };
  using Key = std::pair<Owner, std::size_t>;  // with the line

  Cursor& at(const Key& key, Time time);
  Cursor& make(const Key& key, const Origin& origin);
  Reply noting(const Key& key, const Reply& reply);
  void go_to_event(const Key& key, std::uint64_t event, const Reply& reply);
  void step_back(const Key& key, const Json& request, std::uint64_t events, const Reply& reply);
  void ask_at(Cursor& cursor, std::string request, const Reply& reply);

  Copies& copies_;
  TimeLines& lines_;
  std::map<Key, std::shared_ptr<Cursor>> cursors_;
};

/// A request of a viewer as a copy takes it, with its times put before `end`, how far the line can be looked at.
std::string text_for_copy(Json request, const std::string& what, Time end);

}  // namespace waitpoint::tools::view
