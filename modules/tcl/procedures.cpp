// SPDX-License-Identifier: BSD-3-Clause
#include "modules/tcl/procedures.hpp"

#include <algorithm>
#include <utility>

namespace waitpoint::tcl {

using genom::State;

namespace {

// Abort is a request of every module.
bool can_be_request(const Procedure& procedure) {
  const auto fits = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
  };
  return procedure.name != "Abort" && std::all_of(procedure.name.begin(), procedure.name.end(), fits);
}

}  // namespace

Procedures::Procedures(genom::ModuleSetup& setup, const Library& library, const std::string& script)
    : Module(setup, number),
      library_(library),
      procedures_(library.procedures(script)),
      task_(add_task("calls", {.period_ms = {}, .delay_ms = {}, .cost_us = {}})) {
  std::erase_if(procedures_, [](const Procedure& each) { return !can_be_request(each); });
  for (const Procedure& procedure : procedures_) add(procedure);
}

void Procedures::add(const Procedure& procedure) {
  add_activity<ProcedureInput>(procedure.name, task_,
                               {.start =
                                    [this, name = procedure.name](auto& activity) {
                                      submit(activity.number, name + " " + activity.input.arguments.data());
                                      return State::sleep;
                                    },
                                .exec =
                                    [this](auto& activity) {
                                      const std::optional<bool> result = take_result(activity.number);
                                      if (!result) return State::sleep;
                                      if (!*result) activity.report = own_report(failed);
                                      return State::ether;
                                    },
                                .inter =
                                    [this](auto& activity) {
                                      interrupt(activity.number);
                                      return State::ether;
                                    }});
}

std::string Procedures::check(const std::string& procedure, const std::string& arguments) const {
  const auto found = std::find_if(procedures_.begin(), procedures_.end(),
                                  [&](const Procedure& each) { return each.name == procedure; });
  WAITPOINT_CHECK(found != procedures_.end(), "a call of a procedure is checked that the script does not have");
  return library_.check_call(*found, arguments);
}

std::deque<Procedures::Call>::iterator Procedures::find(std::int32_t activity) {
  return std::find_if(calls_.begin(), calls_.end(), [&](const Call& call) { return call.activity == activity; });
}

std::deque<Procedures::Call>::iterator Procedures::begun() {
  const auto call =
      std::find_if(calls_.begin(), calls_.end(), [](const Call& each) { return each.has_begun && !each.result; });
  WAITPOINT_CHECK(call != calls_.end(), "a call ends that has not begun");
  return call;
}

void Procedures::submit(std::int32_t activity, std::string command) {
  {
    const std::lock_guard guard(mutex_);
    calls_.push_back({.activity = activity, .command = std::move(command), .result = std::nullopt});
  }
  wake_();
}

void Procedures::interrupt(std::int32_t activity) {
  {
    const std::lock_guard guard(mutex_);
    const auto call = find(activity);
    if (!call->has_begun || call->result) {
      calls_.erase(call);
      return;
    }
    call->activity = -1;
  }
  wake_();
}

std::optional<bool> Procedures::take_result(std::int32_t activity) {
  const std::lock_guard guard(mutex_);
  const auto call = find(activity);
  const std::optional<bool> result = call->result;
  if (result) calls_.erase(call);
  return result;
}

std::optional<std::string> Procedures::begin() {
  const std::lock_guard guard(mutex_);
  const auto call = std::find_if(calls_.begin(), calls_.end(), [](const Call& each) { return !each.has_begun; });
  if (call == calls_.end()) return std::nullopt;
  call->has_begun = true;
  return call->command;
}

bool Procedures::is_interrupted() const {
  const std::lock_guard guard(mutex_);
  return std::any_of(calls_.begin(), calls_.end(), [](const Call& call) { return call.activity < 0; });
}

void Procedures::end(bool succeeded) {
  {
    const std::lock_guard guard(mutex_);
    const auto call = begun();
    if (call->activity < 0)
      calls_.erase(call);
    else
      call->result = succeeded;
  }
  task_.wake();
}

}  // namespace waitpoint::tcl
