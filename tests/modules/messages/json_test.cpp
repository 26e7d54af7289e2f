// SPDX-License-Identifier: BSD-3-Clause
#include "modules/messages/json.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "modules/messages/description.hpp"
#include "modules/messages/foxglove.hpp"
#include "modules/messages/rosgraph_msgs.hpp"
#include "tests/modules/messages/random_message.hpp"

namespace waitpoint::messages {
namespace {

template <class M>
std::string error(const std::string& text) {
  try {
    decode_json<M>("a", text);
  } catch (const BadInput& error) {
    return error.what();
  }
  return "";
}

TEST(JsonMessage, HasItsFieldsInTheOrderOfTheDeclaration) {
  EXPECT_EQ(encode_json(foxglove::PoseInFrame{{1, 2}, "map", {{1, 2, 3}, {0, 0, 0, 1}}}),
            R"({"timestamp":{"sec":1,"nsec":2},"frame_id":"map","pose":{"position":{"x":1.0,"y":2.0,"z":3.0},)"
            R"("orientation":{"x":0.0,"y":0.0,"z":0.0,"w":1.0}}})");
  EXPECT_EQ(json_schema(description_of<foxglove::Clock>()),
            R"({"type":"object","properties":{"clock":{"type":"object","properties":{"sec":{"type":"integer"},)"
            R"("nsec":{"type":"integer"}}}},"title":"waitpoint.Clock"})");
}

TEST(JsonMessage, RandomValuesAreReadBack) {
  RandomMessages random(4);
  for (int i = 0; i < 1000; ++i) {
    const std::string scan = encode_json(random.make<foxglove::LaserScan>());
    ASSERT_EQ(encode_json(decode_json<foxglove::LaserScan>("a", scan)), scan);
    const std::string scene = encode_json(random.make<foxglove::SceneUpdate>());
    ASSERT_EQ(encode_json(decode_json<foxglove::SceneUpdate>("a", scene)), scene);
    const std::string log = encode_json(random.make<rosgraph_msgs::Log>());
    ASSERT_EQ(encode_json(decode_json<rosgraph_msgs::Log>("a", log)), log);
  }
}

TEST(JsonMessage, ANumberThatIsNoneIsNull) {
  const auto scan = decode_json<foxglove::LaserScan>(
      "a", R"({"timestamp":{"sec":1,"nsec":2},"frame_id":"l","start_angle":0,"end_angle":1,"ranges":[1,null]})");
  EXPECT_EQ(scan.ranges.at(0), 1);
  EXPECT_TRUE(std::isnan(scan.ranges.at(1)));
}

TEST(JsonMessage, RefusesMissingAndMismatchedMembers) {
  const std::string refusal = "a: expected a message waitpoint.Clock in JSON";
  EXPECT_EQ(error<foxglove::Clock>(R"({"clock":{"sec":1,"nsec":2}})"), "");
  for (const char* const text : {R"({"clock":{"sec":1}})", R"({"clock":{"sec":-1,"nsec":2}})", R"({"clock":7})", "{}",
                                 R"({"clock":{"sec":1.5,"nsec":2}})", R"({"clock":{"sec":5000000000,"nsec":2}})", "7",
                                 R"({"clock":{"sec":true,"nsec":2}})", R"({"clock":{"sec":1)"})
    EXPECT_EQ(error<foxglove::Clock>(text), refusal) << text;
}

TEST(JsonMessage, BytesThatAreNoUtf8AreReplaced) {
  EXPECT_NE(encode_json(foxglove::PoseInFrame{{}, "a\xff", {}}).find("a\xef\xbf\xbd"), std::string::npos);
}

}  // namespace
}  // namespace waitpoint::messages
