// SPDX-License-Identifier: BSD-3-Clause
// A node that prints what talkers say, with the time, by an executor with two threads. It ends three seconds after the
// last sentence.
#include <chrono>
#include <cstdio>
#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/string.hpp>

namespace {

class Listener : public rclcpp::Node {
 public:
  Listener() : Node("listener"), last_(now()), start_(last_) {
    subscription_ =
        create_subscription<std_msgs::msg::String>("chatter", 10, [this](std_msgs::msg::String::ConstSharedPtr text) {
          last_ = now();
          std::printf("%.6f %s\n", (last_ - start_).seconds(), text->data.c_str());
        });
    timer_ = create_wall_timer(std::chrono::seconds(1), [this] {
      if ((now() - last_).seconds() > 3) rclcpp::shutdown();
    });
  }

 private:
  rclcpp::Time last_, start_;
  rclcpp::Subscription<std_msgs::msg::String>::SharedPtr subscription_;
  rclcpp::TimerBase::SharedPtr timer_;
};

}  // namespace

int main(int argc, char** argv) {
  rclcpp::init(argc, argv);
  rclcpp::executors::MultiThreadedExecutor executor(rclcpp::ExecutorOptions(), 2);
  const auto node = std::make_shared<Listener>();
  executor.add_node(node);
  executor.spin();
  rclcpp::shutdown();
}
