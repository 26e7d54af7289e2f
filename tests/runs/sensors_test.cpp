// SPDX-License-Identifier: BSD-3-Clause
// Every type of sensor in the list (world/sensors/types/sensors.hpp), from the scenario through the world and the
// bridge to the posters and the recordings: nothing here names one.
#include <gtest/gtest.h>

#include <utility>

#include "core/field_text.hpp"
#include "modules/genom/module.hpp"
#include "modules/messages/json.hpp"
#include "modules/messages/readings.hpp"
#include "modules/messages/wire.hpp"
#include "modules/posters/base.hpp"
#include "tests/runs/shipped.hpp"
#include "tests/tools/folder.hpp"
#include "tools/papers_modules.hpp"
#include "tools/record/formats.hpp"
#include "tools/record/foxglove_messages.hpp"
#include "tools/record/news_reader.hpp"
#include "tools/record/reading_message.hpp"

namespace waitpoint::runs {
namespace {

/// Drives, and switches all sensors on.
class Driver : public genom::Module {
 public:
  explicit Driver(genom::ModuleSetup& setup)
      : Module(setup, 91), task_(add_task("main", {.period_ms = std::chrono::milliseconds(20)})) {
    task_.set_permanent([] {});
    command_.v_m_s = 0.3;
    command_.w_rad_s = 0.4;
    command_.sonars_on = true;
    add_poster<posters::BaseCommand>("command", task_, &command_);
    world::Sensors::for_each([&]<class S>() {
      if constexpr (world::HasCommand<S>) {
        static const typename S::Command on{true};
        add_poster<typename S::Command>(std::string(S::key) + "_command", task_, &on);
      }
    });
  }

 private:
  genom::ExecutionTask& task_;
  posters::BaseCommand command_;
};

/// A robot in the office with a sensor of each type, as it is without keys, and rows for all of them.
scenario::Scenario equipped() {
  const std::string type = "robot_types.rackham.";
  std::vector<std::string> assignments = {"robots.0.goals=[]", type + "modules=[{name: driver}]"};
  std::string rows = "{poster: driver.command, device: base.command}";
  world::Sensors::for_each([&]<class S>() {
    const std::string key(S::key);
    assignments.push_back(type + key + (world::HasSeveral<S> ? "=[{}]" : "={}"));
    scenario::RobotScenario one;
    one.laser_names = {"laser"};
    const std::string name = one.device_name<S>(0);
    rows += ", {poster: seen." + key + ", device: " + name + ".reading}";
    if (world::HasCommand<S>) rows += ", {poster: driver." + key + "_command, device: " + name + ".command}";
  });
  assignments.push_back(type + "bridge=[" + rows + "]");
  return shipped("office.yaml", assignments);
}

std::vector<genom::ModuleType> types() {
  std::vector<genom::ModuleType> types = tools::papers_modules();
  types.push_back(genom::module_type<Driver>("driver"));
  return types;
}

template <class S>
using LastReading = std::optional<typename S::Reading>;

/// What the recordings of a reading must have.
struct Recorded {
  std::string json, bytes;
};

template <class S>
Recorded recorded(const typename S::Description& description, const typename S::Reading& reading,
                  const std::string& frame) {
  using messages::messages_of, tools::scan_of;
  Recorded of;
  if constexpr (requires { scan_of(reading, frame); })
    of.json = messages::encode_json(scan_of(reading, frame));
  else
    of.json = messages::encode_json(reading);
  if constexpr (requires { messages_of(description, reading, frame); })
    for (const auto& message : messages_of(description, reading, frame))
      of.bytes = messages::encode<messages::Wire::ros1>(message);
  else
    of.bytes = messages::encode<messages::Wire::ros1>(tools::reading_message(reading, frame));
  return of;
}

/// Null in a build without ROS's library for bags.
std::unique_ptr<tools::Recording> bag_recording(const std::filesystem::path& path, const scenario::Scenario& scenario) {
  try {
    return tools::make_recording(path, scenario);
  } catch (const BadInput&) {
    return nullptr;
  }
}

TEST(Sensors, ReadingsOfEveryTypeReachPostersAndRecordings) {
  constexpr int steps = 250;
  const Duration step = std::chrono::milliseconds(10);
  const scenario::Scenario scenario = equipped();
  const world::BodyDescription& body = scenario.robots[0].body;
  run::Experiment experiment(scenario, types(), {1, kernel::Order::fifo, ""});
  tools::NewsReader reader(scenario, experiment, tools::NewsReader::Obstacles::left_out);
  const tools::Folder folder;
  const auto mcap = tools::make_recording(folder / "a.mcap", scenario);
  const auto bag = bag_recording(folder / "a.bag", scenario);
  constexpr world::BodyId id{0};

  world::Sensors::Tuple<LastReading> before, last;
  for (int k = 0; k < steps; ++k) {
    const Time now = Time() + step * k;
    experiment.run_before(now + Duration(std::chrono::milliseconds(5)));
    const tools::StepNews news = reader.take(now);
    world::Sensors::for_each([&]<class S>() {
      ASSERT_EQ(news.robots[0].readings.of<S>().size(), 1u) << S::key;
      const auto& reading = news.robots[0].readings.of<S>()[0];
      if (!reading) return;
      EXPECT_EQ(reading->date, now) << S::key;
      auto& expected = std::get<LastReading<S>>(before);
      if (!expected) expected.emplace();
      std::uint64_t number = static_cast<std::uint64_t>(k);
      if constexpr (world::ReadOnDemand<S> && requires { reading->number; }) number = reading->number;
      EXPECT_TRUE(experiment.world().read<S>(id, number, *expected)) << S::key;
      expected->date = now;
      EXPECT_EQ(text_of(*reading), text_of(*expected)) << S::key;
      std::get<LastReading<S>>(last) = reading;
    });
    mcap->add(news);
    if (bag) bag->add(news);
  }
  mcap->finish(experiment.result());
  if (bag) bag->finish(experiment.result());

  const std::string in_mcap = folder.read("a.mcap"), in_bag = folder.read("a.bag");
  const genom::NameSpace& names = experiment.robots()[0]->names();
  world::Sensors::for_each([&]<class S>() {
    const auto& reading = std::get<LastReading<S>>(last);
    ASSERT_TRUE(reading.has_value()) << S::key << " has no reading";
    const std::string device = "rackham/" + scenario.robots[0].device_name<S>(0);
    const typename S::Description description = body.equipment.description<S>(0);
    const bool is_mounted = !messages::mounts_of(description).empty();
    const std::string frame = requires { S::in_world_frame; }
    ? "world" : is_mounted ? device : "rackham";
    const Recorded files = recorded<S>(description, *reading, frame);
    for (const auto& [file, content] : {std::pair(&in_mcap, files.json), {&in_bag, files.bytes}}) {
      if (file == &in_bag && !bag) continue;
      EXPECT_NE(file->find("/" + device), std::string::npos) << S::key << " has no topic";
      EXPECT_NE(file->find(content), std::string::npos) << S::key << " has no message with its last reading";
    }
    // What the page plots.
    const genom::PosterBase* const poster = names.find_poster("seen." + std::string(S::key));
    ASSERT_NE(poster, nullptr) << S::key;
    std::vector<std::string> fields;
    S::Reading::fields([&](std::string_view name, auto, const auto&...) { fields.emplace_back(name); });
    std::vector<std::string> plotted;
    for (const FieldShape& part : poster->shape().parts) plotted.push_back(part.name);
    EXPECT_EQ(plotted, fields) << S::key;
    EXPECT_EQ(poster->look_text(), text_of(*reading)) << S::key;
  });
}

}  // namespace
}  // namespace waitpoint::runs
