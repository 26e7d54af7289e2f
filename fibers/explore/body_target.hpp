// SPDX-License-Identifier: BSD-3-Clause
// A body as a target: its runs are in this process, and cheap.
#pragma once

#include <string>

#include "fibers/explore/body.hpp"
#include "fibers/explore/target/target.hpp"

namespace waitpoint::exploration {

class BodyTarget final : public Target {
 public:
  /// `body` must outlive it. The numbers of runs are those of the analysis of a failure. `command` runs the program.
  BodyTarget(Body& body, std::string name, std::uint64_t runs_to_minimize, std::uint64_t runs_to_explain,
             std::string command = "")
      : body_(body),
        name_(std::move(name)),
        runs_to_minimize_(runs_to_minimize),
        runs_to_explain_(runs_to_explain),
        command_(std::move(command)) {}

  std::string name() const override { return name_; }
  TargetTraits traits() const override {
    constexpr std::uint64_t events_max = 30'000'000;  // some seconds
    return {.to_minimize = {runs_to_minimize_, events_max},
            .to_explain = {runs_to_explain_, events_max},
            .is_cheap = true,
            .default_fails_too =
                "the default order, which passed at first, now fails: the body leaks state from one "
                "schedule into the next\n"};
  }
  std::string replay_command(const Finding&, const std::string& token) const override {
    return "WAITPOINT_REPLAY=" + token + " " + command_;
  }
  std::optional<Finding> repeat(const Plan& plan, const WantedEvidence& wanted) override {
    return body_.repeat(plan, wanted);
  }

 private:
  Body& body_;
  std::string name_;
  std::uint64_t runs_to_minimize_, runs_to_explain_;
  std::string command_;
};

}  // namespace waitpoint::exploration
