// SPDX-License-Identifier: BSD-3-Clause
// Bad input to the program: an error of one line with file, line and the expected value, exit status 2, no partial
// output.
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
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
  // A process stays confined by the system.
  static int status_of_child(const std::vector<const char*>& argv) {
    std::fflush(nullptr);
    const pid_t child = fork();
    if (child == 0) {
      const int status = waitpoint::main(static_cast<int>(argv.size()), argv.data());
      std::fflush(nullptr);
      _exit(status);
    }
    int end = 0;
    waitpid(child, &end, 0);
    return WIFEXITED(end) ? WEXITSTATUS(end) : -1;
  }
  std::string complaint(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), "waitpoint");
    std::vector<const char*> argv;
    argv.reserve(arguments.size());
    for (const std::string& argument : arguments) argv.push_back(argument.c_str());
    testing::internal::CaptureStderr();
    testing::internal::CaptureStdout();
    const bool is_confined = std::find(arguments.begin(), arguments.end(), "--confined") != arguments.end();
    const int status =
        is_confined ? status_of_child(argv) : waitpoint::main(static_cast<int>(argv.size()), argv.data());
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

TEST_F(BadInputTest, AnUnknownKeyOfTheExecutiveOfARobotWithoutGoals) {
  EXPECT_TRUE(says(complaint({"run", path("office.yaml"), "--set", "robots.0.goals=[]", "--set",
                              "robots.0.executive.mission.round=2"}),
                   {"unknown key 'mission.round'", "did you mean 'mission.rounds'?"}));
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

// Of shapes there is no edge: the map holds every start and goal. A map of cells ends where its file does.
TEST_F(BadInputTest, AStartOrGoalOutsideAMapOfCells) {
  edit("office.yaml", "include: office-floor.yaml", "map: small.yaml");
  write("small.yaml", "image: small.pgm\nresolution: 1\norigin: [18, 2, 0]\n");
  std::string pixels;
  for (int i = 0; i < 20; ++i) pixels += "255 ";
  write("small.pgm", "P2\n5 4\n255\n" + pixels);
  EXPECT_TRUE(says(complaint_of_run(), {"office.yaml:", "goal 1 'south-west office' of robot 'rackham' is outside"}));
  const int line = edit("office.yaml", "start: [20, 4, 90]", "start: [220, 4, 90]");
  EXPECT_TRUE(says(complaint_of_run(), {at("office.yaml", line),
                                        "robot 'rackham' starts outside the map, which lies "
                                        "between (18.00, 2.00) and (23.00, 6.00)"}));
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
  for (const char* option : {"--summary", "--picture", "--trajectory", "--digests", "--events", "--decisions"})
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

TEST_F(BadInputTest, AWrongFileIsNotPrintedWhole) {
  write("secret.yaml", std::string(3000, 's'));
  edit("office.yaml", "include: office-floor.yaml", "include: secret.yaml");
  const std::string text = complaint_of_run();
  EXPECT_TRUE(says(text, {std::string(60, 's')}));
  EXPECT_LT(text.size(), 600U);
}

TEST_F(BadInputTest, AFileOutsideOfAConfinedScenariosFolders) {
  const std::string inside = path("inside/office.yaml"), outside = path("rackham.yaml");
  fs::create_directory(path("inside"));
  for (const char* file : {"office.yaml", "office-floor.yaml"})
    fs::copy_file(path(file), path("inside/" + std::string(file)));
  const int line = edit("inside/office.yaml", "include: rackham.yaml", "include: ../rackham.yaml");
  const std::string place = at("inside/office.yaml", line);
  for (const char* command : {"run", "check", "explore"})
    EXPECT_TRUE(says(complaint({command, inside, "--confined"}), {place, "rackham.yaml", "--confined"})) << command;
  // A value of the command line is confined, too.
  EXPECT_TRUE(
      says(complaint({"check", inside, "--confined", "--allow", path(""), "--set", "world.include=/etc/passwd"}),
           {"/etc/passwd", "--confined"}));
  testing::internal::CaptureStdout();
  EXPECT_EQ(status_of_child({"waitpoint", "check", inside.c_str(), "--confined", "--allow", folder_.c_str()}), 0);
  testing::internal::GetCapturedStdout();
}

TEST_F(BadInputTest, ANameThatIsNoPrintableLine) {
  for (const char* name : {R"(\e]0;pwn\a)", R"(ok\n\n  digest  wp1:0)", R"(\u009b31m)", R"(\u202eoffice)"}) {
    const std::string assignment = std::string("name=\"") + name + "\"";
    for (const char* command : {"run", "check"})
      EXPECT_TRUE(says(complaint({command, path("office.yaml"), "--set", assignment}), {"expected name to be a text"}));
    EXPECT_TRUE(says(complaint({"check", path("office.yaml"), "--set",
                                std::string("robots.rackham.goals=[{x_m: 2, y_m: 12, name: \"") + name + "\"}]"}),
                     {"expected name to be a text"}));
  }
}

TEST_F(BadInputTest, APipeToInclude) {
  ASSERT_EQ(mkfifo(path("pipe").c_str(), 0600), 0);
  const int line = edit("office.yaml", "include: office-floor.yaml", "include: pipe");
  EXPECT_TRUE(says(complaint_of_run(), {at("office.yaml", line), "no regular file"}));
}

TEST_F(BadInputTest, AJournalWithoutEnd) {
  EXPECT_TRUE(says(complaint({"run", path("office.yaml"), "--replay-journal", "/dev/zero"}), {"/dev/zero", "64 MiB"}));
}

TEST_F(BadInputTest, AMeshOutsideOfAConfinedScenariosFoldersIsNotSoughtThere) {
  fs::create_directory(path("inside"));
  write("there.stl", "solid s\nendsolid s\n");
  const auto complaint_about = [&](const std::string& file, const std::string& uri) {
    write("inside/w.world",
          "<sdf version='1.6'><world name='w'><model name='m'><static>true</static><link name='l'><collision name='c'>"
          "<geometry><mesh><uri>" +
              uri + "</uri></mesh></geometry></collision></link></model></world></sdf>");
    write("inside/r.urdf", "<robot name='r'><link name='base'><collision><geometry><mesh filename='" + uri +
                               "'/></geometry></collision></link></robot>");
    write("inside/sdf.yaml",
          "format: 1\nworld: {map: w.world}\nrobots: [{name: r, start: [0, 0, 0], "
          "shape: {radius_m: 0.2, height_m: 0.5}}]\n");
    write("inside/urdf.yaml", "format: 1\nrobots: [{name: r, start: [0, 0, 0], urdf: r.urdf}]\n");
    std::string text = complaint({"check", path("inside/" + file), "--confined"});
    EXPECT_TRUE(says(text, {uri.substr(3), "--confined"}));
    text.replace(text.find(uri.substr(3)), uri.size() - 3, "MESH");
    return text;
  };
  for (const char* file : {"sdf.yaml", "urdf.yaml"})
    EXPECT_EQ(complaint_about(file, "../there.stl"), complaint_about(file, "../gone.stl")) << file;
}

TEST_F(BadInputTest, AProgramInAConfinedScenario) {
  write("program.yaml",
        "format: 1\nname: program\nuntil_s: 1\nrobots:\n  - name: r\n    shape: {radius_m: 0.2, height_m: 0.5}\n"
        "    start: [0, 0, 0]\n    programs:\n      - {name: any, file: any.so}\n");
  EXPECT_TRUE(says(complaint({"check", path("program.yaml"), "--confined"}), {at("program.yaml", 9), "--confined"}));
}

}  // namespace
}  // namespace waitpoint
