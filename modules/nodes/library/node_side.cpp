// SPDX-License-Identifier: BSD-3-Clause
#include "modules/nodes/node_side.hpp"

#include <nav_msgs/GetMap.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <rosgraph_msgs/Clock.h>
#include <tf2_msgs/TFMessage.h>

#include "modules/nodes/library/messages.hpp"
#include "modules/nodes/library/node_with_master.hpp"
#include "modules/nodes/library/robot_node.hpp"
#include "modules/nodes/library/shown_subscriptions.hpp"
#include "modules/nodes/library/sides.hpp"
#include "modules/nodes/library/topic_watch.hpp"

namespace waitpoint::nodes {
namespace {

constexpr std::uint32_t queue = 100;
constexpr bool latched = true;

class WorldAndMaster final : public NodeWithMaster<NodeSide> {
 public:
  explicit WorldAndMaster(const NodeSideSetup& setup) : has_clock_(setup.has_clock) {
    open_node(setup.has_debian_master, setup.has_clock, setup.parameters);
    const ros::WallTime now = ros::WallTime::now();
    begin_ = has_clock_ ? ros::Time(1, 0) : ros::Time(now.sec, now.nsec);
    advertise(setup);
    watch_.emplace(*node_, setup.bounds);
  }
  ~WorldAndMaster() override {
    watch_.reset();
    robots_.clear();
    shown_.clear();
    map_server_ = {};
    close_node();
  }
  WorldAndMaster(const WorldAndMaster&) = delete;
  WorldAndMaster& operator=(const WorldAndMaster&) = delete;

  void publish(std::int64_t now_ns, const std::vector<RobotReadings>& robots) override {
    stamp_ = begin_ + ros::Duration().fromNSec(now_ns);
    if (has_clock_) {
      rosgraph_msgs::Clock clock;
      clock.clock = stamp_;
      clock_.publish(clock);
    }
    tf2_msgs::TFMessage tf;
    for (std::size_t i = 0; i < robots_.size(); ++i) robots_[i]->publish(now_ns, stamp_, robots[i], tf);
    if (!tf.transforms.empty()) tf_.publish(tf);
  }

  bool has_driver(std::size_t robot) const override { return robots_[robot]->has_driver(); }
  void send_goal(std::size_t robot, const Place& goal) override { robots_[robot]->send_goal(stamp_, goal); }

  std::vector<std::optional<Command>> take_commands() override {
    ros::getGlobalCallbackQueue()->callAvailable();
    std::vector<std::optional<Command>> commands;
    commands.reserve(robots_.size());
    for (const auto& robot : robots_) commands.push_back(robot->take_command());
    return commands;
  }

  std::vector<std::optional<PublishedPose>> take_poses() override {
    std::vector<std::optional<PublishedPose>> poses;
    poses.reserve(robots_.size());
    for (const auto& robot : robots_) poses.push_back(robot->take_pose(begin_));
    return poses;
  }
  std::vector<std::string> take_breaches() override { return watch_->take_breaches(); }
  std::vector<std::string> unheard_topics() const override { return watch_->unheard(); }

  std::vector<ShownReading> take_shown(std::size_t robot) override { return shown_[robot]->take(begin_); }

 private:
  void advertise(const NodeSideSetup& setup) {
    if (has_clock_) clock_ = node_->advertise<rosgraph_msgs::Clock>("/clock", queue);
    tf_ = node_->advertise<tf2_msgs::TFMessage>("/tf", queue);
    fixed_ = node_->advertise<tf2_msgs::TFMessage>("/tf_static", queue, latched);
    map_ = node_->advertise<nav_msgs::OccupancyGrid>("/map", 1, latched);
    const nav_msgs::OccupancyGrid map = grid(begin_, "map", setup.map);
    map_.publish(map);
    using Request = nav_msgs::GetMap::Request;
    using Response = nav_msgs::GetMap::Response;
    const boost::function<bool(Request&, Response&)> give_map = [map](Request&, Response& response) {
      response.map = map;
      return true;
    };
    map_server_ = node_->advertiseService("/static_map", give_map);
    tf2_msgs::TFMessage fixed;
    for (const RobotTopics& topics : setup.robots) {
      robots_.push_back(std::make_unique<RobotNode>(topics));
      shown_.push_back(std::make_unique<ShownSubscriptions>(topics));
      robots_.back()->add_fixed(begin_, fixed);
      robots_.back()->send_start(begin_);
    }
    fixed_.publish(fixed);
  }

  bool has_clock_;
  ros::Time begin_, stamp_;  // of the run's beginning; of the last step
  ros::Publisher clock_, tf_, fixed_, map_;
  ros::ServiceServer map_server_;
  std::vector<std::unique_ptr<RobotNode>> robots_;
  std::optional<TopicWatch> watch_;
  std::vector<std::unique_ptr<ShownSubscriptions>> shown_;  // by robot
};

}  // namespace

std::unique_ptr<NodeSide> make_node_side(const NodeSideSetup& setup) { return std::make_unique<WorldAndMaster>(setup); }

}  // namespace waitpoint::nodes
