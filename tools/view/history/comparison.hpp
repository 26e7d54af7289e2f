// SPDX-License-Identifier: BSD-3-Clause
// The first event that differs between two lines of time: by digests at instants, ever closer to each other, to the
// part of the run where it is, and by the events of that part.
#pragma once

#include <memory>

#include "tools/view/history/history.hpp"

namespace waitpoint::tools::view {

class Comparison : public std::enable_shared_from_this<Comparison> {
 public:
  /// The history must outlive this. BadInput as from History::apart().
  Comparison(History& history, History::Owner owner, std::size_t line, std::size_t other)
      : history_(history), owner_(owner), lines_{line, other}, part_(history.apart(line, other)), end_(part_.to) {}

  /// {"event", "time", "a", "b"}: the number of the first event that differs, and both as text. Null: none does, but
  /// values do from about `time` on, if it is there.
  void begin(History::Reply reply);

 private:
  void compare_digests();
  void compare_events();
  void decide(const std::array<std::string, 2>& replies);
  void ask_both(const Json& request, const std::function<void(const std::array<std::string, 2>&)>& use);

  History& history_;
  History::Owner owner_;
  std::array<std::size_t, 2> lines_;
  TimeLines::Span part_;  // that has the difference
  Time end_, values_differ_;
  History::Reply reply_;
};

}  // namespace waitpoint::tools::view
