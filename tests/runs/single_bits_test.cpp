// SPDX-License-Identifier: BSD-3-Clause
// Single bits change the digest: of a thousand runs, each with one random bit flipped (of a poster's byte, an event's
// time, a pose, or a random stream's output), all have different digests.
//
// The bits are flipped at their source, by a module of this test and in the scenario, for one tick of a run; their
// consequences are left to the run. The code under test has no hooks for it.
#include <gtest/gtest.h>

#include <bit>
#include <map>

#include "core/random.hpp"
#include "modules/genom/module.hpp"
#include "modules/posters/base.hpp"
#include "modules/posters/laser.hpp"
#include "modules/run/experiment.hpp"
#include "modules/scenario/scenario_reader.hpp"
#include "tests/tools/folder.hpp"

namespace waitpoint::runs {
namespace {

using namespace std::chrono_literals;

constexpr std::uint64_t ticks = 30;
constexpr Duration tick = 10ms;

struct Bytes {
  std::array<std::uint8_t, 32> bytes{};
  std::array<std::uint32_t, 4> draw{};

  static void fields(auto field) {
    field("bytes", &Bytes::bytes);
    field("draw", &Bytes::draw);
  }
};

struct Flip {
  std::uint64_t byte_tick = ~0u, byte_bit = 0;  // of the poster's bytes
  std::uint64_t cost_tick = ~0u, cost_bit = 0;  // of the nanoseconds of a codel's cost
  std::uint64_t draw_tick = ~0u, draw_bit = 0;  // of the output of a stream

  static void fields(auto field) {
    field("byte_tick", &Flip::byte_tick);
    field("byte_bit", &Flip::byte_bit);
    field("cost_tick", &Flip::cost_tick);
    field("cost_bit", &Flip::cost_bit);
    field("draw_tick", &Flip::draw_tick);
    field("draw_bit", &Flip::draw_bit);
  }
};

/// Drives in curves, reads the laser, and exports some bytes, with one bit flipped at one tick.
class Prober : public genom::Module {
 public:
  explicit Prober(genom::ModuleSetup& setup)
      : Module(setup, 77),
        task_(add_task("main", {.period_ms = tick, .delay_ms = {}, .cost_us = {}})),
        command_(add_poster<posters::BaseCommand>("command", task_)),
        laser_(add_poster<posters::LaserCommand>("laser", task_)),
        bytes_(add_poster<Bytes>("bytes", task_)) {
    setup.settings.read(flip_);
    task_.set_permanent([this] { probe(); });
  }

 private:
  void probe() {
    Bytes value;
    for (std::size_t i = 0; i < value.bytes.size(); ++i) value.bytes[i] = static_cast<std::uint8_t>(i * 41 + tick_ * 7);
    if (tick_ == flip_.byte_tick)
      value.bytes[flip_.byte_bit / 8] =
          static_cast<std::uint8_t>(value.bytes[flip_.byte_bit / 8] ^ 1u << flip_.byte_bit % 8);
    value.draw = noise_.block(tick_);
    if (tick_ == flip_.draw_tick) value.draw[flip_.draw_bit / 32] ^= 1u << flip_.draw_bit % 32;
    std::int64_t cost_ns = 0x155'555;
    if (tick_ == flip_.cost_tick) cost_ns ^= std::int64_t{1} << flip_.cost_bit;
    threads::compute(std::chrono::nanoseconds(cost_ns));
    bytes_.write(value);
    command_.write({0.4, 0.3 * static_cast<double>(tick_ % 3), false});
    laser_.write({true});
    ++tick_;
  }

  Flip flip_;
  genom::ExecutionTask& task_;
  genom::OutputPoster<posters::BaseCommand>& command_;
  genom::OutputPoster<posters::LaserCommand>& laser_;
  genom::OutputPoster<Bytes>& bytes_;
  RandomStream noise_{1, "prober", "bytes"};
  std::uint64_t tick_ = 0;
};

constexpr const char* room =
    "format: 1\n"
    "name: a room\n"
    "world: {shapes: [{corners_m: [0, 0, 5, 0.1]}, {corners_m: [0, 4.9, 5, 5]}, {corners_m: [0, 0.1, 0.1, 4.9]},\n"
    "                 {corners_m: [4.9, 0.1, 5, 4.9]}]}\n"
    "robots:\n"
    "  - name: prober\n"
    "    start: [2.7, 2.6, 40]\n"
    "    shape: {radius_m: 0.2, height_m: 1}\n"
    "    base: {kind: synchro}\n"
    "    lasers: [{beams: 91}]\n"
    "    modules: [{name: prober}]\n"
    "    bridge:\n"
    "      - {poster: prober.command, device: base.command}\n"
    "      - {poster: prober.odometry, device: base.reading}\n"
    "      - {poster: prober.laser, device: laser.command}\n"
    "      - {poster: prober.scan, device: laser.reading}\n";

class SingleBits : public ::testing::Test {
 protected:
  SingleBits() {
    folder_.write("room.yaml", room);
    scenario_ = scenario::read_scenario(folder_ / "room.yaml");
    unchanged_ = digest(scenario_);
    EXPECT_EQ(digest(scenario_), unchanged_);
  }

  static std::string digest(const scenario::Scenario& scenario, std::uint64_t seed = 1) {
    const std::vector<genom::ModuleType> types = {genom::module_type<Prober>("prober")};
    run::Experiment experiment(scenario, types, {seed, kernel::Order::fifo, ""});
    experiment.run_before(Time() + tick * static_cast<std::int64_t>(ticks));
    return to_string(experiment.result().robots.at(0).digest);
  }

  /// The scenario in which the prober flips bit `bit` of `what` at tick `at`.
  scenario::Scenario flipped(const std::string& what, std::uint64_t at, std::uint64_t bit) const {
    scenario::Scenario scenario = scenario_;
    std::vector<Setting>& settings = scenario.robots[0].modules[0].settings;
    settings.push_back({what + "_tick", std::to_string(at), "room.yaml", 1});
    settings.push_back({what + "_bit", std::to_string(bit), "room.yaml", 1});
    return scenario;
  }

  std::uint64_t draw(std::uint64_t bound) { return random_.below(bound, drawn_++); }

  /// `change` describes the flipped bit; equal changes must give equal digests.
  void expect_new(const std::string& change, const std::string& digest) {
    EXPECT_NE(digest, unchanged_) << change;
    const auto [at, is_new] = changes_.emplace(digest, change);
    EXPECT_EQ(at->second, change) << "two changes have one digest";
  }

  tools::Folder folder_;
  scenario::Scenario scenario_;
  std::string unchanged_;
  RandomStream random_{1, "test", "bits"};
  std::uint64_t drawn_ = 0;
  std::map<std::string, std::string> changes_;  // by digest
};

TEST_F(SingleBits, InPostersTimesPosesAndStreamsChangeTheDigest) {
  const auto flip = [&](const std::string& what, std::uint64_t bits) {
    const std::uint64_t at = draw(ticks - 1), bit = draw(bits);
    expect_new(what + " " + std::to_string(bit) + " at " + std::to_string(at), digest(flipped(what, at, bit)));
  };
  for (int i = 0; i < 250; ++i) flip("byte", 8 * sizeof(Bytes::bytes));
  for (int i = 0; i < 250; ++i) flip("cost", 22);  // at most 4 ms, so that the tick is not missed
  for (int i = 0; i < 250; ++i) {
    scenario::Scenario scenario = scenario_;
    Pose& start = scenario.robots[0].body.start;
    const std::uint64_t which = draw(3), bit = draw(52);  // of the mantissa
    double& coordinate = which == 0 ? start.x : which == 1 ? start.y : start.heading;
    coordinate = std::bit_cast<double>(std::bit_cast<std::uint64_t>(coordinate) ^ std::uint64_t{1} << bit);
    expect_new("pose " + std::to_string(which) + " " + std::to_string(bit), digest(scenario));
  }
  for (int i = 0; i < 186; ++i) flip("draw", 128);
  // A bit of the seed changes all random draws of the world.
  for (int bit = 0; bit < 64; ++bit)
    expect_new("seed " + std::to_string(bit), digest(scenario_, 1 ^ std::uint64_t{1} << bit));
  EXPECT_GT(changes_.size(), 700u);
}

}  // namespace
}  // namespace waitpoint::runs
