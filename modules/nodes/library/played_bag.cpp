// SPDX-License-Identifier: BSD-3-Clause
#include "modules/nodes/library/played_bag.hpp"

#include <console_bridge/console.h>
#include <rosbag/query.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <stdexcept>

namespace waitpoint::nodes {
namespace {

/// The library's exceptions of many kinds become one of ours.
template <class Read>
auto readable(Read read) {
  // Errors are in the exceptions.
  console_bridge::setLogLevel(console_bridge::CONSOLE_BRIDGE_LOG_NONE);
  try {
    return read();
  } catch (const rosbag::BagUnindexedException&) {
    throw std::runtime_error("has no index, as its recording was not closed: `rosbag reindex` makes one");
  } catch (const ros::Exception& failure) {
    throw std::runtime_error(std::string("is damaged: ") + failure.what());
  }
}

std::string joined(const std::vector<std::string>& all) {
  std::string text;
  for (const std::string& each : all) text += (text.empty() ? "" : ", ") + each;
  return text;
}

}  // namespace

std::string topic_of(const std::string& written) {
  return written.empty() || written[0] != '/' ? "/" + written : written;
}

PlayedBag::PlayedBag(const BagChoice& choice) {
  open(choice.file);
  readable([&] {
    rosbag::View all(bag_);
    if (all.size() == 0) throw std::runtime_error("expected a bag with messages, found none");
    bag_begin_ = all.getBeginTime();
    topics_ = written_topics(choice.topics);
    connections_ = rosbag::View(bag_, rosbag::TopicQuery(topics_)).getConnections();
    begin_ = bag_begin_ + ros::Duration().fromNSec(choice.start_ns);
    ros::Time end = ros::TIME_MAX;
    if (choice.duration_ns) end = begin_ + ros::Duration().fromNSec(*choice.duration_ns);
    view_ = std::make_unique<rosbag::View>(bag_, rosbag::TopicQuery(topics_), begin_, end);
    if (view_->size() == 0) throw std::runtime_error("has no message in the time that is to be played");
    check_types();
    at_ = view_->begin();
  });
}

void PlayedBag::open(const std::string& file) {
  constexpr std::string_view magic = "#ROSBAG V";
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw std::runtime_error("cannot be read");
  std::string first(magic.size(), '\0');
  stream.read(first.data(), static_cast<std::streamsize>(first.size()));
  if (!stream || first != magic) throw std::runtime_error("expected a bag of ROS 1, found something else");
  readable([&] { bag_.open(file, rosbag::bagmode::Read); });
}

std::vector<std::string> PlayedBag::written_topics(const std::vector<std::string>& wanted) {
  std::map<std::string, std::string> names;  // as written, by global name
  rosbag::View all(bag_);
  for (const rosbag::ConnectionInfo* connection : all.getConnections())
    names.emplace(topic_of(connection->topic), connection->topic);
  std::vector<std::string> known, chosen;
  for (const auto& [name, written] : names) {
    known.push_back(name);
    if (wanted.empty() || std::find(wanted.begin(), wanted.end(), name) != wanted.end()) chosen.push_back(written);
  }
  for (const std::string& name : wanted)
    if (names.find(name) == names.end()) throw std::runtime_error("has no topic '" + name + "', but " + joined(known));
  return chosen;
}

void PlayedBag::check_types() const {
  std::map<std::string, const rosbag::ConnectionInfo*> first;
  for (const rosbag::ConnectionInfo* connection : connections_) {
    const auto [other, is_new] = first.emplace(topic_of(connection->topic), connection);
    if (!is_new && other->second->md5sum != connection->md5sum)
      throw std::runtime_error("has two types of messages in " + other->first + ": " + other->second->datatype +
                               " and " + connection->datatype + ", which cannot be published together");
  }
}

void PlayedBag::read_through() {
  readable([&] {
    for (const rosbag::MessageInstance& message : *view_) (void)message.size();
  });
}

const rosbag::MessageInstance* PlayedBag::next() {
  if (at_ == view_->end()) return nullptr;
  return readable([&] { return &*at_; });
}

std::int64_t PlayedBag::time_ns(const rosbag::MessageInstance& message) const {
  return (message.getTime() - begin_).toNSec();
}

std::vector<rosbag::MessageInstance> PlayedBag::latched_before() {
  if (begin_ <= bag_begin_) return {};
  return readable([&] {
    // Views order by time.
    rosbag::View before(bag_, rosbag::TopicQuery(topics_), bag_begin_, begin_ - ros::Duration(0, 1));
    std::map<std::pair<std::string, std::string>, std::size_t> newest;  // of its publisher and topic, in `all`
    std::vector<rosbag::MessageInstance> all;
    for (const rosbag::MessageInstance& message : before) {
      if (!message.isLatching()) continue;
      newest[{message.getCallerId(), message.getTopic()}] = all.size();
      all.push_back(message);
    }
    std::vector<std::size_t> order;
    order.reserve(newest.size());
    for (const auto& [publisher, i] : newest) order.push_back(i);
    std::sort(order.begin(), order.end());
    std::vector<rosbag::MessageInstance> last;
    last.reserve(order.size());
    for (const std::size_t i : order) last.push_back(all[i]);
    return last;
  });
}

}  // namespace waitpoint::nodes
