// SPDX-License-Identifier: BSD-3-Clause
// Litmus tests: a few threads, each with a few atomic operations, written as data, and the set of their outcomes.
//
//   {{store(x, 1, release), load(y, acquire)}, {store(y, 1, release), load(x, acquire)}}
//
// An outcome is the values of all loads and read-modify-writes, by threads and their steps, then the final values of
// the locations that the program stores to more than once. All locations begin with 0.
#pragma once

#include <atomic>
#include <set>
#include <string>
#include <vector>

namespace waitpoint::weak_memory {

struct Step {
  enum class Kind { load, store, add, exchange, fence };

  Kind kind;
  int location;
  int value;
  std::memory_order order;

  bool reads() const { return kind == Kind::load || kind == Kind::add || kind == Kind::exchange; }
  bool writes() const { return kind == Kind::store || kind == Kind::add || kind == Kind::exchange; }
};

using Litmus = std::vector<std::vector<Step>>;
using Outcome = std::vector<int>;
using Outcomes = std::set<Outcome>;

inline constexpr int x = 0, y = 1, z = 2, locations = 3;
inline constexpr auto relaxed = std::memory_order_relaxed, consume = std::memory_order_consume,
                      acquire = std::memory_order_acquire, release = std::memory_order_release,
                      acq_rel = std::memory_order_acq_rel, seq_cst = std::memory_order_seq_cst;

constexpr Step load(int location, std::memory_order order) { return {Step::Kind::load, location, 0, order}; }
constexpr Step store(int location, int value, std::memory_order order) {
  return {Step::Kind::store, location, value, order};
}
constexpr Step add(int location, int value, std::memory_order order) {
  return {Step::Kind::add, location, value, order};
}
constexpr Step exchange(int location, int value, std::memory_order order) {
  return {Step::Kind::exchange, location, value, order};
}
constexpr Step fence(std::memory_order order) { return {Step::Kind::fence, 0, 0, order}; }

/// True if its final value is part of the outcome.
bool is_final(const Litmus& litmus, int location);
std::string text_of(const Litmus& litmus);
std::string text_of(const Outcomes& outcomes);

/// Executes it once, in instrumented code, within a simulation. `note` is given each value of the outcome, with the
/// number of its thread, or of all threads for the final values.
void execute(const Litmus& litmus, void (*note)(std::size_t thread, int value));

}  // namespace waitpoint::weak_memory
