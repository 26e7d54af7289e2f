// SPDX-License-Identifier: BSD-3-Clause
// Executes the schedules of a search: in this process one after the other, or in others several at once.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "fibers/explore/search/enumeration.hpp"
#include "fibers/explore/strategies/reads_from.hpp"
#include "fibers/explore/target/finding.hpp"

namespace waitpoint::exploration {

/// Drawn schedules of consecutive places in a search.
struct Batch {
  std::uint64_t place;                   ///< of the first
  std::uint64_t number;                  ///< of the first; those of the others grow by SearchExtent::step
  std::uint32_t count = 1;               ///< more than one only as Runner::capacity() allows
  const Constraints* learned = nullptr;  ///< of the only one, whose pairs are wanted: what earlier ones have led to
};

struct EndedSchedule {
  std::uint64_t place;
  RunVerdict verdict;
  std::unique_ptr<Finding> finding = {};   ///< null: it passed in this process
  std::span<const Decision> choices = {};  ///< of an enumerated one; valid until another is started
  std::span<const ReadsFrom> pairs = {};   ///< of a sampled one; the same, or as long as its finding
};

class Runner {
 public:
  virtual ~Runner() = default;

  /// Schedules are executed in other processes, which only return findings.
  virtual bool is_apart() const = 0;
  /// The number of drawn schedules that a batch may have now; 0: nothing can be started before one has ended.
  virtual std::uint32_t capacity() const = 0;
  virtual void start(const Batch& batch) = 0;
  /// The next schedule of the enumeration.
  virtual void start(std::uint64_t place, Enumeration& enumeration) = 0;
  /// Starts the rest of a batch that ended with a failure, if it is before place `end`; false if there is none.
  virtual bool start_rest(std::uint64_t) { return false; }

  /// No started schedule is left.
  virtual bool is_idle() const = 0;
  /// One that has ended, valid until the next call; null if none does for a while.
  virtual EndedSchedule* next_ended() = 0;
  /// Ends those from this place on: they are not needed.
  virtual void kill_from(std::uint64_t) {}
  /// A signal asks to end the search.
  virtual bool is_interrupted() const { return false; }
};

}  // namespace waitpoint::exploration
