// SPDX-License-Identifier: BSD-3-Clause
// A layer's state of one robot of one run: made at first access, destroyed with the simulation, after its tasks. So no
// state of a run is left in static variables, and robots share none.
//
//   struct Names : sync::RobotState { explicit Names(kernel::Robot&); ... };
//   sync::state_of<Names>(*sync::running_task().robot)
#pragma once

#include <memory>
#include <vector>

#include "fibers/kernel/task.hpp"

namespace waitpoint::sync {

struct RobotState {
  RobotState() = default;
  RobotState(const RobotState&) = delete;
  RobotState& operator=(const RobotState&) = delete;
  virtual ~RobotState() = default;
};

/// All layers' states of one robot, in order of construction: Robot::client.
struct RobotStates {
  struct Entry {
    const void* kind;
    std::unique_ptr<RobotState> state;
  };
  std::vector<Entry> entries;  // few: searched linearly

  RobotStates() = default;
  RobotStates(const RobotStates&) = delete;
  RobotStates& operator=(const RobotStates&) = delete;
  ~RobotStates() {
    while (!entries.empty()) entries.pop_back();
  }
};

/// Its address identifies the type of a state.
template <class State>
inline constexpr char state_kind = 0;

/// The robot's state of this type, constructed from the robot's record at the first call.
template <class State>
State& state_of(kernel::Robot& robot) {
  RobotStates& states = *static_cast<RobotStates*>(robot.client);
  for (const RobotStates::Entry& entry : states.entries)
    if (entry.kind == &state_kind<State>) return static_cast<State&>(*entry.state);
  auto made = std::make_unique<State>(robot);
  State& state = *made;
  states.entries.push_back({&state_kind<State>, std::move(made)});
  return state;
}

}  // namespace waitpoint::sync
