// SPDX-License-Identifier: BSD-3-Clause
#include "modules/genom/settings.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <string>

namespace waitpoint::genom {
namespace {

using namespace std::chrono_literals;

struct Parameters {
  double gain = 0.5;
  bool on = false;
  std::string label = "none";
  std::int32_t count = 7;
  std::uint8_t small = 1;
  std::int64_t large = 0;
  std::uint64_t positive = 0;
  Duration pause_s = 1s;
  Duration period_ms = 2ms;
  Duration cost_us = 3us;

  static void fields(auto field) {
    field("gain", &Parameters::gain);
    field("on", &Parameters::on);
    field("label", &Parameters::label);
    field("count", &Parameters::count);
    field("small", &Parameters::small);
    field("large", &Parameters::large);
    field("positive", &Parameters::positive);
    field("pause_s", &Parameters::pause_s);
    field("period_ms", &Parameters::period_ms);
    field("cost_us", &Parameters::cost_us);
  }
};

Parameters read(const std::string& key, const std::string& text) {
  Settings settings({{key, text, "robot.yaml", 12}});
  Parameters parameters;
  settings.read(parameters);
  settings.check_all_used();
  return parameters;
}

std::string complaint(const std::string& key, const std::string& text) {
  try {
    read(key, text);
  } catch (const BadInput& bad) {
    return bad.what();
  }
  return "none";
}

TEST(Settings, EachTypeIsReadFromItsText) {
  EXPECT_EQ(read("gain", "-2.5e-3").gain, -2.5e-3);
  EXPECT_EQ(read("gain", "3").gain, 3);
  EXPECT_TRUE(read("on", "true").on);
  EXPECT_FALSE(read("on", "false").on);
  EXPECT_EQ(read("label", "two words").label, "two words");
  EXPECT_EQ(read("count", "-12").count, -12);
  EXPECT_EQ(read("small", "255").small, 255);
  EXPECT_EQ(read("large", "-9223372036854775808").large, std::numeric_limits<std::int64_t>::min());
  EXPECT_EQ(read("positive", "9223372036854775807").positive, 9223372036854775807u);
}

TEST(Settings, DurationsBearTheUnitOfTheirKey) {
  EXPECT_EQ(read("pause_s", "0.25").pause_s, Duration(250ms));
  EXPECT_EQ(read("period_ms", "13.3333333").period_ms, Duration::from_ns(13'333'333));
  EXPECT_EQ(read("cost_us", "0.5").cost_us, Duration(500ns));
  EXPECT_EQ(read("pause_s", "0").pause_s, Duration());
}

TEST(Settings, UnsetFieldsKeepTheirValues) {
  const Parameters parameters = read("count", "1");
  EXPECT_EQ(parameters.gain, 0.5);
  EXPECT_EQ(parameters.label, "none");
  EXPECT_EQ(parameters.period_ms, Duration(2ms));
}

TEST(Settings, BadValuesAreBadInputWithPlaceKeyAndExpectation) {
  EXPECT_EQ(complaint("gain", "much"), "robot.yaml:12: expected 'gain' to be a number, found 'much'");
  EXPECT_EQ(complaint("on", "yes"), "robot.yaml:12: expected 'on' to be true or false, found 'yes'");
  EXPECT_EQ(complaint("small", "256"),
            "robot.yaml:12: expected 'small' to be an integer between 0 and 255, found '256'");
  EXPECT_EQ(complaint("pause_s", "-1"),
            "robot.yaml:12: expected 'pause_s' to be a duration that is not negative, at most 1e9 s, found '-1'");
  for (const char* text : {"", " ", "1.5x", "nan", "inf", "1e999", "0x10", "1,5"}) {
    EXPECT_NE(complaint("gain", text), "none") << text;
    EXPECT_NE(complaint("period_ms", text), "none") << text;
    EXPECT_NE(complaint("count", text), "none") << text;
  }
  for (const char* text : {"1.5", "2147483648", "-2147483649", "1e3"}) EXPECT_NE(complaint("count", text), "none");
  for (const char* text : {"-1", "9223372036854775808"}) EXPECT_NE(complaint("positive", text), "none");
  EXPECT_NE(complaint("pause_s", "1e10"), "none");
}

TEST(Settings, AnUnknownKeyIsBadInputWithTheNearestKnownOne) {
  EXPECT_EQ(complaint("perod_ms", "5"), "robot.yaml:12: unknown key 'perod_ms', did you mean 'period_ms'?");
  EXPECT_EQ(complaint("colour", "5"), "robot.yaml:12: unknown key 'colour'");
}

struct Places {
  Pose start;
  Bounded<Point, 3> via;
  std::array<double, 2> gains{1, 2};
  enum class Kind : std::uint8_t { slow, fast } kind = Kind::slow;

  static void fields(auto field) {
    field("start", &Places::start);
    field("via", &Places::via);
    field("gains", &Places::gains);
    field("kind", &Places::kind);
  }
};

TEST(Settings, ElementsPointsAndPosesAreKeysOfTheirOwn) {
  std::vector<Setting> set;
  for (const auto& [key, text] :
       {std::pair("start.x", "1"), std::pair("start.heading", "0.5"), std::pair("via.1.y", "4"),
        std::pair("via.0.x", "3"), std::pair("gains.1", "7"), std::pair("kind", "1")})
    set.push_back({key, text, "robot.yaml", 12});
  Settings settings(set);
  Places places;
  settings.read(places);
  settings.check_all_used();
  EXPECT_EQ(places.start, (Pose{1, 0, 0.5}));
  ASSERT_EQ(places.via.size(), 2u);
  EXPECT_EQ(places.via[0], (Point{3, 0}));
  EXPECT_EQ(places.via[1], (Point{0, 4}));
  EXPECT_EQ(places.gains, (std::array<double, 2>{1, 7}));
  EXPECT_EQ(places.kind, Places::Kind::fast);
}

TEST(Settings, MoreElementsThanThereIsRoomForOrAGapAreUnknownKeys) {
  for (const char* key : {"via.3.x", "via.1.x"}) {
    std::vector<Setting> set = {{key, "1", "robot.yaml", 12}};
    if (key == std::string("via.3.x"))
      for (const char* other : {"via.0.x", "via.1.x", "via.2.x"}) set.push_back({other, "1", "robot.yaml", 12});
    Settings settings(set);
    Places places;
    settings.read(places);
    EXPECT_THROW(settings.check_all_used(), BadInput) << key;
  }
}

TEST(Settings, KeysMayHaveAPrefix) {
  Settings settings({{"motion.gain", "2", "f", 1}, {"gain", "3", "f", 2}});
  Parameters parameters;
  settings.read(parameters, "motion.");
  EXPECT_EQ(parameters.gain, 2);
  EXPECT_THROW(settings.check_all_used(), BadInput);
  settings.read(parameters);
  EXPECT_EQ(parameters.gain, 3);
  settings.check_all_used();
}

// A corner of a convex outline that was computed, such as -5.6e-17.
TEST(Settings, DerivedNumbersNextToZeroAreZero) {
  Settings settings(std::vector<Setting>{});
  settings.derive("gain", -5.551115123125783e-17, "the shape");
  Parameters parameters;
  settings.read(parameters);
  EXPECT_EQ(parameters.gain, 0);
}

TEST(Settings, DescribingOnesCollectWhatIsRead) {
  Settings settings = Settings::describing();
  Parameters parameters;
  settings.read(parameters);
  settings.check_least("gain", parameters.gain, 0.25);
  const std::vector<SettingRow>& rows = settings.rows();
  ASSERT_EQ(rows.size(), 10U);
  EXPECT_EQ(rows[0].key, "gain");
  EXPECT_EQ(rows[0].kind, SettingRow::Kind::number);
  EXPECT_EQ(rows[0].least, 0.25);
  EXPECT_EQ(rows[0].otherwise, "0.5");
  EXPECT_EQ(rows[1].kind, SettingRow::Kind::truth);
  EXPECT_EQ(rows[3].kind, SettingRow::Kind::integer);
  EXPECT_EQ(rows[3].most, std::numeric_limits<std::int32_t>::max());
  EXPECT_EQ(rows[8].otherwise, "2") << "in the unit of period_ms";
}

}  // namespace
}  // namespace waitpoint::genom
