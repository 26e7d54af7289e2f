// SPDX-License-Identifier: BSD-3-Clause
#include "core/hosting/hosted_programs.hpp"

#include <algorithm>

namespace waitpoint {

void HostedPrograms::add(HostedProgram program) {
  host_.add(program);
  programs_.push_back({std::move(program)});
}

bool HostedPrograms::holds(const StartCondition& condition, const HostedProgram& of) const {
  if (!condition.is_of_program()) return holds_(condition);
  for (std::size_t i = 0; i < programs_.size(); ++i) {
    const HostedProgram& other = programs_[i].program;
    if (other.name != condition.of || other.robot != of.robot) continue;
    return condition.kind == StartCondition::Kind::start ? has_started(i) : end_of(i).has_value();
  }
  return false;
}

const StartCondition* HostedPrograms::awaited_by(std::size_t number) const {
  const HostedProgram& of = programs_[number].program;
  const auto awaited = std::ranges::find_if_not(of.after, [&](const StartCondition& each) { return holds(each, of); });
  return awaited != of.after.end() ? &*awaited : nullptr;
}

bool HostedPrograms::start_if_due(std::size_t number) {
  if (has_started(number) || awaited_by(number) != nullptr) return false;
  programs_[number].has_started = true;
  host_.start(number);
  return true;
}

void HostedPrograms::start_those_due() {
  for (bool any = true; any;) {
    any = false;
    for (std::size_t i = 0; i < programs_.size(); ++i) any = start_if_due(i) || any;
  }
}

std::optional<ProgramEnd> HostedPrograms::end_of(std::size_t number) const {
  return has_started(number) ? host_.end_of(number) : std::nullopt;
}

bool HostedPrograms::have_all_started() const { return std::ranges::all_of(programs_, &Hosted::has_started); }

bool HostedPrograms::have_all_ended() const {
  for (std::size_t i = 0; i < programs_.size(); ++i)
    if (!end_of(i)) return false;
  return true;
}

bool HostedPrograms::waits_for_outside() const {
  return std::ranges::any_of(programs_, [](const Hosted& each) {
    return !each.has_started && !std::ranges::all_of(each.program.after, &StartCondition::is_of_program);
  });
}

}  // namespace waitpoint
