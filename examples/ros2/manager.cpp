// SPDX-License-Identifier: BSD-3-Clause
// Leads the node managed_talker through its life: it is configured, active for a second, and shut down. Each step is a
// call of its service; the exit status is 1 if one is refused or not answered.
#include <chrono>
#include <cstdio>
#include <lifecycle_msgs/msg/transition.hpp>
#include <lifecycle_msgs/srv/change_state.hpp>
#include <rclcpp/rclcpp.hpp>
#include <thread>

using lifecycle_msgs::msg::Transition;
using lifecycle_msgs::srv::ChangeState;
using namespace std::chrono_literals;

int main(int argc, char** argv) {
  rclcpp::init(argc, argv);
  const auto node = std::make_shared<rclcpp::Node>("manager");
  const auto client = node->create_client<ChangeState>("managed_talker/change_state");
  if (!client->wait_for_service(10s)) return 1;
  for (const auto transition :
       {Transition::TRANSITION_CONFIGURE, Transition::TRANSITION_ACTIVATE, Transition::TRANSITION_DEACTIVATE,
        Transition::TRANSITION_CLEANUP, Transition::TRANSITION_UNCONFIGURED_SHUTDOWN}) {
    const auto request = std::make_shared<ChangeState::Request>();
    request->transition.id = transition;
    auto answer = client->async_send_request(request);
    if (rclcpp::spin_until_future_complete(node, answer, 5s) != rclcpp::FutureReturnCode::SUCCESS) return 1;
    const bool is_done = answer.get()->success;
    std::printf("transition %d: %s\n", transition, is_done ? "done" : "refused");
    if (!is_done) return 1;
    if (transition == Transition::TRANSITION_ACTIVATE) std::this_thread::sleep_for(1s);
  }
  rclcpp::shutdown();
}
