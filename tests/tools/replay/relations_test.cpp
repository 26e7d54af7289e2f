// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "tests/tools/folder.hpp"
#include "tools/replay/relations.hpp"

namespace waitpoint::tools {
namespace {

using namespace std::chrono_literals;
using playback::StampedPose;

Time at(double seconds) { return Time() + Duration::from_seconds(seconds); }

// One metre a second along x, a pose a second, for a minute.
std::vector<StampedPose> straight() {
  std::vector<StampedPose> trajectory;
  for (int i = 0; i <= 60; ++i) trajectory.push_back({at(i), {static_cast<double>(i), 0, 0}});
  return trajectory;
}

TEST(Relations, ATrajectoryOfTheSameDisplacementsHasNoErrorInAnyFrame) {
  std::vector<StampedPose> turned = straight();
  for (StampedPose& pose : turned) pose.pose = compose({5, -3, 2}, pose.pose);
  const Relation relations[] = {{at(0), at(10), {10, 0, 0}}, {at(20), at(5), {-15, 0, 0}}};
  const RelationErrors errors = relation_errors(relations, turned);
  EXPECT_EQ(errors.used, 2u);
  EXPECT_NEAR(errors.translation_m.mean, 0, 1e-12);
  EXPECT_NEAR(errors.rotation_rad.mean, 0, 1e-12);
}

TEST(Relations, MeanAndDeviationAreOfTheErrorsAndOfTheirSquares) {
  const Relation relations[] = {{at(0), at(10), {10, 1, 0.2}}, {at(0), at(10), {10, -3, -0.4}}};
  const RelationErrors errors = relation_errors(relations, straight());
  EXPECT_NEAR(errors.translation_m.mean, 2, 1e-9);
  EXPECT_NEAR(errors.translation_m.deviation, 1, 1e-9);
  EXPECT_NEAR(errors.squared_translation_m2.mean, 5, 1e-9);
  EXPECT_NEAR(errors.squared_translation_m2.deviation, 4, 1e-9);
  EXPECT_NEAR(errors.rotation_rad.mean, 0.3, 1e-9);
  EXPECT_NEAR(errors.rotation_rad.deviation, 0.1, 1e-9);
}

TEST(Relations, APoseBetweenTwoIsInterpolatedAndOneFarFromAllIsNotUsed) {
  const Relation relations[] = {
      {at(0.5), at(10.25), {9.75, 0, 0}}, {at(0), at(61), {61, 0, 0}}, {at(0), at(60.05), {60, 0, 0}}};
  const RelationErrors errors = relation_errors(relations, straight());
  EXPECT_EQ(errors.given, 3u);
  EXPECT_EQ(errors.used, 2u);
  EXPECT_NEAR(errors.translation_m.mean, 0, 1e-9);
}

TEST(Relations, ShortOnesAreAlsoCountedByThemselves) {
  const std::vector<Relation> relations = {{at(0), at(10), {11, 0, 0}}, {at(0), at(60), {63, 0, 0}}};
  const nlohmann::json json = nlohmann::json::parse(relations_json(relations, straight()));
  EXPECT_NEAR(json["translation_mean_m"], 2, 1e-9);
  EXPECT_EQ(json["within_20_s"]["relations"], 1);
  EXPECT_NEAR(json["within_20_s"]["translation_mean_m"], 1, 1e-9);
}

TEST(Relations, WithoutOneThatIsUsedThereAreNoErrors) {
  const std::vector<Relation> relations = {{at(100), at(110), {10, 0, 0}}};
  const nlohmann::json json = nlohmann::json::parse(relations_json(relations, straight()));
  EXPECT_EQ(json["relations"], 0);
  EXPECT_EQ(json["relations_given"], 1);
  EXPECT_TRUE(json["translation_mean_m"].is_null());
  EXPECT_TRUE(json["within_20_s"]["squared_rotation_deviation_rad2"].is_null());
}

TEST(Relations, AFileHasALineForEachAndAMalformedOneIsNamed) {
  const Folder folder;
  folder.write("good", "# comment\n\n976052857.25 976052858.5 1 2 3 0 0 0.5\n");
  const std::vector<Relation> relations = read_relations(folder / "good");
  ASSERT_EQ(relations.size(), 1u);
  EXPECT_EQ(relations[0].from.ns(), 976052857'250000000);
  EXPECT_EQ(relations[0].displacement, (Pose{1, 2, 0.5}));
  const auto message = [&](const char* text) -> std::string {
    folder.write("bad", text);
    try {
      read_relations(folder / "bad");
    } catch (const BadInput& error) {
      return std::string(error.what()).substr((folder / "bad").string().size());
    }
    return "";
  };
  EXPECT_EQ(message("\n1 2 3 4 5 6 7\n"),
            ":2: expected a number of the relation's x y z roll pitch yaw, at most 1000000, found the end of the line");
  EXPECT_EQ(message("now 2\n"), ":1: expected a relation: stamp1 stamp2 x y z roll pitch yaw, found 'now'");
  EXPECT_EQ(message("1 2 3 4 5 6 7 8\n1 2 3 4 5 6 7 8 9\n"),
            ":2: expected the end of the line after a relation's eight numbers, found '9'");
  EXPECT_EQ(message("#\n"), ": expected relations: stamp1 stamp2 x y z roll pitch yaw");
}

}  // namespace
}  // namespace waitpoint::tools
