// SPDX-License-Identifier: BSD-3-Clause
// Questions about parts of a line of time, each answered by a copy of its own: few at a time, since each takes a
// processor, in the order of asking.
#pragma once

#include <list>

#include "tools/view/history/copies.hpp"
#include "tools/view/history/cursors.hpp"
#include "tools/view/history/time_lines.hpp"

namespace waitpoint::tools::view {

class Questions {
 public:
  /// Both must outlive this.
  Questions(Copies& copies, TimeLines& lines) : copies_(copies), lines_(lines) {}

  /// events, plot, stack, digests, counts: run_copy.hpp.
  void ask(Owner owner, const Json& request, const Reply& reply);
  /// The owner has gone: its pending questions are not asked.
  void forget(Owner owner) {
    waiting_.remove_if([owner](const Question& question) { return question.owner == owner; });
  }

 private:
  struct Question {
    Owner owner;
    Json request;
    Reply reply;
  };

  void ask_next();
  void ask_now(const Question& question);
  Origin origin_of(const Json& request, std::size_t line) const;

  Copies& copies_;
  TimeLines& lines_;
  std::list<Question> waiting_;
  int under_way_ = 0;
};

}  // namespace waitpoint::tools::view
