// SPDX-License-Identifier: BSD-3-Clause
// Sits between the kernel and an explorer, and describes the choices that differ from the default: the time, the tasks,
// the cost of a computation.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "fibers/explore/report/choice_text.hpp"
#include "fibers/explore/schedules/explorer.hpp"

namespace waitpoint::exploration {

/// A choice as text.
struct Told {
  Time time;
  std::uint64_t event;  ///< number of events before it
  std::string words;
  sync::CodePlace place = {};  ///< named at their end; none without its module
};

struct Narration {
  std::vector<Told> switches;
  std::optional<Told> answer;         ///< the decision that was asked for
  std::optional<ChoiceText> instead;  ///< the alternative to it, of a choice that is not between tasks

  void add(const Told& told, bool is_switch, bool is_answer);
};

class Narrator : public kernel::Decisions {
 public:
  Narrator(kernel::Scheduler& scheduler, Explorer& explorer) : scheduler_(scheduler), explorer_(explorer) {}

  /// Also describes decision `number`, default or not, and this alternative to it.
  void ask_for(std::size_t number, std::optional<std::uint32_t> instead = {}) {
    asked_ = number;
    instead_ = instead;
  }

  const Narration& narration() const { return narration_; }

  std::uint32_t next(kernel::Task* const* ready, std::uint32_t count) override;
  std::uint32_t among(kernel::Choice choice, const kernel::Task& task, std::uint32_t count) override;
  Duration computing(const kernel::Task& task, Duration least, Duration greatest) override;
  /// As Explorer::process(); the processes have these names.
  std::uint32_t process(const kernel::Task& task, std::span<const char* const> names, std::uint32_t spinning,
                        bool can_continue);

 protected:
  virtual void keep(const Told& told, bool is_switch, bool is_answer) { narration_.add(told, is_switch, is_answer); }

 private:
  template <class Words>
  void tell(std::size_t decisions_before, const Words& words);
  std::size_t decisions() const { return explorer_.schedule().decisions.size(); }

  bool is_asked() const { return asked_ && *asked_ == decisions(); }

  kernel::Scheduler& scheduler_;
  Explorer& explorer_;
  std::optional<std::size_t> asked_;
  std::optional<std::uint32_t> instead_;
  Narration narration_;
};

/// "12.340000000 s  segloc.slam of rackham computes 33 ms instead of 95 ms": one a line, indented; the last
/// `lines_max` of them.
std::string to_text(const std::vector<Told>& switches, std::size_t lines_max);

}  // namespace waitpoint::exploration
