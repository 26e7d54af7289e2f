// SPDX-License-Identifier: BSD-3-Clause
#include "modules/nodes/node_side.hpp"

#include <ros/callback_queue.h>
#include <ros/ros.h>

#include <optional>

#include "modules/messages/roscpp_traits.hpp"
#include "modules/nodes/library/node_with_master.hpp"
#include "modules/nodes/library/sides.hpp"
#include "modules/nodes/library/topic_watch.hpp"

namespace waitpoint::nodes {
namespace {

using messages::ReceivedMessage;
using messages::Ros1Type;
using messages::SerializedMessage;

class WorldAndMaster final : public NodeWithMaster<NodeSide> {
 public:
  explicit WorldAndMaster(const NodeSideSetup& setup) {
    open_node(setup.has_debian_master, setup.has_clock, setup.parameters);
    const ros::WallTime now = ros::WallTime::now();
    // With a clock from 1 s on: roscpp takes 0 for a clock that has not begun.
    begin_ = setup.has_clock ? messages::time_of({1, 0}) : messages::time_of({now.sec, now.nsec});
  }
  ~WorldAndMaster() override {
    watch_.reset();
    topics_.clear();
    subscribers_.clear();
    services_.clear();
    close_node();
  }
  WorldAndMaster(const WorldAndMaster&) = delete;
  WorldAndMaster& operator=(const WorldAndMaster&) = delete;

  Time begin() const override { return begin_; }

  Topic advertise(const std::string& name, const Ros1Type& type, std::uint32_t queue, bool is_latched) override {
    ros::AdvertiseOptions options(name, queue, type.md5, type.name, type.definition);
    options.latch = is_latched;
    // roscpp counts the messages in their headers.
    options.has_header = type.definition.starts_with("std_msgs/Header ");
    topics_.push_back({node_->advertise(options), &type});
    return topics_.size() - 1;
  }

  void publish(Topic topic, std::string_view bytes) override {
    topics_[topic].publisher.publish(SerializedMessage{topics_[topic].type, bytes});
  }
  bool has_subscribers(Topic topic) const override { return topics_[topic].publisher.getNumSubscribers() > 0; }

  Subscription subscribe(const std::string& name, const Ros1Type& type, std::uint32_t queue) override {
    const Subscription number = subscribers_.size();
    ros::SubscribeOptions options;
    options.init<ReceivedMessage>(name, queue, [this, number](const boost::shared_ptr<const ReceivedMessage>& message) {
      received_.push_back({number, message->bytes});
    });
    options.md5sum = type.md5;
    options.datatype = type.name;
    subscribers_.push_back(node_->subscribe(options));
    return number;
  }

  std::vector<Received> take_received() override {
    ros::getGlobalCallbackQueue()->callAvailable();
    return std::exchange(received_, {});
  }

  void serve(const std::string& name, const std::string& service_type, const Ros1Type& type,
             std::string response) override {
    using Spec = ros::ServiceSpec<ReceivedMessage, SerializedMessage>;
    const Spec::CallbackType give = [&type, response = std::move(response)](ReceivedMessage&,
                                                                            SerializedMessage& given) {
      given = {&type, response};
      return true;
    };
    ros::AdvertiseServiceOptions options;
    options.service = name;
    options.md5sum = type.md5;  // that of an empty request and this response
    options.datatype = service_type;
    options.req_datatype = service_type + "Request";
    options.res_datatype = type.name;
    options.helper = boost::make_shared<ros::ServiceCallbackHelperT<Spec>>(give);
    services_.push_back(node_->advertiseService(options));
  }

  void watch(const std::vector<TopicBound>& bounds) override { watch_.emplace(*node_, bounds); }
  std::vector<std::string> take_breaches() override { return watch_->take_breaches(); }
  std::vector<std::string> unheard_topics() const override { return watch_->unheard(); }

 private:
  struct Advertised {
    ros::Publisher publisher;
    const Ros1Type* type;
  };

  Time begin_;
  std::vector<Advertised> topics_;
  std::vector<ros::Subscriber> subscribers_;
  std::vector<ros::ServiceServer> services_;
  std::vector<Received> received_;
  std::optional<TopicWatch> watch_;
};

}  // namespace

std::unique_ptr<NodeSide> make_node_side(const NodeSideSetup& setup) { return std::make_unique<WorldAndMaster>(setup); }

}  // namespace waitpoint::nodes
