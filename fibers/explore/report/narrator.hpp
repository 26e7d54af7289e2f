// SPDX-License-Identifier: BSD-3-Clause
// Sits between the kernel and an explorer, and describes the choices that differ from the default: the time, the tasks,
// the cost of a computation.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fibers/explore/schedules/explorer.hpp"

namespace waitpoint::exploration {

/// A choice as text.
struct Told {
  Time time;
  std::uint64_t event;  ///< number of events before it
  std::string words;
};

class Narrator final : public kernel::Decisions {
 public:
  Narrator(kernel::Scheduler& scheduler, Explorer& explorer) : scheduler_(scheduler), explorer_(explorer) {}

  /// Also describes decision `number`, default or not.
  void ask_for(std::size_t number) { asked_ = number; }

  const std::vector<Told>& switches() const { return switches_; }
  const std::optional<Told>& answer() const { return answer_; }

  std::uint32_t next(kernel::Task* const* ready, std::uint32_t count) override;
  std::uint32_t among(kernel::Choice choice, const kernel::Task& task, std::uint32_t count) override;
  Duration computing(const kernel::Task& task, Duration least, Duration greatest) override;

 private:
  template <class Words>
  void tell(const Words& words);

  kernel::Scheduler& scheduler_;
  Explorer& explorer_;
  std::size_t decisions_ = 0;
  std::optional<std::size_t> asked_;
  std::optional<Told> answer_;
  std::vector<Told> switches_;
};

/// "12.340000000 s  segloc.slam of rackham computes 33 ms instead of 95 ms": one a line, indented; the last
/// `lines_max` of them.
std::string to_text(const std::vector<Told>& switches, std::size_t lines_max);

}  // namespace waitpoint::exploration
