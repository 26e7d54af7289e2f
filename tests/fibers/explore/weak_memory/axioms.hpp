// SPDX-License-Identifier: BSD-3-Clause
// The memory model of C++20 as axioms on an execution ([intro.races], [atomics.order]), independent of the runtime: no
// clocks, only relations between events.
#pragma once

#include <cstdint>
#include <vector>

#include "tests/fibers/explore/weak_memory/litmus.hpp"

namespace waitpoint::weak_memory {

/// A relation between at most 32 events: bit b of row a is set if a is related to b.
class Relation {
 public:
  explicit Relation(std::size_t events) : rows_(events, 0) {}

  void add(std::size_t a, std::size_t b) { rows_[a] |= std::uint32_t{1} << b; }
  bool has(std::size_t a, std::size_t b) const { return (rows_[a] >> b & 1) != 0; }
  void close();
  bool is_acyclic() const;

  friend Relation operator|(Relation a, const Relation& b);
  friend Relation operator*(const Relation& a, const Relation& b);

 private:
  std::vector<std::uint32_t> rows_;
};

struct Event {
  Step step;
  int thread;  ///< -1: the initial store of a location, before all threads
};

/// The events of a program, each with a store that it reads, and the modification order of each location.
struct Execution {
  explicit Execution(const Litmus& litmus);

  std::vector<Event> events;
  std::vector<std::size_t> source;              ///< by reading event: the store that it reads
  std::vector<std::vector<std::size_t>> order;  ///< by location: the modification order, the initial store first

  /// The values read, and the final ones.
  Outcome outcome(const Litmus& litmus) const;
};

/// True if the standard allows it. With `executed`, the events in an order of execution, only if that is an order as S.
bool is_allowed(const Execution& execution, const std::vector<std::size_t>* executed);

}  // namespace waitpoint::weak_memory
