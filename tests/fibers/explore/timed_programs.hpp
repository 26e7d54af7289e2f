// SPDX-License-Identifier: BSD-3-Clause
// Programs that are correct only by their computing times: without times, other orders are possible, which never happen
// on the robot. Each has one interval that can be widened far enough for the failure to happen.
#pragma once

#include <cstdint>
#include <functional>
#include <string_view>
#include <vector>

namespace waitpoint::timed {

/// A computing time of a task between two of its events.
struct Spent {
  std::uint64_t task;   ///< its id
  std::uint64_t after;  ///< the number of its previous events
  std::int64_t least_us, greatest_us;
};

class Times {
 public:
  enum class Mode { untimed, as_declared, widened };
  explicit Times(Mode mode) : mode_(mode) {}

  /// The caller computes for this time; untimed, for none.
  void spend(std::int64_t least_us, std::int64_t greatest_us);
  /// The interval that decides.
  void critical(std::int64_t least_us, std::int64_t greatest_us, std::int64_t wider_us);

  /// A body begins: clears the recorded times.
  void begin() { spent_.clear(); }
  const std::vector<Spent>& spent() const { return spent_; }

 private:
  Mode mode_;
  std::vector<Spent> spent_;
};

struct Program {
  std::string_view name;
  void (*body)(Times& times);
};

/// By kind: order, and mutual exclusion.
extern const std::vector<Program> orders;
extern const std::vector<Program> exclusions;

/// All twenty, of both kinds.
std::vector<Program> programs();

}  // namespace waitpoint::timed
