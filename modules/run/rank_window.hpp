// SPDX-License-Identifier: BSD-3-Clause
// A rank's message to the others at the end of each window of virtual time.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/time.hpp"
#include "modules/bridge/body_command.hpp"
#include "modules/run/operator.hpp"

namespace waitpoint::run {

/// Why a rank's run cannot go on.
struct Failure {
  enum class Kind : std::uint8_t { none, deadlock, no_progress, exception };

  Kind kind = Kind::none;
  std::string text;
};

struct GoalCounts {
  std::uint32_t robot = 0;
  std::uint64_t goals = 0, reached = 0;

  friend bool operator==(const GoalCounts&, const GoalCounts&) = default;
};

/// A packet between robots on different ranks: the arguments of io::Forward.
struct Message {
  std::string sender, to;
  std::uint64_t count = 0;
  Time arrives;
  std::string packet;  ///< io::to_bytes
};

/// The number that a robot's semaphore "world step" has among its objects.
struct StepNumber {
  std::uint32_t robot = 0, number = 0;
};

struct Window {
  Failure failure;
  std::uint32_t live_tasks = 0;               ///< that are not services
  std::optional<Time> last_end;               ///< of such a task, so far
  std::uint64_t environment = 0, bodies = 0;  ///< digests, which must be equal on all ranks
  std::vector<bridge::BodyCommand> commands;  ///< given in this window
  std::vector<GoalCounts> goals;              ///< those that changed
  std::vector<InterventionOutcome> replies;   ///< to requests
  std::vector<Message> messages;              ///< sent in this window
  std::vector<StepNumber> steps;              ///< in the first window
};

void carry(auto& archive, bridge::BodyCommand& command) {
  world::Velocity& velocity = command.velocity;
  archive(command.body, velocity.v_m_s, velocity.w_rad_s, velocity.side_m_s, velocity.climb_m_s);
}
void carry(auto& archive, Failure& failure) { archive(failure.kind, failure.text); }
void carry(auto& archive, GoalCounts& counts) { archive(counts.robot, counts.goals, counts.reached); }
void carry(auto& archive, Message& message) {
  archive(message.sender, message.to, message.count, message.arrives, message.packet);
}
void carry(auto& archive, StepNumber& step) { archive(step.robot, step.number); }
void carry(auto& archive, InterventionOutcome& outcome) { archive(outcome.date, outcome.text); }
void carry(auto& archive, Window& window) {
  archive(window.failure, window.live_tasks, window.last_end, window.environment, window.bodies, window.commands,
          window.goals, window.replies, window.messages, window.steps);
}

}  // namespace waitpoint::run
