// SPDX-License-Identifier: BSD-3-Clause
// Bad input to the program: an error of one line with file, line and the expected value, exit status 2, no partial
// output.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "tests/project.hpp"
#include "tools/main.hpp"

namespace waitpoint {
namespace {

namespace fs = std::filesystem;

class BadInputTest : public testing::Test {
 protected:
  BadInputTest() : folder_(fs::temp_directory_path() / ("waitpoint-bad-input-" + std::to_string(getpid()))) {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    const fs::path shipped = test::project_root() / "scenarios";
    for (const char* file : {"office.yaml", "office-floor.yaml", "rackham.yaml"})
      fs::copy_file(shipped / file, folder_ / file);
  }
  ~BadInputTest() override { fs::remove_all(folder_); }

  std::string path(const std::string& file) const { return (folder_ / file).string(); }

  void write(const std::string& file, const std::string& text) const { std::ofstream(folder_ / file) << text; }

  // Replaces the only occurrence of `from` in a file; returns its line number.
  int edit(const std::string& file, const std::string& from, const std::string& to) const {
    std::ifstream in(folder_ / file);
    std::string text((std::istreambuf_iterator<char>(in)), {});
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    text.replace(at, from.size(), to);
    write(file, text);
    return 1 + static_cast<int>(std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n'));
  }

  // Runs the program and expects status 2 and one line on stderr; returns that line.
  std::string complaint(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), "waitpoint");
    std::vector<const char*> argv;
    for (const std::string& argument : arguments) argv.push_back(argument.c_str());
    testing::internal::CaptureStderr();
    testing::internal::CaptureStdout();
    const int status = waitpoint::main(static_cast<int>(argv.size()), argv.data());
    EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
    std::string text = testing::internal::GetCapturedStderr();
    EXPECT_EQ(status, 2) << text;
    EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1) << text;
    return text;
  }
  std::string complaint_of_run() const {
    std::string text = complaint({"run", path("office.yaml"), "--until", "1", "--summary", path("summary.json")});
    EXPECT_FALSE(fs::exists(path("summary.json")));
    return text;
  }

  fs::path folder_;
};

testing::AssertionResult says(const std::string& text, const std::vector<std::string>& parts) {
  for (const std::string& part : parts)
    if (text.find(part) == std::string::npos)
      return testing::AssertionFailure() << "'" << part << "' is missing in: " << text;
  return testing::AssertionSuccess();
}

std::string at(const std::string& file, int line) { return file + ":" + std::to_string(line) + ": "; }

TEST_F(BadInputTest, AScenarioThatIsNotThere) {
  EXPECT_TRUE(says(complaint({"run", path("nowhere.yaml")}), {"nowhere.yaml"}));
}

TEST_F(BadInputTest, YamlThatDoesNotParse) {
  write("broken.yaml", "format: 1\nname: [broken\n");
  EXPECT_TRUE(says(complaint({"run", path("broken.yaml")}), {"broken.yaml:"}));
}

TEST_F(BadInputTest, AnUnknownKeyWithTheNearestKnownOne) {
  const int line = edit("office.yaml", "step_ms", "setp_ms");
  EXPECT_TRUE(says(complaint_of_run(), {at("office.yaml", line), "setp_ms", "step_ms"}));
}

TEST_F(BadInputTest, ANegativeStep) {
  const int line = edit("office.yaml", "step_ms: 10", "step_ms: -10");
  EXPECT_TRUE(says(complaint_of_run(), {at("office.yaml", line), "step_ms"}));
}

TEST_F(BadInputTest, AMapThatIsNotThere) {
  const int line = edit("office.yaml", "include: office-floor.yaml", "map: {file: gone.yaml}");
  const std::string text = complaint_of_run();
  EXPECT_TRUE(says(text, {"gone.yaml"}));
  EXPECT_TRUE(says(text, {at("office.yaml", line)}) || says(text, {path("gone.yaml")}));
}

TEST_F(BadInputTest, ATruncatedMap) {
  edit("office.yaml", "include: office-floor.yaml", "map: {file: small.yaml}");
  write("small.yaml", "image: small.pgm\nresolution: 0.05\norigin: [0, 0, 0]\n");
  write("small.pgm", "P5\n100 100\n255\nonly a few bytes");
  EXPECT_TRUE(says(complaint_of_run(), {"small.pgm"}));
}

TEST_F(BadInputTest, AWorldFileOfAnyKind) {
  edit("office.yaml", "include: office-floor.yaml", "map: floor");
  const auto complaint_about = [&](const std::string& floor) {
    write("floor", floor);
    return complaint_of_run();
  };
  EXPECT_TRUE(says(complaint_about("0 0 1 1\n0 0 1 nan\n"), {at("floor", 2), "'nan'"}));
  EXPECT_TRUE(says(complaint_about("<sdf>\n<world>\n"), {at("floor", 2), "expected XML"}));
  EXPECT_TRUE(says(complaint_about("\nmodle()\n"), {at("floor", 2), "'modle'", "'model'"}));
  EXPECT_TRUE(says(complaint_about("include \"floor\"\n"), {at("floor", 1), "includes itself"}));
  EXPECT_TRUE(says(complaint_about("image: floor\nresolution: .nan\norigin: [0, 0, 0]\n"), {at("floor", 2), "number"}));
  EXPECT_TRUE(says(complaint_about("\x7f"
                                   "ELF\x01"),
                   {"floor:1", "expected a world"}));
}

TEST_F(BadInputTest, AFloorThatIncludesItself) {
  const int line = edit("office-floor.yaml", "format: 1", "format: 1\ninclude: office-floor.yaml");
  EXPECT_TRUE(says(complaint_of_run(), {at("office-floor.yaml", line + 1), "include"}));
}

TEST_F(BadInputTest, AGoalOutsideTheMap) {
  const int line = edit("office.yaml", "x_m: 28.4, y_m: 24", "x_m: 128.4, y_m: 24");
  EXPECT_TRUE(says(complaint_of_run(), {at("office.yaml", line), "goal"}));
}

TEST_F(BadInputTest, AGoalInsideAnObstacle) {
  const int line = edit("office.yaml", "x_m: 28.4, y_m: 24", "x_m: 0.05, y_m: 24");
  EXPECT_TRUE(says(complaint_of_run(), {at("office.yaml", line), "goal"}));
}

TEST_F(BadInputTest, ARobotThatStartsInsideAWall) {
  const int line = edit("office.yaml", "start: [20, 4, 90]", "start: [0.1, 4, 90]");
  EXPECT_TRUE(says(complaint_of_run(), {at("office.yaml", line), "rackham"}));
}

TEST_F(BadInputTest, TwoRobotsOfOneName) {
  edit("office.yaml", "robots:\n", "robots:\n  - {name: rackham, type: rackham, start: [20, 6, 90]}\n");
  EXPECT_TRUE(says(complaint_of_run(), {"office.yaml:", "rackham"}));
}

TEST_F(BadInputTest, APosterThatNoModuleWrites) {
  const int line = edit("rackham.yaml", "poster: rflex.command", "poster: rflex.comand");
  EXPECT_TRUE(says(complaint_of_run(), {at("rackham.yaml", line), "rflex.comand", "rflex.command"}));
}

TEST_F(BadInputTest, ADeviceThatTheRobotDoesNotHave) {
  const int line = edit("rackham.yaml", "device: laser.command", "device: lazer.command");
  EXPECT_TRUE(says(complaint_of_run(), {at("rackham.yaml", line), "lazer.command", "laser.command"}));
}

TEST_F(BadInputTest, AModuleOfUnknownType) {
  const int line = edit("rackham.yaml", "- name: ndd", "- name: nbd");
  EXPECT_TRUE(says(complaint_of_run(), {at("rackham.yaml", line), "nbd", "ndd"}));
}

TEST_F(BadInputTest, AModuleParameterThatDoesNotExist) {
  const int line = edit("rackham.yaml", "- name: ndd", "- {name: ndd, v_m_s_mix: 0.5}");
  EXPECT_TRUE(says(complaint_of_run(), {at("rackham.yaml", line), "v_m_s_mix", "v_m_s_max"}));
}

TEST_F(BadInputTest, AModuleParameterOfTheWrongType) {
  const int line = edit("rackham.yaml", "- name: ndd", "- {name: ndd, v_m_s_max: fast}");
  EXPECT_TRUE(says(complaint_of_run(), {at("rackham.yaml", line), "v_m_s_max", "fast"}));
}

TEST_F(BadInputTest, AModuleWhosePosterIsMissing) {
  const int line = edit("rackham.yaml", "      - name: sick\n", "");
  EXPECT_TRUE(says(complaint_of_run(), {"rackham.yaml:", "sick"})) << line;
}

TEST_F(BadInputTest, AFileThatCannotBeWritten) {
  for (const char* option : {"--summary", "--picture", "--trajectory", "--digests", "--events"})
    EXPECT_TRUE(says(complaint({"run", path("office.yaml"), "--until", "1", option, path("no/such/folder/file")}),
                     {"no/such/folder"}));
}

TEST_F(BadInputTest, AnUnknownOptionWithTheNearestKnownOne) {
  EXPECT_TRUE(says(complaint({"run", path("office.yaml"), "--sede", "3"}), {"--sede", "--seed"}));
}

TEST_F(BadInputTest, ASettingThatDoesNotExist) {
  EXPECT_TRUE(says(complaint({"check", path("office.yaml"), "--set", "world.stepms=5"}), {"--set world.stepms=5"}));
}

TEST_F(BadInputTest, AGoalThatIsFreeButOutOfReachIsNoBadInputButAReport) {
  edit("office.yaml", "    goals:\n",
       "    goals:\n      - {x_m: 20, y_m: 6, name: near}\n      - {x_m: 2.4, y_m: 20, name: walled in}\n");
  edit("office.yaml", "  shapes:\n",
       "  shapes:\n    - {corners_m: [1, 18.5, 4, 18.6]}\n    - {corners_m: [1, 21.5, 4, 21.6]}\n"
       "    - {corners_m: [1, 18.5, 1.1, 21.6]}\n    - {corners_m: [3.9, 18.5, 4, 21.6]}\n");
  const std::string scenario = path("office.yaml"), summary = path("summary.json");
  const char* argv[] = {"waitpoint", "run", scenario.c_str(), "--until", "20", "--summary", summary.c_str()};
  testing::internal::CaptureStderr();
  testing::internal::CaptureStdout();
  EXPECT_EQ(waitpoint::main(7, argv), 1);  // the scenario expects all goals
  testing::internal::GetCapturedStdout();
  testing::internal::GetCapturedStderr();
  std::ifstream in(summary);
  const std::string text((std::istreambuf_iterator<char>(in)), {});
  EXPECT_TRUE(says(text, {"no way leads to the goal"}));
}

}  // namespace
}  // namespace waitpoint
