// SPDX-License-Identifier: BSD-3-Clause
#include "modules/nodes/library/registrations.hpp"

#include <gtest/gtest.h>

namespace waitpoint::nodes {
namespace {

using Addresses = std::vector<std::string>;

constexpr const char *talker = "/talker", *listener = "/listener", *topic = "/numbers", *type = "std_msgs/String";
constexpr const char *at_talker = "http://127.0.0.1:1/", *at_listener = "http://127.0.0.1:2/";

TEST(Registrations, IntroduceAPublisherToSubscribersInBothOrders) {
  Registrations early;
  EXPECT_EQ(early.publish(talker, topic, type, at_talker), Addresses{});
  EXPECT_EQ(early.subscribe(listener, topic, type, at_listener), Addresses{at_talker});
  EXPECT_FALSE(early.take_notification());

  Registrations late;
  EXPECT_EQ(late.subscribe(listener, topic, type, at_listener), Addresses{});
  EXPECT_EQ(late.publish(talker, topic, type, at_talker), Addresses{at_listener});
  const auto news = late.take_notification();
  ASSERT_TRUE(news);
  EXPECT_EQ(news->address, at_listener);
  EXPECT_EQ(news->topic, topic);
  EXPECT_EQ(news->publishers, Addresses{at_talker});
}

TEST(Registrations, TellSubscribersOfAPublisherThatStops) {
  Registrations registrations;
  registrations.publish(talker, topic, type, at_talker);
  registrations.subscribe(listener, topic, type, at_listener);
  EXPECT_FALSE(registrations.stop_publishing(talker, topic, at_listener)) << "of another address";
  EXPECT_TRUE(registrations.stop_publishing(talker, topic, at_talker));
  const auto news = registrations.take_notification();
  ASSERT_TRUE(news);
  EXPECT_EQ(news->publishers, Addresses{});
  EXPECT_FALSE(registrations.is_published(topic));
  EXPECT_FALSE(registrations.node_address(talker)) << "a node without registrations is not known";
}

TEST(Registrations, LetANodeTakeTheNameOfAnother) {
  Registrations registrations;
  registrations.publish(talker, topic, type, at_talker);
  registrations.serve(talker, "/count", "rosrpc://127.0.0.1:3", at_talker);
  registrations.publish(talker, "/letters", type, at_listener);
  const auto news = registrations.take_notification();
  ASSERT_TRUE(news);
  EXPECT_EQ(news->kind, Notification::Kind::shutdown);
  EXPECT_EQ(news->address, at_talker);
  EXPECT_FALSE(registrations.is_published(topic)) << "what the first one published has gone with it";
  EXPECT_FALSE(registrations.service_address("/count"));
  EXPECT_EQ(registrations.node_address(talker), at_listener);
}

TEST(Registrations, KeepTheTypeThatAPublisherGives) {
  Registrations registrations;
  registrations.subscribe(listener, topic, "*", at_listener);
  registrations.publish(talker, topic, type, at_talker);
  const std::vector<std::pair<std::string, std::string>> expected = {{topic, type}};
  EXPECT_EQ(registrations.published("/"), expected);
  EXPECT_EQ(registrations.published("/numbers/of"), decltype(expected)());
}

TEST(Registrations, GiveAServiceToItsLastServer) {
  Registrations registrations;
  registrations.serve(talker, "/count", "rosrpc://127.0.0.1:3", at_talker);
  registrations.serve(listener, "/count", "rosrpc://127.0.0.1:4", at_listener);
  EXPECT_EQ(registrations.service_address("/count"), "rosrpc://127.0.0.1:4");
  EXPECT_FALSE(registrations.stop_serving(talker, "/count", "rosrpc://127.0.0.1:3"));
  EXPECT_TRUE(registrations.stop_serving(listener, "/count", "rosrpc://127.0.0.1:4"));
}

}  // namespace
}  // namespace waitpoint::nodes
