// SPDX-License-Identifier: BSD-3-Clause
#include "tools/options.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>

#include "tests/tools/command_line.hpp"
#include "tests/tools/folder.hpp"
#include "tools/command/own_command_line.hpp"
#include "tools/command/version.hpp"

namespace waitpoint::tools {
namespace {

RunOptions run(const std::vector<const char*>& arguments) { return std::get<RunOptions>(read(arguments)); }

class CommandLine : public ::testing::Test {
 protected:
  void SetUp() override { unsetenv("WAITPOINT_SEED"); }
  void TearDown() override { unsetenv("WAITPOINT_SEED"); }
};

TEST_F(CommandLine, ScenarioAloneHasDefaults) {
  const RunOptions options = run({"run", "floor.yaml"});
  EXPECT_EQ(options.scenario, "floor.yaml");
  EXPECT_EQ(options.seed, 1u);
  EXPECT_EQ(options.speed, 0);
  EXPECT_TRUE(options.assignments.empty());
  EXPECT_FALSE(options.until || options.seeds || options.summary || options.picture || options.trajectory ||
               options.digests || options.events);
}

TEST_F(CommandLine, ReadsEveryOption) {
  const RunOptions options =
      run({"run", "--seed", "18446744073709551615", "--until=1.5", "--speed", "2", "--summary", "s.json", "--picture",
           "p.svg", "--trajectory", "t.tum", "--digests", "d", "--events", "e", "floor.yaml"});
  EXPECT_EQ(options.seed, 18446744073709551615u);
  EXPECT_EQ(options.until, Duration(std::chrono::milliseconds(1500)));
  EXPECT_EQ(options.speed, 2);
  EXPECT_EQ(options.summary, "s.json");
  EXPECT_EQ(options.picture, "p.svg");
  EXPECT_EQ(options.trajectory, "t.tum");
  EXPECT_EQ(options.digests, "d");
  EXPECT_EQ(options.events, "e");
  EXPECT_EQ(options.scenario, "floor.yaml");
}

TEST_F(CommandLine, SettingsKeepTheirOrderAndLeaveTheScenario) {
  const RunOptions options = run({"run", "--set", "robots.0.goals=[[1,2],[3,4]]", "--set=a.b=[]", "floor.yaml"});
  EXPECT_EQ(options.assignments, (std::vector<std::string>{"robots.0.goals=[[1,2],[3,4]]", "a.b=[]"}));
  EXPECT_EQ(options.scenario, "floor.yaml");
  EXPECT_EQ(std::get<CheckOptions>(read({"check", "a.yaml", "--set", "x=1"})).assignments.size(), 1u);
}

TEST_F(CommandLine, RefusesInteractiveWithAJournalToReplay) {
  const RunOptions options = run({"run", "a", "--interactive", "--journal", "j"});
  EXPECT_TRUE(options.interactive);
  EXPECT_EQ(options.journal, "j");
  EXPECT_FALSE(run({"run", "a"}).interactive);
  EXPECT_EQ(run({"run", "a", "--replay-journal", "j"}).replay_journal, "j");
  EXPECT_EQ(message({"run", "a", "--interactive", "--replay-journal", "j"}),
            "--replay-journal: cannot be used together with --interactive");
  EXPECT_EQ(message({"run", "a", "--seeds", "1..2", "--interactive"}),
            "--seeds: cannot be used together with --interactive");
  EXPECT_EQ(message({"run", "a", "--seeds", "1..2", "--journal", "j"}),
            "--seeds: cannot be used together with --journal");
}

TEST_F(CommandLine, ReadsARangeOfSeeds) {
  const RunOptions options = run({"run", "a", "--seeds", "3..10"});
  ASSERT_TRUE(options.seeds.has_value());
  EXPECT_EQ(options.seeds->first, 3u);
  EXPECT_EQ(options.seeds->last, 10u);
}

TEST_F(CommandLine, SeedOptionOverridesTheEnvironment) {
  setenv("WAITPOINT_SEED", "77", 1);
  EXPECT_EQ(run({"run", "a"}).seed, 77u);
  EXPECT_EQ(run({"run", "a", "--seed", "5"}).seed, 5u);
  setenv("WAITPOINT_SEED", "many", 1);
  EXPECT_EQ(message({"run", "a"}), "WAITPOINT_SEED: expected a whole number from 0 to 2^64 - 1, found 'many'");
}

TEST_F(CommandLine, SelfCheckRefusesFilesAndSeveralRuns) {
  EXPECT_FALSE(run({"run", "a"}).verify);
  const RunOptions options = run({"run", "a", "--verify", "--seed", "3", "--until", "2", "--replay-durations", "d"});
  EXPECT_TRUE(options.verify);
  EXPECT_EQ(options.seed, 3u);
  EXPECT_EQ(options.replay_durations, "d");
  for (const char* option :
       {"--summary", "--picture", "--trajectory", "--digests", "--events", "--decisions", "--record-durations"})
    EXPECT_EQ(message({"run", "a", "--verify", option, "f"}),
              std::string("--verify: cannot be used together with ") + option);
  EXPECT_EQ(message({"run", "a", "--verify", "--seeds", "1..2"}), "--verify: cannot be used together with --seeds");
  EXPECT_EQ(message({"run", "a", "--verify", "--speed", "1"}), "--verify: cannot be used together with --speed");
}

TEST_F(CommandLine, GdbPassesItsCommandUnchanged) {
  using Words = std::vector<std::string>;
  const auto of_scenario =
      std::get<DebugOptions>(read({"gdb", "-batch", "-x", "f", "--", "run", "a.yaml", "--seed", "?"}));
  EXPECT_EQ(of_scenario.gdb_options, (Words{"-batch", "-x", "f"}));
  EXPECT_EQ(of_scenario.words, (Words{"run", "a.yaml", "--seed", "?"}));
  EXPECT_TRUE(of_scenario.own);
  const auto of_program = std::get<DebugOptions>(read({"gdb", "--", "./runner", "--", "run"}));
  EXPECT_EQ(of_program.words, (Words{"./runner", "--", "run"}));
  EXPECT_FALSE(of_program.own);
  for (const std::vector<const char*>& wrong :
       {std::vector<const char*>{"gdb"}, {"gdb", "--"}, {"gdb", "run", "a.yaml"}})
    EXPECT_NE(message(wrong).find("gdb: expected a command to run"), std::string::npos);
  EXPECT_NE(std::get<ShownText>(read({"gdb", "--help"})).text.find("-- PROGRAM"), std::string::npos);
}

TEST_F(CommandLine, HelpAndVersionAreTexts) {
  EXPECT_EQ(std::get<ShownText>(read({"--version"})).text, "waitpoint 1.2.3\n");
  const std::string help = std::get<ShownText>(read({"run", "--help"})).text;
  for (const char* option :
       {"--seed", "--seeds", "--until", "--speed", "--summary", "--picture", "--trajectory", "--digests", "--events",
        "--verify", "--set", "--interactive", "--journal", "--replay-journal"}) {
    EXPECT_NE(help.find(option), std::string::npos) << option;
  }
  EXPECT_NE(std::get<ShownText>(read({"--help"})).text.find("check"), std::string::npos);
}

TEST_F(CommandLine, ReportsBadArgumentsInOneLine) {
  EXPECT_EQ(
      message({}),
      "command line: expected a command: run, check, plan, gdb, explore, exec, genom, play, scenarios, fit, compare, "
      "view, schema, manual or completion; see waitpoint --help");
  EXPECT_EQ(message({"--json"}), "--json: expected --version, or a command before it: waitpoint COMMAND --json ...");
  EXPECT_EQ(message({"rnu", "a"}), "command line: unknown command 'rnu', did you mean 'run'?");
  EXPECT_EQ(message({"run"}), "command line: SCENARIO is required");
  EXPECT_EQ(message({"run", "a", "--sede", "4"}), "command line: unknown option '--sede', did you mean '--seed'?");
  EXPECT_EQ(message({"run", "a", "b"}), "run: expected no further argument, found 'b'");
  EXPECT_EQ(message({"explore", "a", "b"}),
            "explore: expected no further argument, found 'b'; a program stands behind '--'");
  EXPECT_EQ(message({"explore", "/bin/true"}),
            "explore: expected '--' before the program: waitpoint explore [OPTIONS] -- /bin/true");
  EXPECT_EQ(message({"run", "ofice"}), "ofice: there is no such file, nor a shipped scenario, did you mean 'office'?");
  EXPECT_EQ(message({"run", "a", "--seed", "-1"}), "--seed: expected a whole number from 0 to 2^64 - 1, found '-1'");
  EXPECT_EQ(message({"run", "a", "--until", "0"}), "--until: expected a positive number of seconds, found '0'");
  EXPECT_EQ(message({"run", "a", "--until", "5s"}), "--until: expected a positive number of seconds, found '5s'");
  EXPECT_EQ(message({"run", "a", "--speed", "nan"}),
            "--speed: expected max or a number from 0.000001 to 1000000, found 'nan'");
  EXPECT_EQ(message({"run", "a", "--seeds", "5..1"}), "--seeds: expected FIRST..LAST, found '5..1'");
  EXPECT_EQ(message({"run", "a", "--seeds", "1..2", "--picture", "p"}),
            "--seeds: cannot be used together with --picture");
}

TEST_F(CommandLine, NamesTheCommandsOfAnOptionThatIsNotOfThisOne) {
  EXPECT_EQ(message({"explore", "a", "--external", "ada=tcp:1"}),
            "--external: is not an option of explore, but of run");
  EXPECT_EQ(message({"check", "a", "--seed", "1"}), "--seed: is not an option of check, but of run, explore, exec");
  EXPECT_EQ(message({"exec", "--seed", "1", "ls", "-l"}),
            "exec: expected '--' before the program: waitpoint exec --seed 1 -- ls -l");
}

TEST_F(CommandLine, AcceptsFormerSpellings) {
  EXPECT_EQ(run({"run", "a", "--order", "seeded"}).order, kernel::Order::seeded);
  EXPECT_EQ(run({"run", "a", "--order=seeded"}).order, kernel::Order::seeded);
  EXPECT_TRUE(run({"run", "a", "--check"}).verify);
  EXPECT_EQ(run({"run", "a", "--speed", "0"}).speed, 0);
  EXPECT_EQ(std::get<PlanOptions>(read({"plan", "p", "--svg", "f"})).picture, "f");
  EXPECT_TRUE(std::get<ReplayOptions>(read({"replay", "a.log", "--check"})).verify);
  EXPECT_EQ(std::get<ExploreOptions>(read({"explore", "--exec", "--", "a", "--exec"})).program,
            (std::vector<std::string>{"a", "--exec"}));
  // Ranks and programs of explored nodes are started with today's words.
  EXPECT_EQ(run({"run", "a", "--order", "seeded"}).arguments,
            (std::vector<std::string>{"run", "a", "--strategy", "random"}));
}

TEST_F(CommandLine, ReportsAFormerSpellingOnStandardError) {
  ::testing::internal::CaptureStderr();
  (void)run({"run", "a", "--order", "fifo", "--set", "name=--check"});
  EXPECT_EQ(::testing::internal::GetCapturedStderr(),
            "waitpoint: '--order' is now '--strategy'; the next version knows only that\n");
  ::testing::internal::CaptureStderr();
  (void)run({"run", "a", "--strategy", "fifo"});
  setenv(check_variable, "", 1);  // a process with the command line of another one
  (void)run({"run", "a", "--order", "fifo"});
  unsetenv(check_variable);
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

TEST_F(CommandLine, ARemovedOptionIsAnsweredByWhatDoesItsWork) {
  EXPECT_EQ(message({"run", "a", "--place", "ada=1"}),
            "--place: was removed: each rank has an equal part of the robots, in the order of the scenario");
  EXPECT_EQ(message({"run", "a", "--reports=jump_m=1"}),
            "--reports: was removed: settings follow the address: --external 'ROBOT=ADDRESS KEY=VALUE ...'");
}

TEST_F(CommandLine, ProcessesOutsideMakeTheRunPaced) {
  EXPECT_EQ(run({"run", "a", "--external", "ada=tcp:1"}).speed, 1);
  EXPECT_EQ(run({"run", "a", "--serve-world", "tcp:1", "--speed", "1"}).speed, 1);
  EXPECT_EQ(message({"run", "a", "--serve-world", "tcp:1", "--speed", "max"}),
            "--serve-world: expected --speed 1: processes outside live in real time");
}

TEST_F(CommandLine, HelpIsShortAndHelpAllHasEveryOption) {
  for (const char* command : {"run", "check", "plan", "gdb", "explore", "exec", "genom", "play", "fit", "compare",
                              "view", "manual", "completion"}) {
    const std::string help = std::get<ShownText>(read({command, "--help"})).text;
    EXPECT_LE(std::ranges::count(help, '\n'), 45) << help;
    EXPECT_NE(help.find("\nExample:\n  waitpoint " + std::string(command)), std::string::npos) << help;
    EXPECT_NE(help.find("Usage: waitpoint " + std::string(command)), std::string::npos) << help;
    const std::string all = std::get<ShownText>(read({command, "--help-all"})).text;
    EXPECT_GE(all.size(), help.size()) << command;
    EXPECT_EQ(all.find("rejected"), std::string::npos) << all;
  }
  EXPECT_NE(std::get<ShownText>(read({"run", "--help-all"})).text.find("\n  --watchdog S  "), std::string::npos);
}

TEST_F(CommandLine, HelpHasTheNameOfAProgramWithModulesOfItsOwn) {
  const char* const words[] = {"./build/mast", "run", "--help"};
  const std::string help = std::get<ShownText>(read_options(3, words, "waitpoint 1.2.3")).text;
  EXPECT_NE(help.find("Usage: mast run [OPTIONS] SCENARIO"), std::string::npos) << help;
}

TEST_F(CommandLine, RefusesAnEmptyWord) {
  EXPECT_EQ(message({"run", "a", "--seed", ""}), "--seed: expected a value, found ''");
  EXPECT_EQ(message({"run", ""}), "SCENARIO: expected a value, found ''");
  EXPECT_EQ(message({"explore", "a", "--iterations", ""}), "--iterations: expected a value, found ''");
}

TEST_F(CommandLine, RefusesAValueOfAFlag) {
  EXPECT_EQ(message({"run", "a", "--json=1"}), "--json: expected no value, found '1'");
  EXPECT_EQ(message({"check", "a", "--json=true"}), "--json: expected no value, found 'true'");
  EXPECT_EQ(message({"--version", "--json=yes"}), "--json: expected no value, found 'yes'");
  EXPECT_EQ(message({"run", "--help="}), "--help: expected no value, found ''");
  EXPECT_EQ(message({"exec", "--quiet=2", "--", "a", "--quiet=2"}), "--quiet: expected no value, found '2'");
  EXPECT_EQ(run({"run", "a", "--set", "name=--json=1"}).assignments.front(), "name=--json=1");
}

TEST(Version, NamesCompilerFlagsAndMath) {
  const std::string text = version_text();
  for (const char* part : {"waitpoint ", "\ndigests   wp1\n", "\ncompiler  ", "\nflags     ", "\nmath      "}) {
    EXPECT_NE(text.find(part), std::string::npos) << part;
  }
  EXPECT_EQ(text.find(" \n"), std::string::npos);
}

TEST_F(CommandLine, RefusesTwoFilesOfOneName) {
  EXPECT_EQ(message({"run", "a", "--summary", "out", "--events", "out"}),
            "--events: 'out' is the file that --summary writes");
  EXPECT_EQ(message({"run", "a", "--digests", "out", "--picture", "no/../out"}),
            "--digests: 'out' is the file that --picture writes");
  const Folder folder;
  std::ofstream(folder / "file") << "text";
  std::filesystem::create_symlink(folder / "file", folder / "link");
  const std::string link = folder / "link", file = folder / "file";
  EXPECT_EQ(message({"run", "a", "--trajectory", link.c_str(), "--record-durations", file.c_str()}),
            "--record-durations: '" + file + "' is the file that --trajectory writes");
  EXPECT_EQ(message({"run", "a", "--record", "f", "--picture", "f"}),
            "--record: 'f' is the file that --picture writes");
  EXPECT_EQ(message({"run", "a", "--replay-durations", "d", "--events", "d"}),
            "--replay-durations: 'd' is the file that --events writes");
  EXPECT_EQ(message({"run", "a", "--journal", "j", "--replay-journal", "./j"}),
            "--replay-journal: './j' is the file that --journal writes");
  EXPECT_EQ(message({"run", "a", "--summary", "/dev/null", "--events", "/dev/null"}), "");
  EXPECT_EQ(message({"run", "a", "--summary", "out", "--events", "out.events"}), "");
}

TEST_F(CommandLine, RefusesFilesOfATrajectoryUsedTwice) {
  for (const char* name : {"a.tum", "a.estimated.tum", "a.odometry.tum"})
    EXPECT_EQ(message({"run", "a", "--trajectory", "a.tum", "--events", name}),
              "--events: '" + std::string(name) + "' is the file that --trajectory writes");
  EXPECT_EQ(message({"run", "a", "--trajectory", "a.tum", "--events", "a.events.tum"}), "");
  const RunOptions options = run({"run", "a", "--trajectory", "a.tum", "--events", "a.two.odometry.tum"});
  const std::vector<std::string> robots = {"one", "two"};
  EXPECT_THROW(check_files(options, robots), BadInput);
  for (const char* name : {"-", "/dev/stdout"})
    EXPECT_NE(message({"run", "a", "--trajectory", name}).find("it writes three files"), std::string::npos);
}

TEST_F(CommandLine, RefusesAPictureNamedAsAnotherFormat) {
  for (const char* name : {"x.png", "x.PNG", "x.Jpg", "x.PDF", "x.jpeg", "x.gif", "x.webp", "x.tiff"})
    EXPECT_NE(message({"run", "a", "--picture", name}).find("ends in .svg"), std::string::npos) << name;
  for (const char* name : {"x.svg", "x.SVG", "x", "a.b/x", "x.picture", "-", "/dev/stdout"})
    EXPECT_EQ(message({"run", "a", "--picture", name}), "") << name;
}

TEST_F(CommandLine, RecognisesStandardOutputAsAFile) {
  for (const char* option : {"--summary", "--picture", "--record", "--digests", "--events", "--decisions",
                             "--record-durations", "--journal"}) {
    EXPECT_TRUE(run({"run", "a", option, "-"}).writes_standard_output()) << option;
    EXPECT_FALSE(run({"run", "a", option, "file"}).writes_standard_output()) << option;
  }
}

TEST_F(CommandLine, ReplayLineSurvivesAShell) {
  EXPECT_EQ(replay_line(run({"run", "a.yaml", "--set", "x=1", "--replay-journal", "j"}), 3),
            "waitpoint run a.yaml --seed 3 --replay-journal j --set 'x=1'");
  EXPECT_EQ(replay_line(run({"run", "a.yaml", "--strategy", "random", "--until", "2.5", "--brief"}), 3),
            "waitpoint run a.yaml --seed 3 --strategy random --until 2.500000000 --brief");
  RunOptions options;
  options.program = "./my robots";
  options.scenario = "an floor.yaml";
  options.assignments = {"x=it's"};
  options.confined_to = {"a", "b c"};
  options.allowed = {"b c"};
  options.journal = "j;1";
  options.replay_durations = "$d";
  EXPECT_EQ(replay_line(options, 3),
            "'./my robots' run 'an floor.yaml' --seed 3 --replay-durations '$d' --replay-journal 'j;1' --confined "
            "--allow 'b c' --set 'x=it'\\''s'");
}

}  // namespace
}  // namespace waitpoint::tools
