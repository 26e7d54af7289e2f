// SPDX-License-Identifier: BSD-3-Clause
// Interactive runs: pausing, stepping and changing the speed do not change the run; interventions are part of it, and
// its journal repeats it in a new process.
#include <gtest/gtest.h>

#include <algorithm>

#include "modules/run/condition.hpp"
#include "modules/run/journal.hpp"
#include "tests/project.hpp"
#include "tests/runs/program.hpp"
#include "tests/runs/shipped.hpp"
#include "tests/tools/folder.hpp"
#include "tools/papers_modules.hpp"

namespace waitpoint::runs {
namespace {

const std::string until_s = "3";

/// The program with `--interactive` and these commands on standard input.
Outcome typed(const std::string& commands, std::vector<std::string> more = {}) {
  more.push_back("--interactive");
  Command command = run_command("office.yaml", until_s, more);
  command.input = commands;
  return outcome_of(command);
}

std::string free_digest() {
  static const std::string digest = to_string(run(shipped("office.yaml"), std::chrono::seconds(3)).digest);
  return digest;
}

std::size_t lines_of(const std::string& text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

// All kinds of interventions, some of them twice.
const std::string meddling =
    "run 0.5\n"
    "request rackham rflex GotoSpeed v_m_s=0.1 w_rad_s=0.2\n"
    "step 7\n"
    "move rackham 21 4.5 45\n"
    "run 1\n"
    "obstacle {name: box, centre_m: [22, 6], size_m: [0.5, 0.5], height_m: 1}\n"
    "move-obstacle crate 7 18 30\n"
    "seed 99\n"
    "at 1.505 move-obstacle box 18 4\n"
    "run 2\n"
    "remove-obstacle box\n"
    "request rackham ndd Stop\n";

TEST(Interactive, PausingSteppingAndPacingKeepTheDigest) {
  const std::vector<std::string> sessions = {
      "run\n",
      "step\nstep 1000\nrun 0.777\nstep 3\nrun +0.5\nstatus\ntasks\nhelp\ncontinue\n",
      "until rackham.travelled_m > 0.1\nuntil rackham.y_m >= 100\n",
      "run 0.1\nspeed 20\nrun 1\nspeed 0\nrun\n",
      "speed 1\ngo\nstatus\nspeed 50\n",
  };
  for (const std::string& commands : sessions) {
    const Outcome outcome = typed(commands);
    EXPECT_LE(outcome.status, 1) << outcome.errors;
    EXPECT_EQ(outcome.digest(), free_digest()) << commands << outcome.output << outcome.errors;
  }
}

TEST(Interactive, StepExecutesAndPrintsOneEvent) {
  const tools::Folder folder;
  const Outcome outcome = typed("step\nstep\nstep 40\nquit\n", {"--events", folder / "events"});
  const std::string events = folder.read("events");
  ASSERT_EQ(lines_of(events), 43u) << "a heading, and 42 events";
  std::size_t last = events.rfind('\n', events.size() - 2) + 1;
  EXPECT_NE(outcome.output.find("after 1 event\n"), std::string::npos) << outcome.output;
  EXPECT_NE(outcome.output.find("after 2 events\n"), std::string::npos) << outcome.output;
  EXPECT_NE(outcome.output.find("after 42 events\n" + events.substr(last)), std::string::npos) << outcome.output;
}

TEST(Interactive, ConditionStopsAfterTheEventThatMakesItTrue) {
  const tools::Folder folder;
  const Outcome outcome = typed("until rackham.travelled_m >= 0.05\nstatus\nquit\n", {"--summary", folder / "s.json"});
  EXPECT_NE(outcome.output.find(" 0.05 m travelled"), std::string::npos) << outcome.output;
  EXPECT_NE(outcome.digest(), free_digest());
}

TEST(Interactive, JournalReplaysToTheSameDigestInANewProcess) {
  const tools::Folder folder;
  const Outcome done = typed(meddling + "run\n", {"--journal", folder / "journal"});
  ASSERT_LE(done.status, 1) << done.errors;
  EXPECT_NE(done.digest(), free_digest());
  for (const char* told :
       {"GotoSpeed v_m_s=0.1 w_rad_s=0.2: sent", "move rackham 21 4.5 45: done", "move-obstacle crate 7 18 30: done",
        "seed 99: done", "move-obstacle box 18 4: done", "remove-obstacle box: done", "request rackham ndd Stop: ok"})
    EXPECT_NE(done.errors.find(told), std::string::npos) << told << "\n" << done.errors;
  const std::string journal = folder.read("journal");
  EXPECT_EQ(lines_of(journal), 4u + 8u + 1u) << journal;
  EXPECT_NE(journal.find("at 0.500000000 request rackham rflex"), std::string::npos) << journal;
  EXPECT_NE(journal.find("at 1.510000000 move-obstacle box"), std::string::npos) << journal;

  const auto replay = [&](std::vector<std::string> more) {
    more.insert(more.end(), {"--replay-journal", folder / "journal"});
    Command command = run_command("office.yaml", until_s, more);
    command.environment = {"PADDING=" + std::string(5000, 'x')};
    return outcome_of(command);
  };
  EXPECT_EQ(replay({}).digest(), done.digest());
  EXPECT_EQ(replay({"--speed", "30"}).digest(), done.digest());
  EXPECT_EQ(replay({"--journal", folder / "again"}).digest(), done.digest());
  EXPECT_EQ(folder.read("again"), journal);
}

TEST(Interactive, JournalEndsBetweenTwoEventsOfAnInstant) {
  const tools::Folder folder;
  const Outcome done = typed(meddling + "step 13\nquit\n", {"--journal", folder / "journal"});
  const Command again{
      {program(), "run", test::project_root() / "scenarios/office.yaml", "--replay-journal", folder / "journal"}};
  const Outcome repeated = outcome_of(again);
  ASSERT_FALSE(done.digest().empty()) << done.errors;
  EXPECT_EQ(repeated.digest(), done.digest()) << repeated.errors;
  EXPECT_EQ(repeated.errors.find("not the run of the journal"), std::string::npos) << repeated.errors;

  std::string changed = folder.read("journal");
  changed.replace(changed.find("move rackham 21 4.5"), 19, "move rackham 21 4.6");
  folder.write("journal", changed);
  const Outcome other = outcome_of(again);
  EXPECT_EQ(other.status, 1);
  EXPECT_NE(other.errors.find("this is not the run of the journal"), std::string::npos) << other.errors;
}

TEST(Interactive, RefusesAJournalOfAnotherRun) {
  const tools::Folder folder;
  const Outcome done = typed("run 0.1\nmove rackham 20 5\nrun 0.2\nquit\n", {"--journal", folder / "journal"});
  ASSERT_LE(done.status, 1) << done.errors;
  const auto complaint = [&](const std::vector<std::string>& words) {
    Command command = run_command("office.yaml", until_s, words);
    command.words.insert(command.words.end(), {"--replay-journal", folder / "journal"});
    const Outcome outcome = outcome_of(command);
    EXPECT_EQ(outcome.status, 2) << outcome.output;
    EXPECT_EQ(lines_of(outcome.errors), 1u) << outcome.errors;
    EXPECT_EQ(outcome.output, "");
    return outcome.errors;
  };
  const std::string at = std::string(folder / "journal") + ":";
  EXPECT_NE(complaint({"--seed", "2"}).find(at + "3: the journal of another seed"), std::string::npos);
  EXPECT_NE(complaint({"--strategy", "random"}).find(at + "4: the journal of another order"), std::string::npos);
  EXPECT_NE(complaint({"--set", "world.step_ms=5"}).find(at + "2: the journal of another scenario"), std::string::npos);
  const std::string good = folder.read("journal");
  const auto with = [&](const std::string& line) {
    std::string text = good;
    const std::size_t begin = text.find("at 0.1"), end = text.find('\n', begin);
    folder.write("journal", text.replace(begin, end - begin, line));
    return complaint({});
  };
  EXPECT_NE(with("at 1 move nobody 20 5").find(at + "5: there is no robot 'nobody'"), std::string::npos);
  EXPECT_NE(with("at 0 move rackham 20 5").find(at + "5: expected a time from "), std::string::npos);
  EXPECT_NE(with("at 1 request rackham nd Stop").find(at + "5: there is no module 'nd', did you mean 'ndd'?"),
            std::string::npos);
  EXPECT_NE(with("at 1 request rackham ndd Stopp").find(at + "5: there is no request 'Stopp', did you mean 'Stop'?"),
            std::string::npos);
  EXPECT_NE(with("at 1 request rackham rflex GotoSpeed v=1").find(at + "5: unknown key 'v'"), std::string::npos);
  EXPECT_NE(with("at 1 request rackham rflex GotoSpeed v_m_s=fast").find(at + "5: expected 'v_m_s' to be a number"),
            std::string::npos);
}

TEST(Interactive, ReplaysAJournalWithoutAnEnd) {
  const tools::Folder folder;
  const Outcome done = typed("run 0.1\nmove rackham 20 5\nrun\n", {"--journal", folder / "journal"});
  const std::string whole = folder.read("journal");
  folder.write("journal", whole.substr(0, whole.find("end ")));
  const Outcome repeated = outcome_of(run_command("office.yaml", until_s, {"--replay-journal", folder / "journal"}));
  EXPECT_EQ(repeated.digest(), done.digest());
  EXPECT_NE(repeated.errors.find("the journal has no end"), std::string::npos) << repeated.errors;
}

TEST(Interactive, UnknownCommandsDoNotEndTheRun) {
  const std::string wrong =
      "setp\nstep many\nrun yesterday\nuntil rackham.gaols > 1\nuntil somebody.goals > 1\nuntil rackham.goals > all\n"
      "speed -1\nmove nobody 1 2\nmove rackham 1\nrequest rackham ndd GoTo via=3\nat noon move rackham 1 2\nquit now\n";
  const Outcome outcome = typed(wrong + "run\n");
  EXPECT_EQ(outcome.digest(), free_digest());
  for (std::size_t line = 1; line <= lines_of(wrong); ++line) {
    const std::string begin = "standard input:" + std::to_string(line) + ": ";
    EXPECT_NE(("\n" + outcome.errors).find("\n" + begin), std::string::npos) << begin << " in " << outcome.errors;
  }
  EXPECT_NE(outcome.errors.find("standard input:1: unknown command 'setp', did you mean 'step'?"), std::string::npos);
}

TEST(Interactive, RefusesImpossibleInterventions) {
  const Outcome outcome = typed("run 0.1\nmove rackham 0 4\nremove-obstacle nothing\nrun\n");
  EXPECT_NE(outcome.errors.find("move rackham 0 4: refused, 'west wall' is in the way"), std::string::npos)
      << outcome.errors;
  EXPECT_NE(outcome.errors.find("remove-obstacle nothing: refused, there is no obstacle 'nothing'"), std::string::npos);
}

TEST(Interactive, EndOfInputEndsTheRun) {
  const Outcome outcome = typed("run 0.5");
  EXPECT_NE(outcome.output.find("left after 0.5 s simulated"), std::string::npos) << outcome.output;
}

TEST(Interactive, PacedRunReportsItsLag) {
  const Outcome paced = outcome_of(run_command("office.yaml", "1", {"--speed", "1e6"}));
  EXPECT_NE(paced.output.find("\n  lag "), std::string::npos) << paced.output;
  EXPECT_EQ(outcome_of(run_command("office.yaml", "1")).output.find("\n  lag "), std::string::npos);
}

// The same through the programming interface.
TEST(Interactive, EarlyAndLateSubmissionsGiveTheSameRun) {
  const scenario::Scenario scenario = shipped("office.yaml");
  const std::vector<genom::ModuleType> types = tools::papers_modules();
  const Time date = Time::from_ns(700'000'000), end = Time::from_ns(1'500'000'000);
  const auto move = run::parse_intervention("move rackham 21 4.5 45", {"test", 0});
  const auto ask = run::parse_intervention("request rackham ndd Stop", {"test", 0});

  run::Experiment early(scenario, types, {usual_seed, kernel::Order::fifo, ""});
  EXPECT_EQ(early.intervene(move, date), date);
  EXPECT_EQ(early.intervene(ask, date), date);
  early.run_before(end);

  run::Experiment late(scenario, types, {usual_seed, kernel::Order::fifo, ""});
  late.run_before(Time::from_ns(690'000'000));
  std::uint64_t steps = 0;
  late.run_before(end, [&](const kernel::EventRecord&) { return ++steps == 5; });
  EXPECT_TRUE(late.paused());
  EXPECT_LT(late.simulation().global_time(), date);
  EXPECT_EQ(late.intervene(move), date);
  EXPECT_EQ(late.intervene(ask), date);
  const auto there = run::parse_condition("rackham.x_m > 20.9", late, {"test", 0});
  late.run_before(end, [&](const kernel::EventRecord&) { return there(); });
  EXPECT_TRUE(late.paused());
  EXPECT_EQ(late.simulation().global_time(), date);
  late.run_before(end);
  EXPECT_FALSE(late.paused());

  EXPECT_EQ(early.result().digest, late.result().digest);
  EXPECT_EQ(early.result().events, late.result().events);
  EXPECT_THROW(late.intervene(move, date), BadInput);
}

}  // namespace
}  // namespace waitpoint::runs
