// SPDX-License-Identifier: BSD-3-Clause
// Packets as bytes, letters in them, and the objects that they refer to.
#include "fibers/io/packet.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "fibers/io/letter.hpp"
#include "fibers/io/network.hpp"
#include "fibers/sync/thread.hpp"
#include "tests/fibers/io/bytes.hpp"
#include "tests/fibers/io/fleet.hpp"

namespace waitpoint::io {
namespace {

using namespace std::chrono_literals;

TEST(Packet, IsTheSameAfterItsWayAsBytes) {
  const auto letters = bytes_of("the letters");
  const Packet packet{.kind = PacketKind::letter,
                      .from = {.socket = 7},
                      .to = {.port = "orders"},
                      .number = 0x0123456789ABCDEF,
                      .bytes = {letters.begin(), letters.end()}};
  EXPECT_EQ(packet_of(to_bytes(packet)), packet);
  const Packet datagram{.from = {.port = "out", .socket = ~std::uint64_t{0}}, .to = {.port = "a much longer name"}};
  EXPECT_EQ(packet_of(to_bytes(datagram)), datagram);
  EXPECT_NE(to_bytes(datagram), to_bytes(packet));
}

TEST(PacketDeathTest, OtherBytesAreABug) {
  std::vector<std::byte> bytes = to_bytes({.to = {.port = "name"}});
  bytes.pop_back();
  EXPECT_DEATH((void)packet_of(bytes), "an encoding ends too early");
  bytes[0] = std::byte{200};
  EXPECT_DEATH((void)packet_of(bytes), "of no known kind");
  EXPECT_DEATH((void)to_bytes({.kind = PacketKind::parcel}), "a parcel leaves its process");
}

enum class Gait : std::uint16_t { walk, run };

struct Part {
  std::uint8_t number = 0;
  bool is_last = false;
  static void fields(auto field) {
    field("number", &Part::number);
    field("is_last", &Part::is_last);
  }
};

struct Plan {
  Time date;
  Duration span;
  Gait gait = Gait::walk;
  std::array<float, 2> speeds{};
  Bounded<Part, 3> parts;
  Pose goal;
  Point base;
  int undeclared = 0;
  static void fields(auto field) {
    field("date", &Plan::date);
    field("span", &Plan::span);
    field("gait", &Plan::gait);
    field("speeds", &Plan::speeds);
    field("parts", &Plan::parts);
    field("goal", &Plan::goal);
    field("base", &Plan::base, added);
  }
};

TEST(Letter, ArrivesWithItsDeclaredFields) {
  Plan plan;
  plan.date = at(3ms);
  plan.span = Duration(7ns);
  plan.gait = Gait::run;
  plan.speeds = {0.5f, std::numbers::pi_v<float>};
  plan.parts.push_back({1, false});
  plan.parts.push_back({2, true});
  plan.goal = {1, -0.0, 3};
  plan.base = {4, 5};
  plan.undeclared = 6;
  const std::vector<std::byte> letter = encoded(plan);
  EXPECT_EQ(letter.size(), wire_bytes(plan));
  Plan arrived;
  std::span<const std::byte> rest(letter);
  decode(arrived, rest);
  EXPECT_TRUE(rest.empty());
  EXPECT_EQ(hash_of(arrived), hash_of(plan));
  EXPECT_EQ(arrived.speeds, plan.speeds);
  EXPECT_EQ(arrived.base, plan.base);
  EXPECT_EQ(arrived.undeclared, 0);
  EXPECT_EQ(encoded(std::uint32_t{0x01020304}), (std::vector{std::byte{4}, std::byte{3}, std::byte{2}, std::byte{1}}))
      << "in little-endian order";
}

struct Same {
  std::uint8_t number = 0;
  bool is_last = true;
  static void fields(auto field) {
    field("number", &Same::number);
    field("is_last", &Same::is_last);
  }
};

struct OtherName {
  std::uint8_t count = 0;
  bool is_last = false;
  static void fields(auto field) {
    field("count", &OtherName::count);
    field("is_last", &OtherName::is_last);
  }
};

struct OtherType {
  std::uint8_t number = 0;
  std::uint8_t is_last = 0;
  static void fields(auto field) {
    field("number", &OtherType::number);
    field("is_last", &OtherType::is_last);
  }
};

TEST(Letter, HasATypeOfItsFieldsNamesAndTypes) {
  EXPECT_EQ(letter_type<Same>(), letter_type<Part>());
  const std::set<std::uint64_t> types = {
      letter_type<Part>(),          letter_type<OtherName>(), letter_type<OtherType>(),
      letter_type<std::int32_t>(),  letter_type<float>(),     letter_type<double>(),
      letter_type<std::uint32_t>(), letter_type<Gait>(),      letter_type<Plan>()};
  EXPECT_EQ(types.size(), 9u);
}

// Three objects are sent from ada to bob: one is lost, one arrives, one is under way when the network goes.
TEST(Parcels, AreDroppedAfterTheirArrivalAtALossAndAtTheEnd) {
  struct Object {
    int arrived = 0, dropped = 0;
  };
  std::array<Object, 3> objects;
  {
    Fleet fleet({"ada", "bob"}, {.latency_least = 2ms, .latency_most = 2ms, .range_m = 10});
    double distance_m = 0;
    fleet.network.set_distance([&](auto&, auto&) { return distance_m; });
    Parcels& parcels = fleet.network.parcels();
    const auto send = [&](Object& object) {
      const Packet packet{.kind = PacketKind::parcel,
                          .number = parcels.keep(
                              &object, [](void* it) { ++static_cast<Object*>(it)->arrived; },
                              [](void* it) { ++static_cast<Object*>(it)->dropped; })};
      if (!fleet.network.node("ada")->link_to("bob")->send_datagram(1, packet)) parcels.drop(packet.number);
    };
    fleet.spawn("ada", [&] {
      distance_m = 11;
      send(objects[0]);
      EXPECT_EQ(objects[0].dropped, 1) << "at once";
      distance_m = 9;
      send(objects[1]);
      this_thread::sleep_for(1ms);
      EXPECT_EQ(objects[1].arrived, 0);
      this_thread::sleep_for(2ms);
      EXPECT_EQ(objects[1].arrived, 1);
      EXPECT_EQ(objects[1].dropped, 1);
      send(objects[2]);
    });
    fleet.run();
    EXPECT_EQ(objects[2].dropped, 0);
  }
  EXPECT_EQ(objects[0].arrived, 0);
  EXPECT_EQ(objects[2].arrived, 0);
  for (const Object& object : objects) EXPECT_EQ(object.dropped, 1);
}

}  // namespace
}  // namespace waitpoint::io
