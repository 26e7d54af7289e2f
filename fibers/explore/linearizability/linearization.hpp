// SPDX-License-Identifier: BSD-3-Clause
// The search for a linearization: a sequence of a history's operations that keeps the order of those that do not
// overlap, and in which each result is that of the sequential model (Herlihy and Wing 1990). A pending operation may be
// part of it, with any result, or not.
//
// After a quick attempt (repair.hpp), the search is depth-first over the operations that may come next (Wing and Gong
// 1993), without what it has been through, the same operations done with the same state (Lowe 2017). In the worst case
// the effort is exponential in the number of operations that overlap.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <unordered_set>
#include <utility>
#include <vector>

#include "core/digest.hpp"
#include "fibers/explore/linearizability/placement.hpp"
#include "fibers/explore/linearizability/repair.hpp"
#include "fibers/explore/linearizability/sequential_model.hpp"

namespace waitpoint::exploration {

enum class Linearized : std::uint8_t { yes, no, undecided };

template <class Model>
class Linearization {
 public:
  using Entry = typename History<Model>::Entry;

  /// Searches for one of `entries`, in order of invocation, which start at `initial`, with the events before `end`
  /// only; it is undecided after so many configurations.
  Linearization(std::span<const Entry* const> entries, const Model& initial, std::uint32_t end,
                std::uint64_t configurations_max) {
    Placement<Model> placement(entries, end);
    if (!Repair<Model>(placement, initial).run()) {
      placement = Placement<Model>(entries, end);
      result_ = search(placement, initial, configurations_max);
    }
    if (result_ == Linearized::yes) order_ = placement.order();
  }

  Linearized result() const { return result_; }
  /// The operations in their order, as indices into the entries; empty if there is none.
  const std::vector<std::size_t>& order() const { return order_; }

 private:
  struct Step {
    std::vector<typename Placement<Model>::Successor> successors;
    std::size_t next = 0;  // the successor to try next
  };
  struct Configuration {
    std::vector<std::uint64_t> places;
    Model state;

    bool operator==(const Configuration&) const = default;
  };
  struct HashOfConfiguration {
    std::size_t operator()(const Configuration& configuration) const {
      std::uint64_t hash = 0;
      for (const std::uint64_t word : configuration.places) hash = Digest::mix(hash ^ word);
      if constexpr (HashedModel<Model>) hash = Digest::mix(hash ^ configuration.state.hash());
      return hash;
    }
  };

  static Linearized search(Placement<Model>& placement, const Model& initial, std::uint64_t configurations_max) {
    std::unordered_set<Configuration, HashOfConfiguration> seen;  // never in its order
    std::vector<Step> steps;
    steps.push_back({placement.successors(initial)});
    while (!placement.is_complete()) {
      Step& step = steps.back();
      if (step.next == step.successors.size()) {
        steps.pop_back();
        if (steps.empty()) return Linearized::no;
        placement.take_back();
        continue;
      }
      const auto& [operation, state] = step.successors[step.next++];
      placement.place(operation);
      if (!seen.insert({placement.places(), state}).second)
        placement.take_back();
      else if (seen.size() > configurations_max)
        return Linearized::undecided;
      else
        steps.push_back({placement.successors(state)});
    }
    return Linearized::yes;
  }

  std::vector<std::size_t> order_;
  Linearized result_ = Linearized::yes;
};

}  // namespace waitpoint::exploration
