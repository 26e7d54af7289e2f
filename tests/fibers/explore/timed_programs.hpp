// SPDX-License-Identifier: BSD-3-Clause
// Programs that are right only because of how long their computations take: untimed, other orders are possible, which
// never happen on the robot. Each has one interval that can be widened so far that the failure can happen.
#pragma once

#include <cstdint>
#include <functional>
#include <string_view>
#include <vector>

namespace waitpoint::timed {

/// That a task computed between two of its events.
struct Spent {
  std::uint64_t task;   ///< its id
  std::uint64_t after;  ///< its events before
  std::int64_t least_us, greatest_us;
};

class Times {
 public:
  enum class Mode { untimed, as_declared, widened };
  explicit Times(Mode mode) : mode_(mode) {}

  /// The caller computes for so long; untimed, this takes no time.
  void spend(std::int64_t least_us, std::int64_t greatest_us);
  /// The interval on which all depends.
  void critical(std::int64_t least_us, std::int64_t greatest_us, std::int64_t wider_us);

  /// A body begins: what was spent before is forgotten.
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

/// By their kind: what must be done before something else; what must not be done at the same time.
extern const std::vector<Program> orders;
extern const std::vector<Program> exclusions;

/// Twenty of them: all of both kinds.
std::vector<Program> programs();

}  // namespace waitpoint::timed
