// SPDX-License-Identifier: BSD-3-Clause
#include "modules/nodes/library/topic_watch.hpp"

#include <ros/serialization.h>

#include <cstdio>
#include <utility>

namespace waitpoint::nodes {
namespace {

constexpr std::uint32_t queue = 100;

std::string text_of(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", value);
  return text;
}

// A number that is none is within no bound.
bool holds(double value, const TopicBound& bound) {
  switch (bound.relation) {
    case TopicBound::Relation::at_least: return value >= bound.limit;
    case TopicBound::Relation::at_most: return value <= bound.limit;
    case TopicBound::Relation::equal: return value == bound.limit;
  }
  return false;
}

}  // namespace

TopicWatch::TopicWatch(ros::NodeHandle& node, const std::vector<TopicBound>& bounds) {
  for (const TopicBound& bound : bounds) {
    Watched& watched = *all_.emplace_back(std::make_unique<Watched>(Watched{bound}));
    const boost::function<void(const topic_tools::ShapeShifter::ConstPtr&)> taken =
        [this, &watched](const topic_tools::ShapeShifter::ConstPtr& message) { take(watched, *message); };
    watched.subscriber = node.subscribe<topic_tools::ShapeShifter>(bound.topic, queue, taken);
  }
}

void TopicWatch::take(Watched& watched, const topic_tools::ShapeShifter& message) {
  if (watched.is_broken) return;
  if (!watched.layout || watched.type != message.getMD5Sum()) {
    watched.layout.emplace(message.getMessageDefinition());
    watched.type = message.getMD5Sum();
  }
  std::vector<std::uint8_t> bytes(message.size());
  ros::serialization::OStream stream(bytes.data(), message.size());
  message.write(stream);
  const std::optional<double> value = watched.layout->value(bytes, watched.bound.field);
  if (!value)
    note(watched, "has no number '" + watched.bound.field + "' (" + message.getDataType() + ")");
  else if (!holds(*value, watched.bound))
    note(watched, "is " + text_of(*value));
}

void TopicWatch::note(Watched& watched, const std::string& found) {
  watched.is_broken = true;
  breaches_.push_back("topic " + watched.bound.topic + " " + found + ", expected " + watched.bound.text);
}

std::vector<std::string> TopicWatch::unheard() const {
  std::vector<std::string> topics;
  for (const std::unique_ptr<Watched>& watched : all_)
    if (!watched->layout) topics.push_back(watched->bound.topic);
  return topics;
}

std::vector<std::string> TopicWatch::take_breaches() { return std::exchange(breaches_, {}); }

}  // namespace waitpoint::nodes
