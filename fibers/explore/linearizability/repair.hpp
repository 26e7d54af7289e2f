// SPDX-License-Identifier: BSD-3-Clause
// A quick search that may miss a linearization: one order, mended where it is stuck.
//
// Operations are placed in the order of their responses. Where the next response has no explanation, one operation is
// moved, together with those that it must follow or precede; the others keep their order, except that one whose result
// the model does not give there waits until it does. This finds what an exhaustive search is slow at: the order of two
// overlapping pushes into a queue appears only in much later pops.
#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "fibers/explore/linearizability/placement.hpp"

namespace waitpoint::exploration {

template <class Model>
class Repair {
 public:
  Repair(Placement<Model>& placement, const Model& initial) : placement_(placement), states_{initial} {}

  /// True if the placement is complete now. If not, it is some beginning.
  bool run() {
    while (!placement_.is_complete()) {
      auto successors = placement_.successors(states_.back());
      if (!successors.empty()) {
        placement_.place(successors.front().operation);
        states_.push_back(std::move(successors.front().state));
      } else if (!mend()) {
        return false;
      }
    }
    return true;
  }

 private:
  bool mend() {
    const std::vector<std::size_t> open = placement_.open();
    std::vector<std::size_t> order = placement_.order();
    order.push_back(open.front());
    for (std::size_t from = order.size(); from-- > 0;)
      if (mend_by_moving(order, from)) return true;
    for (auto i = open.begin() + 1; i != open.end(); ++i) {
      order.push_back(*i);
      if (mend_by_moving(order, order.size() - 1)) return true;
      order.pop_back();
    }
    return false;
  }

  // Moves the operation at `from` before or behind any that overlaps it.
  bool mend_by_moving(const std::vector<std::size_t>& order, std::size_t from) {
    using Range = std::vector<std::size_t>;
    const std::size_t i = order[from];
    const auto at = [](Range& range, std::size_t position) {
      return range.begin() + static_cast<std::ptrdiff_t>(position);
    };
    for (std::size_t to = from; to-- > 0;) {
      if (placement_.precedes(order[to], i)) continue;
      Range moved = order;
      std::stable_partition(at(moved, to), at(moved, from + 1),
                            [&](std::size_t other) { return other == i || placement_.precedes(other, i); });
      if (takes(moved, to)) return true;
    }
    for (std::size_t to = from + 1; to < order.size(); ++to) {
      if (placement_.precedes(i, order[to])) continue;
      Range moved = order;
      std::stable_partition(at(moved, from), at(moved, to + 1),
                            [&](std::size_t other) { return other != i && !placement_.precedes(i, other); });
      if (takes(moved, from)) return true;
    }
    return false;
  }

  // Takes that order, which is as before up to position `same`, if its results are the model's.
  bool takes(const std::vector<std::size_t>& order, std::size_t same) {
    std::vector<std::size_t> taken(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(same)), waiting;
    std::vector<Model> after;
    const auto take = [&](std::size_t i) {
      Model state = after.empty() ? states_[same] : after.back();
      if (!placement_.is_result_of(i, state.apply(placement_.operation(i)))) return false;
      taken.push_back(i);
      after.push_back(std::move(state));
      return true;
    };
    for (std::size_t k = same; k < order.size(); ++k) {
      const auto must_be_before = [&](std::size_t other) { return placement_.precedes(other, order[k]); };
      if (std::any_of(waiting.begin(), waiting.end(), must_be_before)) return false;
      if (!take(order[k])) {
        waiting.push_back(order[k]);
        continue;
      }
      for (std::size_t next = 0; next < waiting.size();) {
        const bool is_taken = take(waiting[next]);
        if (is_taken) waiting.erase(waiting.begin() + static_cast<std::ptrdiff_t>(next));
        next = is_taken ? 0 : next + 1;
      }
    }
    if (!waiting.empty()) return false;
    placement_.arrange(std::move(taken));
    states_.erase(states_.begin() + static_cast<std::ptrdiff_t>(same) + 1, states_.end());
    states_.insert(states_.end(), after.begin(), after.end());
    return true;
  }

  Placement<Model>& placement_;
  std::vector<Model> states_;  // before the first operation of the order, after it, after the second, ...
};

}  // namespace waitpoint::exploration
