// SPDX-License-Identifier: BSD-3-Clause
// The beginning of a linearization: some of a history's operations in an order that keeps that of operations that do
// not overlap, and what may come next.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "fibers/explore/linearizability/history.hpp"

namespace waitpoint::exploration {

template <class Model>
class Placement {
 public:
  using Entry = typename History<Model>::Entry;

  struct Successor {
    std::size_t operation;
    Model state;  // after it
  };

  /// Of `entries`, in order of invocation, with the events before `end` only: what responds later is pending.
  Placement(std::span<const Entry* const> entries, std::uint32_t end)
      : entries_(entries), end_(end), places_((entries.size() + 63) / 64) {
    for (const Entry* entry : entries_) {
      if (entry->interval.invoked < end_) ++count_;
      if (entry->interval.responded < end_) ++responses_left_;
    }
  }

  /// The operations in their order, as indices into the entries.
  const std::vector<std::size_t>& order() const { return order_; }
  /// A bit for each operation in order().
  const std::vector<std::uint64_t>& places() const { return places_; }
  /// True if all operations with a response are in order().
  bool is_complete() const { return responses_left_ == 0; }
  /// True if the operation's result, if it has one, is `result`.
  bool is_result_of(std::size_t i, const typename Model::Result& result) const {
    return responded(i) == Interval::pending || result == *entries_[i]->result;
  }
  const typename Model::Operation& operation(std::size_t i) const { return entries_[i]->operation; }

  /// Of the operations that were invoked before the first response of all that are left, those whose results are the
  /// model's in `state`; early responses first, which is often the order of effects. One that changes nothing is the
  /// only one: if a linearization has it later, it may have it here, too.
  std::vector<Successor> successors(const Model& state) {
    std::vector<Successor> found;
    for (const std::size_t i : open()) {
      Successor next{i, state};
      if (!is_result_of(i, next.state.apply(operation(i)))) continue;
      if (!(next.state == state)) {
        found.push_back(std::move(next));
      } else if (responded(i) != Interval::pending) {
        found.clear();
        found.push_back(std::move(next));
        break;
      }
    }
    return found;
  }

  /// The operations left that were invoked before the first response of all that are left, early responses first.
  std::vector<std::size_t> open() {
    std::vector<std::size_t> open;
    std::uint32_t first_response = Interval::pending;
    while (first_ < count_ && is_placed(first_)) ++first_;
    for (std::size_t i = first_; i < count_ && entries_[i]->interval.invoked < first_response; ++i) {
      if (is_placed(i)) continue;
      open.push_back(i);
      first_response = std::min(first_response, responded(i));
    }
    std::stable_sort(open.begin(), open.end(), [this](auto a, auto b) { return responded(a) < responded(b); });
    return open;
  }

  /// True if `a` responded before `b` was invoked.
  bool precedes(std::size_t a, std::size_t b) const { return responded(a) < entries_[b]->interval.invoked; }

  void place(std::size_t i) {
    places_[i / 64] |= std::uint64_t{1} << i % 64;
    if (responded(i) != Interval::pending) --responses_left_;
    order_.push_back(i);
  }
  void take_back() {
    const std::size_t i = order_.back();
    places_[i / 64] &= ~(std::uint64_t{1} << i % 64);
    if (responded(i) != Interval::pending) ++responses_left_;
    first_ = std::min(first_, i);
    order_.pop_back();
  }
  /// Replaces the order by another of the same operations, and perhaps more.
  void arrange(std::vector<std::size_t> order) {
    for (const std::size_t i : order)
      if (!is_placed(i)) place(i);
    order_ = std::move(order);
  }

 private:
  std::uint32_t responded(std::size_t i) const {
    const std::uint32_t event = entries_[i]->interval.responded;
    return event < end_ ? event : Interval::pending;
  }
  bool is_placed(std::size_t i) const { return (places_[i / 64] >> i % 64 & 1) != 0; }

  std::span<const Entry* const> entries_;
  std::uint32_t end_;
  std::size_t count_ = 0;  // those invoked before the end
  std::size_t first_ = 0;  // all before it are placed
  std::size_t responses_left_ = 0;
  std::vector<std::uint64_t> places_;
  std::vector<std::size_t> order_;
};

}  // namespace waitpoint::exploration
