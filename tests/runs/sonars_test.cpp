// SPDX-License-Identifier: BSD-3-Clause
// Sonars, bumpers and infrared range finders, from the request to `rflex` through the bridge and the world to its
// posters.
#include <gtest/gtest.h>

#include "modules/genom/client.hpp"
#include "modules/posters/base.hpp"
#include "modules/rflex/rflex.hpp"
#include "tests/runs/shipped.hpp"
#include "tools/papers_modules.hpp"

namespace waitpoint::runs {
namespace {

// Requests sonars from rflex, in place of the module under whose name it is registered.
class SonarUser : public genom::Module {
 public:
  explicit SonarUser(genom::ModuleSetup& setup)
      : Module(setup, 90), client_(setup.names, "sonar-user"), task_(add_task("main", {})) {
    task_.set_start([this] {
      client_.send("rflex", "SonarOn");
      client_.send("rflex", "InfraredOn");
      client_.send("rflex", "GotoSpeed", rflex::SpeedInput{speed_m_s_, 0});
    });
    setup.settings.read_one("speed_m_s", speed_m_s_);
  }

 private:
  genom::Client client_;
  genom::ExecutionTask& task_;
  double speed_m_s_ = 0;
};

template <class T>
T shown(const run::Experiment& experiment, const std::string& poster) {
  const auto value = dynamic_cast<const genom::Poster<T>&>(*experiment.robots()[0]->names().find_poster(poster)).look();
  EXPECT_TRUE(value.has_value()) << poster;
  return value.value_or(T());
}

TEST(Sonars, ReachTheirPosterWhenSwitchedOnAndSeeTheWallAhead) {
  std::vector<genom::ModuleType> types = tools::papers_modules();
  types.push_back(genom::module_type<SonarUser>("sonar-user"));
  // 1.15 m from the inner face of the southern wall, facing it.
  const scenario::Scenario scenario = shipped("office.yaml", {"robots.0.goals=[]", "robots.0.start=[20,1.3,-90]",
                                                              "robot_types.rackham.modules.ndd.type=sonar-user"});
  run::Experiment experiment(scenario, types, {1, kernel::Order::fifo, ""});
  experiment.run_before(Time() + Duration(std::chrono::seconds(1)));
  const auto* poster =
      dynamic_cast<genom::Poster<posters::Sonars>*>(experiment.robots()[0]->names().find_poster("rflex.sonars"));
  ASSERT_NE(poster, nullptr);
  ASSERT_TRUE(poster->look().has_value());
  const posters::Sonars sonars = *poster->look();
  ASSERT_EQ(sonars.echoes.size(), 24u);
  EXPECT_NEAR(sonars.echoes[0].range_m, 1.15 - 0.25, 0.1);  // from the ring, 25 cm ahead of the centre
  EXPECT_GT(sonars.date, Time() + Duration(std::chrono::milliseconds(900)));
}

// As on a B21r: two rings in banks, infrared range finders, a bumper.
TEST(Sonars, RingsInfraredAndBumperAreDescriptionsAndLinesOfTheTable) {
  std::vector<genom::ModuleType> types = tools::papers_modules();
  types.push_back(genom::module_type<SonarUser>("sonar-user"));
  const scenario::Scenario scenario = shipped(
      "office.yaml",
      {"robots.0.goals=[]", "robots.0.start=[20,0.6,-90]", "robot_types.rackham.modules.ndd.type=sonar-user",
       "robots.0.modules=[{name: ndd, speed_m_s: 0.2}]",
       "robot_types.rackham.modules.rflex.sonar_rings=[{count: 24, radius_m: 0.25}, {count: 24, radius_m: 0.26}]",
       "robot_types.rackham.sonars=[{firing_order: [0, 2, 1, 3], crosstalk: true}, "
       "{ring_radius_m: 0.26, height_m: 0.3, firing_order: [0, 2, 1, 3], crosstalk: true}]",
       "robot_types.rackham.infrareds={}", "robot_types.rackham.bumpers={}",
       "robot_types.rackham.bridge=[{poster: rflex.command, device: base.command}, "
       "{poster: rflex.reading, device: base.reading}, {poster: sick.command, device: laser.command}, "
       "{poster: sick.reading, device: laser.reading}, {poster: rflex.bumper_reading, device: bumpers.reading}, "
       "{poster: rflex.infrared_reading, device: infrareds.reading}]"});
  run::Experiment experiment(scenario, types, {1, kernel::Order::fifo, ""});
  experiment.run_before(Time() + Duration(std::chrono::milliseconds(250)));
  const double to_the_wall_m = experiment.world().body(world::BodyId(0)).pose.y - 0.15;
  EXPECT_EQ(shown<world::Bumpers::Reading>(experiment, "rflex.bumpers").pressed, 0u);
  const posters::Sonars sonars = shown<posters::Sonars>(experiment, "rflex.sonars");
  ASSERT_EQ(sonars.echoes.size(), 48u);
  EXPECT_NEAR(sonars.echoes[0].range_m, to_the_wall_m - 0.25, 0.05);
  EXPECT_EQ(sonars.echoes[24].mount, (Pose{0.26, 0, 0}));
  EXPECT_NEAR(sonars.echoes[24].range_m, to_the_wall_m - 0.26, 0.05);
  const posters::Infrareds infrareds = shown<posters::Infrareds>(experiment, "rflex.infrareds");
  ASSERT_EQ(infrareds.echoes.size(), 24u);
  EXPECT_NEAR(infrareds.echoes[0].range_m, to_the_wall_m - 0.25, 0.05);
  EXPECT_GT(infrareds.echoes[12].range_m, 0.7) << "nothing behind";
  experiment.run_before(Time() + Duration(std::chrono::seconds(2)));
  EXPECT_EQ(shown<world::Bumpers::Reading>(experiment, "rflex.bumpers").pressed, 1u) << "it drove into the wall";
}

}  // namespace
}  // namespace waitpoint::runs
