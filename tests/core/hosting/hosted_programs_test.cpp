// SPDX-License-Identifier: BSD-3-Clause
#include "core/hosting/hosted_programs.hpp"

#include <gtest/gtest.h>

#include <csignal>

#include "core/hosting/spawned_processes.hpp"

namespace waitpoint {
namespace {

/// Notes the order of starts; the test decides of ends.
class FakeHost final : public ProgramHost {
 public:
  std::vector<std::size_t> started;
  std::vector<std::optional<ProgramEnd>> ends;
  std::string refused;  // a program that cannot be started

  void add(const HostedProgram& program) override {
    names_.push_back(program.name);
    ends.emplace_back();
  }
  void start(std::size_t program) override {
    if (names_[program] == refused) {
      ends[program] = ProgramEnd::by_exit(ProgramEnd::not_started);
      throw HostingError("no memory");
    }
    started.push_back(program);
  }
  std::optional<ProgramEnd> end_of(std::size_t program) const override { return ends[program]; }

 private:
  std::vector<std::string> names_;
};

HostedProgram program(const std::string& name, const std::vector<std::string>& after = {}) {
  HostedProgram program{.name = name, .words = {name}};
  for (const std::string& text : after) EXPECT_TRUE(parse(text, program.after.emplace_back()));
  return program;
}

using Numbers = std::vector<std::size_t>;

TEST(HostedPrograms, StartOfOneFulfilsTheConditionOfAnother) {
  FakeHost host;
  HostedPrograms programs(host);
  programs.add(program("last", {"middle.started"}));
  programs.add(program("middle", {"first.started"}));
  programs.add(program("first"));
  programs.start_those_due();
  EXPECT_EQ(host.started, (Numbers{2, 1, 0}));
  EXPECT_TRUE(programs.have_all_started());
}

TEST(HostedPrograms, EndOfOneFulfilsTheConditionOfAnother) {
  FakeHost host;
  HostedPrograms programs(host);
  programs.add(program("first"));
  programs.add(program("second", {"first"}));
  programs.start_those_due();
  EXPECT_EQ(host.started, Numbers{0});
  ASSERT_NE(programs.awaited_by(1), nullptr);
  EXPECT_EQ(in_words(*programs.awaited_by(1)), "first");
  host.ends[0] = ProgramEnd::by_exit(3);
  EXPECT_FALSE(programs.runs(0));
  programs.start_those_due();
  EXPECT_EQ(host.started, (Numbers{0, 1}));
  EXPECT_TRUE(programs.runs(1));
  EXPECT_FALSE(programs.have_all_ended());
}

TEST(HostedPrograms, NamesInConditionsAreThoseOfTheSameRobot) {
  FakeHost host;
  HostedPrograms programs(host);
  HostedProgram other = program("driver"), client = program("client", {"driver.started"});
  other.robot = "ada";
  client.robot = "bea";
  programs.add(other);
  programs.add(client);
  programs.start_those_due();
  EXPECT_EQ(host.started, Numbers{0});
}

TEST(HostedPrograms, ConditionsThatAreNotOfProgramsAreTheOwners) {
  FakeHost host;
  bool is_published = false;
  HostedPrograms programs(host, [&](const StartCondition&) { return is_published; });
  programs.add(program("reader", {"/run/socket"}));
  programs.start_those_due();
  EXPECT_TRUE(host.started.empty());
  EXPECT_TRUE(programs.waits_for_outside());
  is_published = true;
  programs.start_those_due();
  EXPECT_EQ(host.started, Numbers{0});
  EXPECT_FALSE(programs.waits_for_outside());
}

TEST(HostedPrograms, FailedStartIsAnEndAndOthersStartAfterIt) {
  FakeHost host;
  host.refused = "bad";
  HostedPrograms programs(host);
  programs.add(program("bad"));
  programs.add(program("next", {"bad"}));
  EXPECT_THROW(programs.start_those_due(), HostingError);
  EXPECT_EQ(programs.end_of(0)->exit_status(), 127);
  programs.start_those_due();
  EXPECT_EQ(host.started, Numbers{1});
}

std::string refusal(const std::vector<HostedProgram>& programs) {
  std::vector<ConditionedStart> starts;
  for (const HostedProgram& each : programs) starts.push_back({each.name, each.after});
  std::string text;
  check_conditions(starts, [&](std::size_t number, const StartCondition* unknown) {
    text = programs[number].name + (unknown != nullptr ? " awaits unknown " + unknown->of : " never starts");
  });
  return text;
}

TEST(StartConditions, UnknownProgramsAndCyclesAreRefused) {
  EXPECT_EQ(refusal({program("a"), program("b", {"a", "tcp:80", "/file"}), program("c", {"b.started"})}), "");
  EXPECT_EQ(refusal({program("a"), program("b", {"nobody.started"})}), "b awaits unknown nobody");
  EXPECT_EQ(refusal({program("a"), program("b", {"c"}), program("c", {"b.started"})}), "b never starts");
}

TEST(ProgramEnd, ExitStatusIsThatOfAShell) {
  EXPECT_EQ(ProgramEnd::by_exit(3).exit_status(), 3);
  EXPECT_EQ(ProgramEnd::by_exit(3).in_words(), "ended with status 3");
  const ProgramEnd killed(SIGKILL);
  EXPECT_EQ(killed.exit_status(), 137);
  EXPECT_EQ(killed.in_words(), "ended by signal 9 (Killed)");
  EXPECT_TRUE(killed.is_failure());
}

TEST(SpawnedProcesses, HaveTheirWordsEnvironmentAndEnds) {
  SpawnedProcesses host;
  HostedPrograms programs(host);
  HostedProgram shell = program("shell");
  shell.words = {"sh", "-c", "read word || exit $STATUS"};  // without input
  shell.environment = {{"STATUS", "1"}, {"STATUS", "7"}};
  programs.add(shell);
  programs.start_those_due();
  EXPECT_TRUE(host.await_end(0));
  EXPECT_EQ(programs.end_of(0)->exit_status(), 7);
}

}  // namespace
}  // namespace waitpoint
