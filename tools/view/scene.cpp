// SPDX-License-Identifier: BSD-3-Clause
#include "tools/view/scene.hpp"

#include <algorithm>
#include <map>
#include <numbers>
#include <typeinfo>

#include "modules/genom/module.hpp"
#include "modules/run/plan.hpp"
#include "tools/output/picture_frame.hpp"

namespace waitpoint::tools::view {
namespace {

constexpr double margin_m = 0.5;

Json operations() {
  Json names = Json::array();
  for (int i = 0; i <= static_cast<int>(kernel::Operation::call); ++i)
    names.push_back(kernel::name(static_cast<kernel::Operation>(i)));
  return names;
}

/// The rectangle that holds obstacles, starts and goals.
class Bounds {
 public:
  void add(Point p, double radius_m = 0) {
    low_ = {std::min(low_.x, p.x - radius_m), std::min(low_.y, p.y - radius_m)};
    high_ = {std::max(high_.x, p.x + radius_m), std::max(high_.y, p.y + radius_m)};
  }
  void add(const world::Shape& shape) {
    if (shape.kind == world::Shape::Kind::cylinder) return add(shape.pose.position(), shape.radius_m);
    for (const Point& p : corners(shape)) add(p);
  }
  Json json() const {
    if (low_.x > high_.x) return {-1, -1, 1, 1};
    return {rounded(low_.x - margin_m), rounded(low_.y - margin_m), rounded(high_.x + margin_m),
            rounded(high_.y + margin_m)};
  }

 private:
  Point low_{1e9, 1e9}, high_{-1e9, -1e9};
};

Json lasers(const scenario::RobotScenario& robot) {
  Json list = Json::array();
  for (std::size_t i = 0; i < robot.body.sensors<world::Lasers>().size(); ++i) {
    const Pose& mount = robot.body.sensors<world::Lasers>()[i].mount;
    list.push_back({{"name", i < robot.laser_names.size() ? robot.laser_names[i] : "laser"},
                    {"x", rounded(mount.x)},
                    {"y", rounded(mount.y)},
                    {"heading", rounded(mount.heading)}});
  }
  return list;
}

Json sonars(const scenario::RobotScenario& robot) {
  Json list = Json::array();
  for (const world::SonarRingDescription& ring : robot.body.sensors<world::Sonars>())
    for (std::uint32_t i = 0; i < ring.count; ++i) {
      const double heading = 2 * std::numbers::pi * i / ring.count;
      list.push_back({{"x", rounded(ring.ring_radius_m * std::cos(heading))},
                      {"y", rounded(ring.ring_radius_m * std::sin(heading))},
                      {"heading", rounded(heading)},
                      {"width", rounded(2 * ring.half_cone_rad)},
                      {"range", rounded(ring.range_max_m)}});
    }
  return list;
}

Json module(const genom::Module& module) {
  constexpr const char* kinds[] = {"control", "execution", "init"};
  Json requests = Json::array(), tasks = Json::array();
  for (const genom::RequestType& request : module.requests())
    requests.push_back({{"name", request.name},
                        {"kind", kinds[static_cast<int>(request.kind)]},
                        {"fields", fields(request.input_shape())}});
  for (const genom::ExecutionTask& task : module.tasks())
    tasks.push_back({{"name", task.name()}, {"period", task.options().period_ms.ns()}});
  return {{"name", module.name()}, {"requests", requests}, {"tasks", tasks}};
}

/// The common part of a crowd's robots, once for all that share it.
class RobotTypes {
 public:
  /// The number of the robot's type.
  std::size_t number(const scenario::RobotScenario& robot, const bridge::Robot& software) {
    Json devices = {{"lasers", lasers(robot)}, {"sonars", sonars(robot)}};
    std::string key = text_of(devices);
    for (const auto& [name, of_robot] : software.names().modules()) {
      const genom::Module& module = *of_robot;
      key += name + ' ' + typeid(module).name();
      for (const genom::RequestType& request : module.requests()) key += ' ' + request.name;
      key += '\n';
    }
    for (const auto& [name, written] : software.names().posters()) {
      const genom::PosterBase& poster = *written;
      key += name + ' ' + poster.writer() + ' ' + typeid(poster).name() + '\n';
    }
    const auto [found, is_new] = numbers_.try_emplace(std::move(key), types_.size());
    if (is_new) types_.push_back(described(std::move(devices), software));
    return found->second;
  }
  const Json& types() const { return types_; }

 private:
  static Json described(Json type, const bridge::Robot& software) {
    type["modules"] = type["posters"] = Json::array();
    for (const auto& [name, of_robot] : software.names().modules()) type["modules"].push_back(module(*of_robot));
    for (const auto& [name, poster] : software.names().posters())
      type["posters"].push_back({{"name", name}, {"writer", poster->writer()}, {"fields", fields(poster->shape())}});
    return type;
  }

  std::map<std::string, std::size_t> numbers_;
  Json types_ = Json::array();
};

Json robot_scene(const scenario::RobotScenario& robot) {
  Json json = {{"name", robot.name}};
  json.update(body(robot.body.shape));
  json["goals"] = Json::array();
  for (const scenario::Goal& goal : robot.goals)
    json["goals"].push_back({{"x", rounded(goal.position.x)}, {"y", rounded(goal.position.y)}, {"name", goal.name}});
  return json;
}

}  // namespace

std::vector<world::Obstacle> obstacles_shown(const run::Experiment& experiment) {
  const world::WorldDescription& world = experiment.world().description();
  std::vector<world::Obstacle> shown = world.obstacles;
  const std::vector<world::Obstacle> meshes = run::meshes_on_plan(world);
  shown.insert(shown.end(), meshes.begin(), meshes.end());
  return shown;
}

Json scene(const scenario::Scenario& scenario, const run::Experiment& experiment, const SceneOptions& options) {
  Bounds bounds;
  RobotTypes types;
  Json obstacles = Json::array(), robots = Json::array();
  for (const world::Obstacle& shown : obstacles_shown(experiment)) {
    bounds.add(shown.shape);
    obstacles.push_back(obstacle(shown));
  }
  for (std::size_t i = 0; i < scenario.robots.size(); ++i) {
    const scenario::RobotScenario& robot = scenario.robots[i];
    bounds.add(robot.body.start.position(), 0.5);
    for (const scenario::Goal& goal : robot.goals) bounds.add(goal.position);
    robots.push_back(robot_scene(robot));
    robots.back()["type"] = types.number(robot, *experiment.robots()[i]);
  }
  constexpr const char* orders[] = {"fifo", "seeded", "explored"};
  return {{"kind", "header"},
          {"scenario", scenario.name},
          {"description", scenario.description},
          {"seed", options.seed},
          {"order", orders[static_cast<int>(options.order)]},
          {"until", options.until.ns()},
          {"step", scenario.step.ns()},
          {"program", options.program},
          {"bounds", bounds.json()},
          {"operations", operations()},
          {"obstacles", obstacles},
          {"types", types.types()},
          {"robots", robots},
          {"control", options.is_controlled}};
}

}  // namespace waitpoint::tools::view
