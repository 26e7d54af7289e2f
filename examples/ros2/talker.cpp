// SPDX-License-Identifier: BSD-3-Clause
// A node that publishes a sentence ten times a second, and ends after NUMBER: talker NUMBER.
#include <chrono>
#include <cstdlib>
#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/string.hpp>

namespace {

class Talker : public rclcpp::Node {
 public:
  explicit Talker(int count) : Node("talker"), left_(count) {
    publisher_ = create_publisher<std_msgs::msg::String>("chatter", 10);
    timer_ = create_wall_timer(std::chrono::milliseconds(100), [this] { speak(); });
  }

 private:
  void speak() {
    std_msgs::msg::String text;
    text.data = "sentence " + std::to_string(said_++);
    publisher_->publish(text);
    if (--left_ == 0) rclcpp::shutdown();
  }

  int left_, said_ = 0;
  rclcpp::Publisher<std_msgs::msg::String>::SharedPtr publisher_;
  rclcpp::TimerBase::SharedPtr timer_;
};

}  // namespace

int main(int argc, char** argv) {
  rclcpp::init(argc, argv);
  rclcpp::spin(std::make_shared<Talker>(argc > 1 ? std::atoi(argv[1]) : 10));
  rclcpp::shutdown();
}
