// SPDX-License-Identifier: BSD-3-Clause
#include "modules/scenario/keys.hpp"

#include <gtest/gtest.h>

#include "tests/modules/scenario/bad_case.hpp"

namespace waitpoint::scenario {
namespace {

using namespace std::chrono_literals;

enum class Mode : std::uint8_t { slow, fast };

struct Axis {
  double noise = 0;

  static void fields(auto field) { field("noise", &Axis::noise, ranges::rate_error, "standard deviation"); }
};

struct Device {
  static constexpr std::string_view modes[] = {"slow", "fast"};

  double range_m = 5, field_of_view_rad = exact::pi, limit = 0;
  std::uint32_t count = 3;
  Duration period = 100ms;
  Mode mode = Mode::slow;
  bool on = false;
  std::optional<double> height_m;
  Point antenna;
  Axis axis;

  static void fields(auto field) {
    field("range_m", &Device::range_m, ranges::length, required, "greatest range");
    field("field_of_view_deg", &Device::field_of_view_rad, degrees, NumberRange{0, 360, "degrees"});
    field("limit", &Device::limit, ranges::positive_number, "saturation");
    field("count", &Device::count, CountRange{1, 9});
    field("period_ms", &Device::period);
    field("mode", &Device::mode, Words{modes});
    field("on", &Device::on);
    field("height_m", &Device::height_m, ranges::height);
    field("antenna_m", &Device::antenna);
    field("axis", &Device::axis);
  }
};

Device read(const std::string& text) {
  const YamlNode node = parse_yaml(text, "d.yaml");
  Device device;
  read_object(node, "the device", keys_of<Device>(), device);
  return device;
}

TEST(Keys, DeclaredFieldsAreReadInTheUnitsOfTheirKeys) {
  const Device device = read(
      "{range_m: 7, field_of_view_deg: 90, count: 4, period_ms: 20, mode: fast, on: true, height_m: 2, "
      "antenna_m: [1, 2], axis: {noise: 0.5}}");
  EXPECT_EQ(device.range_m, 7);
  EXPECT_EQ(device.field_of_view_rad, exact::pi / 2);
  EXPECT_EQ(device.count, 4U);
  EXPECT_EQ(device.period, Duration(20ms));
  EXPECT_EQ(device.mode, Mode::fast);
  EXPECT_TRUE(device.on);
  EXPECT_EQ(device.height_m, 2);
  EXPECT_EQ(device.antenna.y, 2);
  EXPECT_EQ(device.axis.noise, 0.5);
}

TEST(Keys, MistakesNameKeyAndExpectation) {
  const auto mistake = [](const std::string& text) { return message_of<BadInput>([&] { read(text); }); };
  EXPECT_EQ(mistake("{on: true}"), "d.yaml:1: expected key 'range_m' in the device");
  EXPECT_EQ(mistake("{range_m: -1}"), "d.yaml:1: expected range_m to be a length from 0.0001 to 100000 m, found '-1'");
  EXPECT_EQ(mistake("{range_m: 1, mode: idle}"), "d.yaml:1: expected mode to be slow or fast, found 'idle'");
  EXPECT_EQ(mistake("{range_m: 1, rang_m: 1}"),
            "d.yaml:1: unknown key 'rang_m' in the device, did you mean 'range_m'?");
  EXPECT_EQ(mistake("{range_m: 1, axis: {noise: far}}"),
            "d.yaml:1: expected noise to be a number from 0 to 1000, found 'far'");
}

TEST(Keys, SchemaHasBoundsUnitsWordsAndDefaults) {
  SchemaDefinitions definitions;
  const Json schema = keys_of<Device>().table().whole_schema(definitions);
  EXPECT_EQ(schema["required"], Json({"range_m"}));
  EXPECT_EQ(schema["additionalProperties"], false);
  const Json& keys = schema["properties"];
  EXPECT_EQ(keys["range_m"]["description"], "greatest range [m]");
  EXPECT_EQ(keys["range_m"]["maximum"], 1e5);
  EXPECT_FALSE(keys["range_m"].contains("default"));
  EXPECT_EQ(keys["field_of_view_deg"]["default"], 180);
  EXPECT_FALSE(keys["limit"].contains("default")) << "0 has no effect, and is no value that can be given";
  EXPECT_EQ(keys["count"]["maximum"], 9);
  EXPECT_EQ(keys["period_ms"]["default"], 100);
  EXPECT_EQ(keys["mode"]["enum"], Json({"slow", "fast", nullptr}));
  EXPECT_EQ(keys["axis"]["properties"]["noise"]["description"], "standard deviation");
}

TEST(Keys, CompleteSchemaRefersToThatOfItsKeysAndRequires) {
  const Keys<Device> keys = Keys<Device>("device").add_fields();
  SchemaDefinitions definitions;
  EXPECT_EQ(keys.table().schema(definitions), Json({{"$ref", "#/$defs/complete_device"}}));
  EXPECT_EQ(definitions.part(map_of(keys.table())), Json({{"$ref", "#/$defs/device"}}));
  EXPECT_FALSE(definitions.made().at("device").contains("required"));
  EXPECT_EQ(definitions.made().at("device")["properties"]["range_m"]["description"], "greatest range [m]");
  const Json& complete = definitions.made().at("complete_device");
  EXPECT_EQ(complete["$ref"], "#/$defs/device");
  EXPECT_EQ(complete["required"], Json({"range_m"}));
  EXPECT_EQ(complete["properties"]["range_m"], Json({{"type", "number"}}));
  EXPECT_FALSE(complete["properties"].contains("mode"));
}

}  // namespace
}  // namespace waitpoint::scenario
