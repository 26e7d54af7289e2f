// SPDX-License-Identifier: BSD-3-Clause
// A robot with a mast, and a module that takes pictures from it whenever the robot stands. It looks whether the robot
// drives before it deploys the mast, but not again while the mast is up: a robot that plans its next way quickly drives
// off with it. The rules of mast.ctl keep that from happening.
#include <cmath>
#include <stdexcept>
#include <waitpoint/modules/genom/client.hpp>
#include <waitpoint/modules/genom/module.hpp>
#include <waitpoint/modules/posters/position.hpp>
#include <waitpoint/tools/main.hpp>

using namespace std::chrono_literals;
using waitpoint::Duration;
using waitpoint::Time;
using waitpoint::genom::PosterStatus;
using waitpoint::genom::State;
namespace genom = waitpoint::genom;
namespace posters = waitpoint::posters;

/// The poster mast.state.
struct MastState {
  double height_m = 0;  ///< 0: stowed
  static void fields(auto field) { field("height_m", &MastState::height_m); }
};

/// Input of Deploy.
struct DeployInput {
  double height_m = 1;
  static void fields(auto field) { field("height_m", &DeployInput::height_m); }
};

class Mast : public genom::Module {
 public:
  explicit Mast(genom::ModuleSetup& setup)
      : Module(setup, 42),
        task_(add_task("main", {.period_ms = 50ms, .cost_us = 20us})),
        odometry_(read_poster<posters::Odometry>("rflex.odometry")) {
    add_poster<MastState>("state", task_, &state_);
    task_.set_permanent([this] { check_that_the_robot_stands(); });
    add_activity<DeployInput>("Deploy", task_,
                              {.exec = [this](auto& activity) { return move_to(activity.input.height_m); }});
    add_activity<genom::Nothing>("Stow", task_, {.exec = [this](auto&) { return move_to(0); }}, {"Deploy"});
  }

 private:
  /// A period's motion; ends the activity at the height.
  State move_to(double height_m) {
    constexpr double step_m = 0.025;  // in a period: 0.5 m/s
    const double way_m = height_m - state_.height_m;
    state_.height_m = std::fabs(way_m) <= step_m ? height_m : state_.height_m + std::copysign(step_m, way_m);
    return state_.height_m == height_m ? State::ether : State::exec;
  }

  void check_that_the_robot_stands() {
    posters::Odometry odometry;
    if (state_.height_m == 0 || odometry_.read(odometry) == PosterStatus::empty) return;
    if (std::fabs(odometry.v_m_s) > 0.05) throw std::runtime_error("the robot moves while the mast is deployed");
  }

  MastState state_;
  genom::ExecutionTask& task_;
  genom::PosterLink<posters::Odometry>& odometry_;
};

/// The poster photographer.pictures.
struct Pictures {
  std::uint32_t taken = 0, refused = 0;
  static void fields(auto field) {
    field("taken", &Pictures::taken);
    field("refused", &Pictures::refused);
  }
};

class Photographer : public genom::Module {
 public:
  explicit Photographer(genom::ModuleSetup& setup)
      : Module(setup, 43),
        client_(setup.names, setup.name),
        task_(add_task("main", {.period_ms = 100ms, .delay_ms = 30ms, .cost_us = 50us})),
        odometry_(read_poster<posters::Odometry>("rflex.odometry")),
        navigation_(read_poster<genom::ModuleStatus>("ndd.control")) {
    add_poster<Pictures>("pictures", task_, &pictures_);
    task_.set_permanent([this] { work(); });
  }

 private:
  void work() {
    while (const auto reply = client_.receive(Duration())) {
      if (!reply->final) continue;
      const bool is_up = reply->report == genom::ok && !is_stowing_;
      if (is_up) ++pictures_.taken;
      if (reply->report != genom::ok) ++pictures_.refused;
      is_stowing_ = is_up;
      if (is_up) client_.send("mast", "Stow");
      is_busy_ = is_up;
      next_ = waitpoint::threads::now() + 5s;
    }
    if (is_busy_ || waitpoint::threads::now() < next_ || drives()) return;
    client_.send("mast", "Deploy", DeployInput{});
    is_busy_ = true;
  }

  bool drives() const {
    posters::Odometry odometry;
    genom::ModuleStatus navigation;
    odometry_.read(odometry);
    navigation_.read(navigation);
    return !navigation.activities.empty() || odometry.v_m_s != 0;
  }

  genom::Client client_;
  genom::ExecutionTask& task_;
  genom::PosterLink<posters::Odometry>& odometry_;
  genom::PosterLink<genom::ModuleStatus>& navigation_;
  Pictures pictures_;
  bool is_busy_ = false, is_stowing_ = false;
  Time next_ = Time() + 8s;
};

int main(int argc, char** argv) {
  using genom::module_type;
  return waitpoint::main(argc, argv, {module_type<Mast>("mast"), module_type<Photographer>("photographer")});
}
