// SPDX-License-Identifier: BSD-3-Clause
#include "tools/explore/runs/target.hpp"

#include <algorithm>
#include <cstdio>
#include <utility>

#include "tools/command/interruption.hpp"
#include "tools/explore/runs/fields.hpp"
#include "tools/explore/runs/replay_command.hpp"
#include "tools/explore/runs/switch_points.hpp"

namespace waitpoint::tools {
namespace {

template <class Pass, class P, class R, class S>
void pass_fields(Pass& pass, P& plan, R& wanted, S& repeats) {
  pass(plan.number);
  pass(plan.drawn);
  pass(plan.strategy);
  pass(plan.switches);
  pass(plan.deviations);
  pass(plan.constraints);
  pass(plan.progress);
  pass(plan.at_random_from);
  pass(plan.attempt);
  pass(plan.until);
  pass(wanted);
  pass(repeats);
}

}  // namespace

std::string ProcessTarget::replay_command(const Finding& finding, const std::string& token) const {
  return tools::replay_command(with_switches_at(finding.switch_at, options()), token);
}

std::optional<Finding> ProcessTarget::run_apart(const Plan& plan, const WantedEvidence& wanted) {
  runs().start(0, to_request(plan, wanted));
  while (!is_at_end())
    if (const auto ended = runs().wait(look_around_ms)) return findings_of(*ended).front();
  stop_runs();
  return std::nullopt;
}

void ProcessTarget::stop_runs() {
  constexpr double patience_s = 10, patience_at_end_s = 0.4;
  if (!options().program.empty())
    if (const auto ended = runs().stop_longest(interruption() != 0 ? patience_s : patience_at_end_s))
      if (const std::string words = findings_of(*ended).back().words; !words.empty())
        std::fprintf(stderr, "waitpoint: %s\n", words.c_str());
  runs().kill_from(0);
}

bool ProcessTarget::is_at_end() const { return interruption() != 0 || time_limit_.is_over(); }

// Of what is left of the time one half is for fewer switches, a quarter for the explanation, the rest for the report.
exploration::TargetTraits ProcessTarget::traits() const {
  const double left_s = std::max(time_limit_.left_s(), 0.001);
  return {.to_minimize = {.runs = 2000, .seconds = std::min(90.0, left_s / 2)},
          .to_explain = {.runs = 200, .seconds = std::min(60.0, left_s / 4)}};
}

void ProcessTarget::set_profile(exploration::Profile profile) {
  runs_.reset();
  profile_ = std::move(profile);
}

void ProcessTarget::set_limit(double seconds) {
  runs_.reset();
  limit_s_ = seconds;
}

void ProcessTarget::set_time_limit(const exploration::TimeLimit& time_limit) {
  runs_.reset();
  time_limit_ = time_limit;
}

void ProcessTarget::set_patience(double seconds) {
  runs_.reset();
  patience_s_ = seconds;
}

void ProcessTarget::switch_at(std::optional<SwitchAt> at) {
  runs_.reset();
  fixed_switch_at_ = at;
}

void ProcessTarget::ignore_races() {
  runs_.reset();
  races_fail_ = false;
}

Children& ProcessTarget::runs() {
  if (!runs_)
    runs_.emplace(
        [this](std::string_view request) { return execute(request); },
        Children::Limits{
            .wall_s = has_processes() ? 0 : limit_s_, .computes = !has_processes(), .is_reused = has_processes()});
  return *runs_;
}

std::string ProcessTarget::to_request(const Plan& plan, const WantedEvidence& wanted, const Repeats& repeats) {
  FieldWriter writer;
  pass_fields(writer, plan, wanted, repeats);
  return std::move(writer.bytes);
}

std::string ProcessTarget::execute(std::string_view bytes) {
  Plan plan;
  WantedEvidence wanted;
  Repeats repeats;
  FieldReader reader(bytes);
  pass_fields(reader, plan, wanted, repeats);
  FieldWriter results;
  for (std::uint32_t left = repeats.count;; --left, plan.number += repeats.step) {
    WantedEvidence wanted_now = wanted;
    wanted_now.pairs |= is_sampled(plan);
    const Finding finding = run(plan, wanted_now);
    results(to_bytes(finding));
    if (left == 0 || !finding.passed()) return std::move(results.bytes);
  }
}

// Of a program's search.
bool ProcessTarget::is_sampled(const Plan& plan) {
  if (!plan.drawn || !plan.strategy.empty() || options().program.empty()) return false;
  if (!sampled_) sampled_.emplace(options().strategy);
  return sampled_->contain(plan.number);
}

std::vector<Finding> ProcessTarget::findings_of(const Children::Ended& ended) {
  std::vector<Finding> findings;
  if (const std::string death = death_of(ended); !death.empty()) {
    findings.emplace_back().kind = RunVerdict::Kind::killed;
    findings.back().words = death;
    return findings;
  }
  for (FieldReader reader(ended.bytes); !reader.is_at_end();) {
    std::string bytes;
    reader(bytes);
    findings.push_back(finding_of(bytes));
  }
  return findings;
}

bool needs_profile(const std::string& strategy) {
  const std::string kind = strategy.substr(0, strategy.find(':'));
  return kind != "random" && kind != "pos" && kind != "fifo";
}

}  // namespace waitpoint::tools
