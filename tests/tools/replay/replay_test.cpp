// SPDX-License-Identifier: BSD-3-Clause
// `waitpoint play` as a user calls it: on a recording of a simulated run, whose truth is known, and on real logs.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/project.hpp"
#include "tests/runs/program.hpp"
#include "tests/tools/command_line.hpp"
#include "tests/tools/folder.hpp"

namespace waitpoint::tools {
namespace {

runs::Outcome replay(std::vector<std::string> words) {
  words.insert(words.begin(), {runs::program().string(), "play"});
  return runs::outcome_of({.words = words});
}

std::string office() { return (test::project_root() / "scenarios" / "office.yaml").string(); }

/// The numbers of each line that begins with `first`, without it; of all lines if it is empty.
std::vector<std::vector<double>> rows(const std::string& text, const std::string& first) {
  std::vector<std::vector<double>> rows;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with(first)) continue;
    std::istringstream words(line.substr(first.size()));
    std::vector<double>& row = rows.emplace_back();
    for (double number = 0; words >> number;) row.push_back(number);
  }
  return rows;
}

TEST(Replay, TheTrajectoryOfARecordedRunIsNearItsTruePathInEveryFormat) {
  const Folder folder;
  const std::string log = (folder / "run.log").string();
  ASSERT_EQ(runs::outcome_of(runs::run_command("office.yaml", "20", {"--record", log})).status, 1);  // goals left
  const auto truth = rows(folder.read("run.log"), "TRUEPOS ");
  ASSERT_GT(truth.size(), 150u);
  const Pose start{truth[0][0], truth[0][1], truth[0][2]};
  for (const std::string name : {"run.log", "run.mcap", "run.bag"}) {
    const std::string file = (folder / name).string(), path = (folder / "path.tum").string();
    const runs::Outcome recorded = runs::outcome_of(runs::run_command("office.yaml", "20", {"--record", file}));
    if (recorded.status == 2) continue;  // built without rosbag_storage
    const runs::Outcome replayed = replay({file, "--scenario", office(), "--trajectory", path});
    ASSERT_EQ(replayed.status, 0) << replayed.errors;
    const auto poses = rows(folder.read("path.tum"), "");
    ASSERT_EQ(poses.size(), truth.size()) << name;
    for (std::size_t i = 0; i < poses.size(); ++i) {
      const Point at = between(start, {truth[i][0], truth[i][1], truth[i][2]}).position();
      EXPECT_NEAR(poses[i][0], truth[i][6], 1e-6);
      EXPECT_LT(length(at - Point{poses[i][1], poses[i][2]}), 0.05) << name;
    }
  }
}

TEST(Replay, ACorrectedLogOfCarmenCanBeReplayed) {
  const Folder folder;
  const std::string log = (folder / "run.log").string(), corrected = (folder / "corrected.log").string();
  ASSERT_EQ(runs::outcome_of(runs::run_command("office.yaml", "5", {"--record", log})).status, 1);  // goals left
  ASSERT_EQ(replay({log, "--scenario", office(), "--trajectory", corrected}).status, 0);
  EXPECT_EQ(rows(folder.read("corrected.log"), "FLASER ").size(), rows(folder.read("run.log"), "FLASER ").size());
  EXPECT_EQ(replay({corrected, "--modules", "rflex,sick"}).status, 0);
}

TEST(Replay, TheSummaryHasScansRelationsAndOneDigest) {
  const Folder folder;
  const std::string log = (folder / "run.log").string();
  ASSERT_EQ(runs::outcome_of(runs::run_command("office.yaml", "20", {"--record", log})).status, 1);  // goals left
  const auto truth = rows(folder.read("run.log"), "TRUEPOS ");
  std::string relations;
  for (std::size_t i = 0; i + 50 < truth.size(); i += 10) {
    const auto &a = truth[i], &b = truth[i + 50];
    const Pose to = between({a[0], a[1], a[2]}, {b[0], b[1], b[2]});
    std::ostringstream line;
    line.precision(12);
    line << a[6] << ' ' << b[6] << ' ' << to.x << ' ' << to.y << " 0 0 0 " << to.heading << '\n';
    relations += line.str();
  }
  folder.write("relations", relations);
  const runs::Outcome first = replay({log, "--relations", (folder / "relations").string(), "--summary", "-",
                                      "--picture", (folder / "map.svg").string()});
  ASSERT_EQ(first.status, 0) << first.errors;
  const nlohmann::json summary = nlohmann::json::parse(first.output);
  EXPECT_EQ(summary["scans"], summary["scans_of_log"]);
  EXPECT_EQ(summary["poses"], summary["scans"]);
  EXPECT_EQ(summary["relations"]["relations"], summary["relations"]["relations_given"]);
  EXPECT_LT(summary["relations"]["translation_mean_m"], 0.03);
  EXPECT_GT(summary["relations"]["translation_mean_m"], 0);
  EXPECT_NE(folder.read("map.svg").find("</svg>"), std::string::npos);
  EXPECT_EQ(replay({log}).digest(), summary["digest"].get<std::string>());
  EXPECT_NE(replay({log, "--set", "segloc.points.key_travel_m=0.2"}).digest(), summary["digest"].get<std::string>());
}

TEST(Replay, TheMapOfARecordedRunIsAWorldForRobots) {
  const Folder folder;
  const std::string log = (folder / "run.log").string(), map = (folder / "floor.yaml").string();
  ASSERT_EQ(runs::outcome_of(runs::run_command("office.yaml", "20", {"--record", log})).status, 1);  // goals left
  ASSERT_EQ(replay({log, "--scenario", office(), "--map", map}).status, 0);
  folder.write("scenario.yaml",
               "format: 1\nname: again\nuntil_s: 20\nexpect: {goals_reached: all, collisions: 0}\n"
               "world: {map: floor.yaml}\nrobot_types: {include: " +
                   (test::project_root() / "scenarios" / "rackham.yaml").string() +
                   "}\nrobots: [{name: r, type: rackham, start: [0, 0, 0], goals: [[1.5, 0]]}]\n");
  const runs::Outcome again =
      runs::outcome_of({.words = {runs::program().string(), "run", (folder / "scenario.yaml").string()}});
  EXPECT_EQ(again.status, 0) << again.output << again.errors;
}

TEST(Replay, AMapThatCannotBeDrawnLeavesNoFiles) {
  const Folder folder;
  const auto told = [&](const std::string& scans) {
    folder.write("a.log", scans);
    const runs::Outcome outcome =
        replay({(folder / "a.log").string(), "--modules", "rflex,sick", "--map", (folder / "m.yaml").string(),
                "--trajectory", (folder / "a.tum").string(), "--summary", (folder / "a.json").string()});
    EXPECT_EQ(outcome.status, 2);
    EXPECT_EQ(outcome.output, "");
    EXPECT_EQ(folder.count(), 1u);
    return outcome.errors.substr(outcome.errors.find("a.log"));
  };
  EXPECT_EQ(told("FLASER 1 90 0 0 0 0 0 0 1 h 1\n"),
            "a.log: no map: expected echoes at poses that are known, found none\n");
  EXPECT_EQ(told("FLASER 1 2 0 0 0 0 0 0 1 h 1\nFLASER 1 2 9e4 9e4 0 9e4 9e4 0 2 h 2\n"),
            "a.log: no map: expected at most 268435456 cells of 0.05 m, found 90000 x 90002 m\n");
}

TEST(Replay, AMapOfALongWayIsThatOfTheRoomsAtItsEnds) {
  const Folder folder;
  folder.write("a.log", "FLASER 1 2 0 0 0 0 0 0 1 h 1\nFLASER 1 2 100 100 0 100 100 0 2 h 2\n");
  ASSERT_EQ(
      replay({(folder / "a.log").string(), "--modules", "rflex,sick", "--map", (folder / "m.yaml").string()}).status,
      0);
  const std::string image = folder.read("m.pgm");
  EXPECT_EQ(image.substr(0, 17), "P5\n2001 2041\n255\n");
  const auto free_cells = std::count(image.begin() + 17, image.end(), static_cast<char>(254));
  EXPECT_GT(free_cells, 40);
  EXPECT_LE(free_cells, 2 * 40);
}

TEST(Replay, TheTextNamesTheMostFrequentOfManyKindsOfOtherRecords) {
  const Folder folder;
  std::string text = "FLASER 1 2 0 0 0 0 0 0 1 h 1\nTWICE 1\nTWICE 1\n";
  for (int i = 0; i < 50; ++i) text += "KIND" + std::to_string(100 + i) + " 1\n";
  folder.write("a.log", text);
  EXPECT_NE(replay({(folder / "a.log").string(), "--modules", "rflex,sick"})
                .output.find("left out          2 TWICE, 1 KIND100, 1 KIND101, 1 KIND102, 1 KIND103, 1 KIND104, "
                             "1 KIND105, 1 KIND106, 43 other kinds\n"),
            std::string::npos);
}

TEST(Replay, ANameThatIsNoUtf8IsPrintedWithOthersInItsPlace) {
  const Folder folder;
  folder.write("a\xff.log", "FLASER 1 2 0 0 0 0 0 0 1 h 1\n");
  const runs::Outcome outcome = replay({(folder / "a\xff.log").string(), "--modules", "rflex,sick", "--summary", "-"});
  EXPECT_EQ(outcome.status, 0);
  EXPECT_TRUE(nlohmann::json::parse(outcome.output)["log"].get<std::string>().ends_with("a\uFFFD.log"));
  EXPECT_NE(outcome.errors.find("a?.log: finished"), std::string::npos);
}

TEST(Replay, RelationsOfWhichNoneIsUsedHaveNoErrors) {
  const Folder folder;
  folder.write("a.log", "FLASER 1 2 0 0 0 0 0 0 1 h 1\n");
  folder.write("relations", "5 9 0 0 0 0 0 0\n");
  EXPECT_NE(
      replay({(folder / "a.log").string(), "--modules", "rflex,sick", "--relations", (folder / "relations").string()})
          .output.find("relations         0 of 1: - (none has poses at both of its stamps)\n"),
      std::string::npos);
}

TEST(Replay, ReportsErrorsInOneLine) {
  const Folder folder;
  folder.write("a.log", "FLASER 1 2 0 0 0 0 0 0 1 h 1\n");
  const std::string log = (folder / "a.log").string();
  const auto error = [&](std::vector<std::string> words) {
    const runs::Outcome outcome = replay(std::move(words));
    EXPECT_EQ(outcome.status, 2);
    return outcome.errors;
  };
  EXPECT_EQ(error({log, "--set", "segloc.nonsense=1"}).substr(0, 43), "waitpoint: --set segloc.nonsense=1: unknown");
  EXPECT_EQ(error({log, "--set", "ndd.x=1"}),
            "waitpoint: --set: expected the name of a module that runs, and a key of it, found 'ndd.x=1'\n");
  EXPECT_EQ(error({log, "--modules", "rflex,sick", "--pose", "pom"}),
            "waitpoint: --pose: expected poses of a module that runs, found 'pom'\n");
  EXPECT_EQ(error({log, "--modules", "rflex,siick"}),
            "waitpoint: --modules: unknown module type 'siick', did you mean 'sick'?\n");
  EXPECT_EQ(error({log, "--set", "sick.mount_x_m=0.2"}),
            "waitpoint: --set sick.mount_x_m=0.2: expected no mount_x_m of 'sick': the laser's mount is the log's, or "
            "'log: {mount: [x, y, degrees]}' of a scenario\n");
  EXPECT_EQ(error({log, "--set", "rflex.units_per_m=1000"}),
            "waitpoint: --set rflex.units_per_m=1000: expected no units_per_m of 'rflex': the base's reports are made "
            "of the log, in units of their own\n");
  EXPECT_EQ(error({log, "--modules", "rflex,sick,rflex"}),
            "waitpoint: --modules: expected each name once, found 'rflex,sick,rflex'\n");
  EXPECT_EQ(error({log, "--modules", "rflex"}),
            "waitpoint: --modules: expected a module that reads 'sick.reading', which the log feeds\n");
  EXPECT_EQ(message({"play", "a.log", "--pose", "gps"}), "--pose: expected segloc, pom or odometry, found 'gps'");
}

TEST(Replay, EveryScanOfARealLogIsLocalised) {
  const auto data = test::data_folder();
  if (!data) GTEST_SKIP() << "no data folder (WAITPOINT_DATA or ../shared/data)";
  const runs::Outcome outcome = replay({*data + "/logs/mit_csail.gfs.gz", "--until", "60", "--summary", "-"});
  ASSERT_EQ(outcome.status, 0) << outcome.errors;
  const nlohmann::json summary = nlohmann::json::parse(outcome.output);
  EXPECT_EQ(summary["scans_of_log"], 406);
  EXPECT_GT(summary["scans"], 40);
  EXPECT_GE(summary["poses"].get<int>(), summary["scans"].get<int>() - 1);  // the last may be under way
}

}  // namespace
}  // namespace waitpoint::tools
