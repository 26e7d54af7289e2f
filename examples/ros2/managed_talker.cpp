// SPDX-License-Identifier: BSD-3-Clause
// A node with a life cycle: it speaks ten times a second while it is active, and ends once it is finalized.
#include <chrono>
#include <lifecycle_msgs/msg/state.hpp>
#include <rclcpp/rclcpp.hpp>
#include <rclcpp_lifecycle/lifecycle_node.hpp>
#include <rclcpp_lifecycle/lifecycle_publisher.hpp>
#include <std_msgs/msg/string.hpp>

namespace {

using Result = rclcpp_lifecycle::node_interfaces::LifecycleNodeInterface::CallbackReturn;
using rclcpp_lifecycle::State;

class ManagedTalker : public rclcpp_lifecycle::LifecycleNode {
 public:
  ManagedTalker() : LifecycleNode("managed_talker") {}

  Result on_configure(const State&) override {
    publisher_ = create_publisher<std_msgs::msg::String>("chatter", 10);
    timer_ = create_wall_timer(std::chrono::milliseconds(100), [this] { speak(); });
    return Result::SUCCESS;
  }
  Result on_activate(const State& state) override {
    LifecycleNode::on_activate(state);
    return Result::SUCCESS;
  }
  Result on_deactivate(const State& state) override {
    LifecycleNode::on_deactivate(state);
    return Result::SUCCESS;
  }
  Result on_cleanup(const State&) override {
    timer_.reset();
    publisher_.reset();
    return Result::SUCCESS;
  }
  Result on_shutdown(const State&) override {
    // After the reply to whoever asked.
    timer_ = create_wall_timer(std::chrono::seconds(1), [] { rclcpp::shutdown(); });
    return Result::SUCCESS;
  }

 private:
  void speak() {
    if (!publisher_->is_activated()) return;
    std_msgs::msg::String text;
    text.data = "managed sentence " + std::to_string(said_++);
    publisher_->publish(text);
  }

  int said_ = 0;
  rclcpp_lifecycle::LifecyclePublisher<std_msgs::msg::String>::SharedPtr publisher_;
  rclcpp::TimerBase::SharedPtr timer_;
};

}  // namespace

int main(int argc, char** argv) {
  rclcpp::init(argc, argv);
  rclcpp::spin(std::make_shared<ManagedTalker>()->get_node_base_interface());
  rclcpp::shutdown();
}
