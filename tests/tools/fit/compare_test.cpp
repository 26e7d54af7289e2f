// SPDX-License-Identifier: BSD-3-Clause
// Logs of one distribution compare as alike, and others not; a real log's motion is driven by a simulated robot.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <tuple>

#include "tests/project.hpp"
#include "tests/runs/program.hpp"
#include "tests/tools/fit/known_errors.hpp"
#include "tests/tools/folder.hpp"
#include "tests/tools/xml_check.hpp"
#include "tools/fit/comparison.hpp"
#include "tools/fit/two_samples.hpp"

namespace waitpoint::tools {
namespace {

TEST(TwoSamples, SeparateTwoDistributions) {
  RandomStream random(5, "samples", "normal");
  std::vector<double> a, b, shifted;
  for (std::uint64_t i = 0; i < 400; ++i) {
    a.push_back(random.normal(3 * i));
    b.push_back(random.normal(3 * i + 1));
    shifted.push_back(0.5 + random.normal(3 * i + 2));
  }
  EXPECT_GT(compare_samples(a, b).probability, 0.05);
  EXPECT_LT(compare_samples(a, shifted).probability, 1e-6);
  EXPECT_NEAR(compare_samples(a, shifted).distance, 0.2, 0.06);
  EXPECT_EQ(compare_samples({1, 2, 2, 3}, {1, 2, 2, 3}).distance, 0);
  EXPECT_EQ(compare_samples({1, 2}, {3, 4}).distance, 1);
}

// Kolmogorov's distribution: 5 % of distances exceed 1.36 sqrt(2 / n).
TEST(TwoSamples, TheProbabilityIsThatOfKolmogorovsTables) {
  std::vector<double> a, b;
  for (int i = 0; i < 10000; ++i) {
    a.push_back(i);
    b.push_back(i + 10000 * 1.358 * std::sqrt(2.0 / 10000));
  }
  EXPECT_NEAR(compare_samples(a, b).probability, 0.05, 0.003);
}

ReplayedLog replayed(double range_noise_m, double turn_noise_rad_per_sqrt_m) {
  ReplayedLog log{.log = scans_at_rest(range_noise_m, 0.01, 0), .order = {}, .measured = {}, .localised = {}};
  const Drive drive(200, {.turn_noise_rad_per_sqrt_m = turn_noise_rad_per_sqrt_m}, 0);
  std::tie(log.measured, log.localised) = std::pair(drive.measured, drive.localised);
  for (std::size_t i = 0; i < log.localised.size(); ++i) log.scans.push_back(i % log.log.scans.size());
  log.order = logs::playing_order(log.log);
  return log;
}

TEST(Compare, ALogIsLikeItselfAndUnlikeThatOfANoisierRobot) {
  const std::vector<Sample> careful = samples_of(replayed(0.003, 0.005)), rough = samples_of(replayed(0.02, 0.05));
  const std::vector<Compared> same = compared(careful, careful), other = compared(careful, rough);
  for (const std::size_t quantity : {1u, 6u}) {  // heading, and echoes about their segments
    EXPECT_EQ(same[quantity].test->probability, 1);
    EXPECT_NEAR(same[quantity].test->delta, 0, 1e-12);
    EXPECT_LT(other[quantity].test->probability, 1e-6) << other[quantity].quantity;
  }
  EXPECT_GT(other[6].test->delta, 0.5);  // the noisier laser's are greater
  EXPECT_NE(comparison_text(other).find("time between scans, s"), std::string::npos);
  const auto json = nlohmann::json::parse(comparison_json("a.log", "b.log", other));
  EXPECT_EQ(json.at("quantities").at(6).at("delta"), other[6].test->delta);
}

// Of a robot at rest whose localised poses turn to and fro: matching takes the turns back.
TEST(Compare, ScansAreMatchedFromTheLocalisedPoses) {
  ReplayedLog still = replayed(0.003, 0);
  for (std::size_t i = 0; i < still.localised.size(); ++i) still.localised[i] = {0, 0, i % 2 == 0 ? 0 : 0.1};
  const std::vector<Sample> of_still = samples_of(still);
  EXPECT_GT(of_still[7].values.size(), 1000u);
  EXPECT_LT(compared(of_still, of_still)[7].first.median, 0.03);
  EXPECT_GT(compared(of_still, of_still)[8].first.median, 0.9);
}

TEST(Compare, AQuantityThatALogLacksHasNoTest) {
  ReplayedLog blind = replayed(0.003, 0.005);
  for (logs::LoggedScan& scan : blind.log.scans) scan.range_m.assign(scan.range_m.size(), 81.9F);
  const std::vector<Compared> rows = compared(samples_of(blind), samples_of(replayed(0.003, 0.005)));
  EXPECT_FALSE(rows[6].test);
  EXPECT_TRUE(nlohmann::json::parse(comparison_json("a", "b", rows)).at("quantities").at(6).at("distance").is_null());
}

// docs/fidelity.md, with the recording of a shipped robot in the place of a real one's log.
TEST(Fidelity, ASimulatedRobotDrivesALogsMotionInItsMapAndIsComparedWithIt) {
  const Folder folder;
  const auto waitpoint = [&](std::vector<std::string> words) {
    words.insert(words.begin(), runs::program().string());
    return runs::outcome_of({.words = std::move(words), .folder = folder / ""});
  };
  const std::string log = (folder / "real.log").string();
  ASSERT_EQ(runs::outcome_of(runs::run_command("office.yaml", "90", {"--record", log})).status, 1);  // goals left
  const auto made = waitpoint({"fit", "real.log", "--name", "real", "--out", "real.yaml"});
  ASSERT_EQ(made.status, 0) << made.errors;
  const auto mapped = waitpoint({"play", "real.log", "--trajectory", "real.tum", "--map", "real-map.yaml"});
  ASSERT_EQ(mapped.status, 0) << mapped.errors;
  std::filesystem::copy(test::project_root() / "scenarios" / "fidelity.yaml", folder / "fidelity.yaml");
  const auto run = waitpoint({"run", "fidelity.yaml", "--record", "simulated.log", "--summary", "run.json"});
  ASSERT_EQ(run.status, 0) << run.output << run.errors;
  const auto summary = nlohmann::json::parse(folder.read("run.json"));
  EXPECT_EQ(summary.at("goals_reached"), 1);
  EXPECT_NEAR(summary.at("simulated_s").get<double>(), 90, 5);
  const auto compared =
      waitpoint({"compare", "real.log", "simulated.log", "--picture", "c.svg", "--summary", "c.json"});
  ASSERT_EQ(compared.status, 0) << compared.errors;
  EXPECT_EQ(XmlCheck(folder.read("c.svg")).problem(), "");
  const auto quantities = nlohmann::json::parse(folder.read("c.json")).at("quantities");
  const auto both = [&](std::size_t quantity, const char* key) {
    const auto& of = quantities.at(quantity);
    return std::pair(of.at("first").at(key).get<double>(), of.at("second").at(key).get<double>());
  };
  const auto [real_number, simulated_number] = both(0, "number");  // of stretches: the same way
  EXPECT_NEAR(simulated_number, real_number, 3);
  const auto [real_segments, simulated_segments] = both(4, "median");
  EXPECT_NEAR(simulated_segments, real_segments, 3);
}

}  // namespace
}  // namespace waitpoint::tools
