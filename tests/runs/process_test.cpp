// SPDX-License-Identifier: BSD-3-Clause
// The program gives the same digest in every process: at any addresses, with any environment and additional outputs,
// paced or not, and under a debugger.
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/project.hpp"
#include "tests/runs/program.hpp"
#include "tests/runs/shipped.hpp"
#include "tests/tools/folder.hpp"

namespace waitpoint::runs {
namespace {

std::string here() { return to_string(run(shipped("office.yaml")).digest); }

/// A run of 20 s ends before its goals are reached: any status is accepted.
void expect_digest(const Outcome& outcome, const std::string& expected, const std::string& what) {
  EXPECT_LE(outcome.status, 1) << what << ": " << outcome.errors;
  EXPECT_EQ(outcome.digest(), expected) << what << ": " << outcome.errors;
}

TEST(Process, TwentyProcessesInOtherEnvironmentsGiveOneRun) {
  const std::string expected = here();
  const std::vector<std::string> locales = {"C", "de_DE.UTF-8", "tr_TR.UTF-8", "ja_JP.EUC-JP"};
  for (std::size_t i = 0; i < 20; ++i) {
    Command command = run_command("office.yaml", "20");
    command.environment = {
        "PADDING=" + std::string(i * 977, 'x'),  // moves the stack
        "MALLOC_PERTURB_=" + std::to_string(i * 13),
        "MALLOC_TOP_PAD_=" + std::to_string(i * 65'536),
        "LC_ALL=" + locales[i % locales.size()],
        "LANG=" + locales[i % locales.size()],
        "TZ=" + std::string(i % 2 == 0 ? "UTC" : "Asia/Kathmandu"),
    };
    command.folder = i % 3 == 0 ? "/" : "";
    command.random_addresses = i % 4 != 1;
    const Outcome outcome = outcome_of(command);
    expect_digest(outcome, expected, "process " + std::to_string(i));
  }
}

TEST(Process, OutputsDoNotChangeTheRun) {
  const std::string expected = here();
  const std::vector<std::string> options = {"summary", "picture", "trajectory", "digests", "events"};
  const tools::Folder folder;
  std::vector<std::string> all;
  for (const std::string& option : options) {
    const std::vector<std::string> words = {"--" + option, folder / ("one." + option)};
    expect_digest(outcome_of(run_command("office.yaml", "20", words)), expected, option);
    EXPECT_GT(std::filesystem::file_size(folder / ("one." + option)), 100u) << option;
    all.insert(all.end(), {"--" + option, folder / ("all." + option)});
  }
  all.insert(all.end(), {"--record", folder / "all.mcap"});
  expect_digest(outcome_of(run_command("office.yaml", "20", all)), expected, "all");
  for (const char* option : {"picture", "trajectory", "digests", "events"})
    EXPECT_EQ(folder.read("all." + std::string(option)), folder.read("one." + std::string(option))) << option;
  EXPECT_EQ(nlohmann::json::parse(folder.read("all.summary")).at("digest"), expected);
}

TEST(Process, SelfCheckComparesAllEvents) {
  if (test::is_emulated()) GTEST_SKIP() << "a self-check starts its program anew";
  const Outcome plain = outcome_of(run_command("office.yaml", "10"));
  const std::size_t at = plain.output.find("  events            ");
  ASSERT_NE(at, std::string::npos) << plain.output;
  const std::string events = plain.output.substr(at, plain.output.find('\n', at) - at);
  const Outcome checked = outcome_of(run_command("office.yaml", "10", {"--verify"}));
  EXPECT_EQ(checked.status, 0) << checked.errors;
  EXPECT_EQ(checked.output, "office, seed 1: the same run, twice in this process and once in a perturbed one\n" +
                                events + ", each compared with its robot's digest\n  digest            " +
                                plain.digest() + "\n");
  EXPECT_EQ(checked.errors, "");
}

TEST(Process, SelfCheckWithoutTemporaryFolderIsBadInput) {
  Command command = run_command("office.yaml", "2", {"--verify"});
  command.environment = {"TMPDIR=/proc/self"};
  const Outcome outcome = outcome_of(command);
  EXPECT_EQ(outcome.status, 2);
  EXPECT_EQ(outcome.output, "");
  EXPECT_NE(outcome.errors.find("--verify: cannot create a temporary file in '/proc/self'"), std::string::npos)
      << outcome.errors;
}

TEST(Process, PacingDoesNotChangeTheRun) {
  const Outcome free = outcome_of(run_command("office.yaml", "2"));
  const auto start = std::chrono::steady_clock::now();
  const Outcome paced = outcome_of(run_command("office.yaml", "2", {"--speed", "4"}));
  EXPECT_GE(std::chrono::steady_clock::now() - start, std::chrono::milliseconds(500));
  ASSERT_FALSE(free.digest().empty());
  expect_digest(paced, free.digest(), "paced");
}

TEST(Process, AnotherSeedGivesAnotherRun) {
  const Outcome other = outcome_of(run_command("office.yaml", "20", {"--seed", "2"}));
  ASSERT_LE(other.status, 1) << other.errors;
  EXPECT_NE(other.digest(), here());
  EXPECT_EQ(other.digest(), to_string(run(shipped("office.yaml"), first_seconds, 2).digest));
}

TEST(Process, SeededOrderRepeatsInANewProcess) {
  const bridge::RunResult expected = run(shipped("office.yaml"), first_seconds, 3, kernel::Order::seeded);
  expect_digest(outcome_of(run_command("office.yaml", "20", {"--seed", "3", "--strategy", "random"})),
                to_string(expected.digest), "seeded");
}

TEST(Process, HundredDebuggerStopsDoNotChangeTheRun) {
  if (test::is_emulated()) GTEST_SKIP() << "gdb cannot start the program";
  if (outcome_of({{"gdb", "--version"}}).status != 0) GTEST_SKIP() << "there is no gdb here";
  const tools::Folder folder;
  folder.write("stops.gdb",
               "break waitpoint::kernel::start_sleep\n"
               "run\n"
               "set $stops = 0\n"
               "while $stops < 100\n"
               "  backtrace 2\n"
               "  continue\n"
               "  set $stops = $stops + 1\n"
               "end\n"
               "delete\n"
               "continue\n");
  Command command = run_command("office.yaml", "20");
  const std::vector<std::string> gdb = {"gdb", "-nx", "-batch", "-x", folder / "stops.gdb", "--args"};
  command.words.insert(command.words.begin(), gdb.begin(), gdb.end());
  command.environment = {"DEBUGINFOD_URLS="};
  const Outcome outcome = outcome_of(command);
  if (outcome.errors.find("ptrace") != std::string::npos && outcome.digest().empty())
    GTEST_SKIP() << "no process may be debugged here: " << outcome.errors;
  EXPECT_NE(outcome.output.find("Breakpoint 1, "), std::string::npos) << outcome.output << outcome.errors;
  EXPECT_EQ(outcome.digest(), here()) << outcome.output << outcome.errors;
}

TEST(Process, WholeMissionRepeatsInAnotherProcess) {
  const tools::Folder folder;
  const auto command = [&](const std::string& name) {
    return Command{{program(), "run", test::project_root() / "scenarios/office.yaml", "--digests",
                    folder / (name + ".digests"), "--summary", folder / (name + ".json")}};
  };
  Command padded = command("second");
  padded.environment = {"PADDING=" + std::string(50'000, 'x'), "LC_ALL=tr_TR.UTF-8"};
  Process first(command("first")), second(padded);
  const Outcome one = first.wait(), two = second.wait();
  EXPECT_EQ(one.status, two.status);
  EXPECT_EQ(folder.read("first.digests"), folder.read("second.digests"));
  auto a = nlohmann::json::parse(folder.read("first.json")), b = nlohmann::json::parse(folder.read("second.json"));
  EXPECT_GT(a.at("simulated_s"), 100);
  for (const char* of_the_wall_clock : {"wall_s", "real_time_factor"}) {
    a.erase(of_the_wall_clock);
    b.erase(of_the_wall_clock);
  }
  EXPECT_EQ(a, b);
  expect_digest(one, two.digest(), "the whole mission");
}

}  // namespace
}  // namespace waitpoint::runs
