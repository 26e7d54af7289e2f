// SPDX-License-Identifier: BSD-3-Clause
// Scenarios that are read are run for a second of virtual time, or so many events. Inputs are trees that are mutated as
// trees: tree_mutator.hpp. They name files of the other corpora as ../FORMAT/NAME.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include "modules/run/expectation.hpp"
#include "modules/run/experiment.hpp"
#include "modules/scenario/scenario_reader.hpp"
#include "tests/fuzz/input_folder.hpp"
#include "tests/fuzz/refusal.hpp"
#include "tests/fuzz/tree_mutator.hpp"
#include "tests/fuzz/tree_text.hpp"
#include "tools/papers_modules.hpp"
#include "world/planar/outline.hpp"

namespace waitpoint::fuzz {
namespace {

namespace fs = std::filesystem;

constexpr Duration run_length = std::chrono::seconds(1);
constexpr int events_max = 10'000;

Vocabulary vocabulary_of_corpus() {
  Vocabulary vocabulary;
  for (const fs::directory_entry& file : fs::directory_iterator(fs::path(WAITPOINT_FUZZ_CORPUS) / "scenario_run"))
    reads_or_refuses([&] { vocabulary.learn(scenario::load_yaml(file.path())); });
  return vocabulary;
}

bool is_near(Point point) {
  constexpr double metres_max = 100;
  return std::abs(point.x) <= metres_max && std::abs(point.y) <= metres_max;
}

/// The cells of a map that is drawn of shapes are counted in the hundred millions: minutes under a sanitizer.
bool has_small_floor(const scenario::Scenario& scenario) {
  for (const world::Obstacle& obstacle : scenario.shapes) {
    const world::Bounds bounds = bounds_of(outline_of(obstacle.shape));
    if (!is_near(bounds.low) || !is_near(bounds.high)) return false;
  }
  for (const world::MeshObstacle& obstacle : scenario.meshes)
    for (const world::SpaceVector& corner : obstacle.mesh->corners)
      if (!is_near({corner.x, corner.y})) return false;
  for (const scenario::RobotScenario& robot : scenario.robots) {
    if (!is_near(robot.body.start.position())) return false;
    for (const scenario::Goal& goal : robot.goals)
      if (!is_near(goal.position)) return false;
  }
  return true;
}

/// Programs are other people's code; robots and beams in any number take long without finding more.
bool is_small(const scenario::Scenario& scenario) {
  constexpr std::size_t robots_max = 4, beams_max = 2000;
  std::size_t beams = 0;
  for (const scenario::RobotScenario& robot : scenario.robots) {
    if (!robot.programs.empty()) return false;
    for (const world::LaserDescription& laser : robot.body.sensors<world::Lasers>()) beams += laser.beams;
  }
  return has_small_floor(scenario) && scenario.robots.size() <= robots_max && beams <= beams_max;
}

void read_and_run(const fs::path& file) {
  const scenario::Scenario scenario = scenario::read_scenario(file, {});
  if (!is_small(scenario)) return;
  static const std::vector<genom::ModuleType> types = tools::shipped_modules();
  run::Experiment experiment(scenario, types, {.seed = 1, .order = kernel::Order::fifo, .replay = "fuzzing"});
  int events = 0;
  experiment.run_before(Time() + std::min(run_length, scenario.until),
                        [&](const kernel::EventRecord&) { return ++events >= events_max; });
  run::unmet(scenario.expect, experiment.result());
  experiment.unwind();
}

}  // namespace
}  // namespace waitpoint::fuzz

using namespace waitpoint;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const fuzz::InputFolder folder{WAITPOINT_FUZZ_CORPUS};
  const fuzz::fs::path file = folder.file("scenario.yaml", std::string(reinterpret_cast<const char*>(data), size));
  fuzz::reads_or_refuses([&] { fuzz::read_and_run(file); });
  return 0;
}

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t size_max,
                                               unsigned seed) {
  static const fuzz::Vocabulary vocabulary = fuzz::vocabulary_of_corpus();
  std::minstd_rand random(seed);
  std::string text(reinterpret_cast<const char*>(data), size);
  fuzz::reads_or_refuses([&] {
    scenario::YamlNode document = scenario::parse_yaml(text, "scenario");
    fuzz::mutate(document, vocabulary, random);
    text = fuzz::text_of(document);
  });
  if (text.size() > size_max) return size;
  std::memcpy(data, text.data(), text.size());
  return text.size();
}
