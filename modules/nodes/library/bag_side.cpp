// SPDX-License-Identifier: BSD-3-Clause
#include "modules/nodes/bag_side.hpp"

#include <ros/callback_queue.h>
#include <ros/ros.h>

#include <chrono>
#include <exception>
#include <map>
#include <memory>
#include <stdexcept>
#include <thread>

#include "modules/messages/roscpp_traits.hpp"
#include "modules/messages/rosgraph_msgs.hpp"
#include "modules/messages/wire.hpp"
#include "modules/nodes/library/heard_topics.hpp"
#include "modules/nodes/library/node_with_master.hpp"
#include "modules/nodes/library/played_bag.hpp"
#include "modules/nodes/library/sides.hpp"

namespace waitpoint::nodes {
namespace {

using messages::rosgraph_msgs::Clock;

const messages::Ros1Type& clock_type() { return messages::ros1_type<Clock>(); }

constexpr std::uint32_t any_number = 0;  // of messages in a queue: none is lost on this side

/// Opens the bag so that the run does not depend on the time that it takes. The library looks through all packages of
/// the machine for ways to decrypt, with clocks and locks for each. So it is done by a thread of its own, whose events
/// are not counted among those of others, and the run begins at a whole second.
std::unique_ptr<PlayedBag> opened(const BagChoice& choice) {
  std::unique_ptr<PlayedBag> bag;
  std::exception_ptr failure;
  std::thread([&] {
    try {
      bag = std::make_unique<PlayedBag>(choice);
    } catch (...) {
      failure = std::current_exception();
    }
  }).join();
  if (failure) std::rethrow_exception(failure);
  using Clock = std::chrono::steady_clock;
  std::this_thread::sleep_until(std::chrono::ceil<std::chrono::seconds>(Clock::now()));
  return bag;
}

class BagAndMaster final : public NodeWithMaster<BagSide> {
 public:
  explicit BagAndMaster(const BagSideSetup& setup) : hears_(setup.hears), bag_(opened(setup.choice)) {
    open_node(setup.has_debian_master, setup.has_clock, setup.parameters);
    if (setup.has_clock) {
      ros::AdvertiseOptions options("/clock", any_number, clock_type().md5, clock_type().name, clock_type().definition);
      clock_ = node_->advertise(options);
    }
    // A bag may have its own clock, which is that of the run.
    for (const rosbag::ConnectionInfo* connection : bag_->connections())
      if (!setup.has_clock || topic_of(connection->topic) != "/clock") advertise(*connection);
    first_ = begin_of_clock();
  }
  ~BagAndMaster() override {
    heard_.reset();
    publishers_.clear();
    clock_ = {};
    close_node();
  }
  BagAndMaster(const BagAndMaster&) = delete;
  BagAndMaster& operator=(const BagAndMaster&) = delete;

  std::optional<std::int64_t> next_ns() override {
    const rosbag::MessageInstance* const message = bag_->next();
    return message == nullptr ? std::nullopt : std::optional<std::int64_t>(bag_->time_ns(*message));
  }

  void play_next() override {
    publish(*bag_->next());
    bag_->advance();
  }

  void play_latched() override {
    for (const rosbag::MessageInstance& message : bag_->latched_before()) publish(message);
  }

  void show_clock(std::int64_t time_ns) override {
    const ros::Time now = first_ + ros::Duration().fromNSec(time_ns);
    const std::string bytes = messages::encode<messages::Wire::ros1>(Clock{{now.sec, now.nsec}});
    clock_.publish(messages::SerializedMessage{&clock_type(), bytes});
  }

  std::vector<HeardMessage> hear() override {
    if (!hears_) return {};
    if (!heard_) heard_.emplace(*node_);
    for (const std::string& topic : master_->topics_not_only_of(own_name)) heard_->subscribe(topic);
    ros::getGlobalCallbackQueue()->callAvailable();
    return heard_->take();
  }

  std::vector<TopicCount> played() const override {
    std::vector<TopicCount> all;
    for (const auto& [topic, messages] : played_) all.push_back({topic, messages});
    return all;
  }

 private:
  using Key = std::pair<std::string, std::string>;  // the publisher in the recording, and the topic

  static Key key_of(const ros::M_string& header, const std::string& topic) {
    const auto caller = header.find("callerid");
    return {caller == header.end() ? std::string() : caller->second, topic};
  }

  ros::Time begin_of_clock() {
    return bag_->next()->getTime() - ros::Duration().fromNSec(bag_->time_ns(*bag_->next()));
  }

  // One publisher for each of the recording, since each has a last message of its own.
  void advertise(const rosbag::ConnectionInfo& connection) {
    const std::string topic = topic_of(connection.topic);
    ros::Publisher& publisher = publishers_[key_of(*connection.header, topic)];
    if (publisher) return;
    ros::AdvertiseOptions options(topic, any_number, connection.md5sum, connection.datatype, connection.msg_def);
    const auto latching = connection.header->find("latching");
    options.latch = latching != connection.header->end() && latching->second == "1";
    publisher = node_->advertise(options);
    played_[topic] = 0;
  }

  void publish(const rosbag::MessageInstance& message) {
    const std::string topic = topic_of(message.getTopic());
    const auto publisher = publishers_.find(key_of(*message.getConnectionHeader(), topic));
    if (publisher == publishers_.end()) return;
    publisher->second.publish(message);
    ++played_[topic];
  }

  bool hears_;
  std::unique_ptr<PlayedBag> bag_;
  ros::Publisher clock_;
  ros::Time first_;  // the time of the bag where the played part begins
  std::map<Key, ros::Publisher> publishers_;
  std::map<std::string, std::uint64_t> played_;
  std::optional<HeardTopics> heard_;
};

}  // namespace

std::unique_ptr<BagSide> make_bag_side(const BagSideSetup& setup) { return std::make_unique<BagAndMaster>(setup); }

}  // namespace waitpoint::nodes
