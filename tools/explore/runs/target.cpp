// SPDX-License-Identifier: BSD-3-Clause
#include "tools/explore/runs/target.hpp"

#include <utility>

#include "tools/explore/runs/fields.hpp"

namespace waitpoint::tools {
namespace {

template <class Pass, class P, class R, class S>
void pass_fields(Pass& pass, P& plan, R& request, S& repeats) {
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
  pass(request);
  pass(repeats);
}

}  // namespace

void Target::set_profile(exploration::Profile profile) {
  runs_.reset();
  profile_ = std::move(profile);
}

void Target::set_limit(double seconds) {
  runs_.reset();
  limit_s_ = seconds;
}

void Target::switch_at(std::optional<SwitchAt> at) {
  runs_.reset();
  fixed_switch_at_ = at;
}

void Target::ignore_races() {
  runs_.reset();
  races_fail_ = false;
}

Children& Target::runs() {
  if (!runs_)
    runs_.emplace(
        [this](std::string_view request) { return execute(request); },
        Children::Limits{
            .wall_s = has_processes() ? 0 : limit_s_, .computes = !has_processes(), .is_reused = has_processes()});
  return *runs_;
}

std::string Target::to_request(const Plan& plan, const Request& request, const Repeats& repeats) {
  FieldWriter writer;
  pass_fields(writer, plan, request, repeats);
  return std::move(writer.bytes);
}

std::string Target::execute(std::string_view bytes) {
  Plan plan;
  Request request;
  Repeats repeats;
  FieldReader reader(bytes);
  pass_fields(reader, plan, request, repeats);
  FieldWriter results;
  for (std::uint32_t left = repeats.count;; --left, plan.number += repeats.step) {
    const Finding finding = run(plan, request);
    results(to_bytes(finding));
    if (left == 0 || !finding.passed()) return std::move(results.bytes);
  }
}

std::vector<Finding> Target::findings_of(const Children::Ended& ended) {
  std::vector<Finding> findings;
  if (const std::string death = death_of(ended); !death.empty()) {
    findings.emplace_back().kind = Finding::Kind::killed;
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
