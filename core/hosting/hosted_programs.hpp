// SPDX-License-Identifier: BSD-3-Clause
// The programs of an owner, in its order: each starts when its conditions hold.
#pragma once

#include <functional>
#include <vector>

#include "core/hosting/program_host.hpp"

namespace waitpoint {

class HostedPrograms {
 public:
  using Holds = std::function<bool(const StartCondition&)>;

  /// `holds` decides of conditions that are not of programs. The host must outlive this.
  explicit HostedPrograms(ProgramHost& host, Holds holds = holds_outside) : host_(host), holds_(std::move(holds)) {}

  /// Prepares it in the host. Throws HostingError.
  void add(HostedProgram program);
  std::size_t size() const { return programs_.size(); }
  const HostedProgram& program(std::size_t number) const { return programs_[number].program; }

  /// Starts it if it has not been, and its conditions hold; true if it was started. Throws HostingError.
  bool start_if_due(std::size_t number);
  /// The same for all: the start of one may be another's condition.
  void start_those_due();

  bool has_started(std::size_t number) const { return programs_[number].has_started; }
  bool runs(std::size_t number) const { return has_started(number) && !end_of(number); }
  /// None if it has not ended, or not started.
  std::optional<ProgramEnd> end_of(std::size_t number) const;
  bool have_all_started() const;
  bool have_all_ended() const;
  /// True if a program waits for a condition that is not of programs.
  bool waits_for_outside() const;
  /// The first condition that does not hold; null if all do.
  const StartCondition* awaited_by(std::size_t number) const;

 private:
  struct Hosted {
    HostedProgram program;
    bool has_started = false;
  };

  bool holds(const StartCondition& condition, const HostedProgram& of) const;

  ProgramHost& host_;
  Holds holds_;
  std::vector<Hosted> programs_;
};

}  // namespace waitpoint
