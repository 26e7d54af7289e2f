// SPDX-License-Identifier: BSD-3-Clause
#include "tools/explore/target.hpp"

#include <utility>

#include "tools/explore/fields.hpp"

namespace waitpoint::tools {
namespace {

template <class Pass, class P, class R>
void pass_fields(Pass& pass, P& plan, R& request) {
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

void Target::switch_at(SwitchAt at) {
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

std::string Target::to_request(const Plan& plan, const Request& request) {
  FieldWriter writer;
  pass_fields(writer, plan, request);
  return std::move(writer.bytes);
}

std::string Target::execute(std::string_view bytes) {
  Plan plan;
  Request request;
  FieldReader reader(bytes);
  pass_fields(reader, plan, request);
  return to_bytes(run(plan, request));
}

bool needs_profile(const std::string& strategy) {
  const std::string kind = strategy.substr(0, strategy.find(':'));
  return kind != "random" && kind != "pos" && kind != "fifo";
}

}  // namespace waitpoint::tools
