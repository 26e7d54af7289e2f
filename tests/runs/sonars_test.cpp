// SPDX-License-Identifier: BSD-3-Clause
// The ring of sonars, from the request to `rflex` over the bridge and the world to rflex's poster.
#include <gtest/gtest.h>

#include "modules/genom/client.hpp"
#include "modules/posters/base.hpp"
#include "tests/runs/shipped.hpp"
#include "tools/papers_modules.hpp"

namespace waitpoint::runs {
namespace {

// Asks rflex for its sonars, in the place of the module whose name it is given.
class SonarUser : public genom::Module {
 public:
  explicit SonarUser(genom::ModuleSetup& setup)
      : Module(setup, 90), client_(setup.names, "sonar-user"), task_(add_task("main", {})) {
    task_.set_start([this] { client_.send("rflex", "SonarOn"); });
  }

 private:
  genom::Client client_;
  genom::ExecutionTask& task_;
};

TEST(Sonars, ReachTheirPosterWhenSwitchedOnAndSeeTheWallAhead) {
  std::vector<genom::ModuleType> types = tools::papers_modules();
  types.push_back(genom::module_type<SonarUser>("sonar-user"));
  // 1.15 m from the inner face of the southern wall, facing it.
  const bridge::Scenario scenario = shipped("office.yaml", {"robots.0.goals=[]", "robots.0.start=[20,1.3,-90]",
                                                            "robot_types.rackham.modules.ndd.type=sonar-user"});
  bridge::Experiment experiment(scenario, types, {1, kernel::Order::fifo, ""});
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

}  // namespace
}  // namespace waitpoint::runs
