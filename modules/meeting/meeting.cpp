// SPDX-License-Identifier: BSD-3-Clause
#include "modules/meeting/meeting.hpp"

#include <algorithm>
#include <string>

namespace waitpoint::meeting {

using genom::State;
using posters::Meeting;
using namespace std::chrono_literals;

MeetingModule::MeetingModule(genom::ModuleSetup& setup)
    : Module(setup, 27),
      network_(setup.network),
      task_(add_task("meeting", {.period_ms = 10ms, .delay_ms = {}, .cost_us = {}})) {
  if (network_ == nullptr) throw BadInput("module 'meeting'", "expected a simulated medium between the robots");
  task_.set_start([this] { letters_.bind(*network_, "meeting"); });
  add_activity<Meeting>(
      "Meet", task_,
      {.start =
           [this](auto& activity) {
             tell(activity.input);
             return State::exec;
           },
       .exec = [this](auto& activity) { return has_come(activity.input) ? State::ether : State::exec; }});
}

void MeetingModule::tell(const Meeting& with) {
  io::mailbox_sender<Meeting> sender(*network_, std::string(with.robot.text()) + ":meeting");
  Meeting letter;
  letter.robot = posters::ShortName(network_->own_node()->name());
  letter.name = with.name;
  sender.try_send(letter);
}

bool MeetingModule::has_come(const Meeting& with) {
  for (io::Result<Meeting> letter = letters_.try_receive(); letter; letter = letters_.try_receive())
    come_.push_back(*letter);
  const auto found = std::find_if(come_.begin(), come_.end(), [&](const Meeting& each) {
    return each.robot.text() == with.robot.text() && each.name.text() == with.name.text();
  });
  if (found == come_.end()) return false;
  come_.erase(found);
  return true;
}

}  // namespace waitpoint::meeting
