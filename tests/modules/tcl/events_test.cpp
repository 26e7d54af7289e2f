// SPDX-License-Identifier: BSD-3-Clause
// Events and clocks of scripts in virtual time.
#include <gtest/gtest.h>

#include "fibers/sync/thread.hpp"
#include "tests/modules/tcl/scripted_robot.hpp"
#include "tests/project.hpp"

namespace waitpoint::tcl {
namespace {

using namespace std::chrono_literals;

TEST(After, BlocksInVirtualTime) {
  ScriptedRobot robot;
  EXPECT_EQ(robot.run("after 3600000; clock seconds").text, "3600");
}

TEST(After, RunsScriptsByTheirDatesThenTheirOrder) {
  ScriptedRobot robot;
  const ScriptEnd outcome = robot.run(
      "after 20 {lappend log c}; after 10 {lappend log a}; after 10 {lappend log b}; after idle {lappend log idle}; "
      "set gone [after 15 {lappend log never}]; after cancel $gone; "
      "after 30 {set done [clock milliseconds]}; vwait done; list $log $done");
  EXPECT_EQ(outcome.text, "{idle a b c} 30");
}

TEST(Update, RunsWhatIsDueWithoutWaiting) {
  ScriptedRobot robot;
  EXPECT_EQ(robot.run("set log {}; after 0 {lappend log now}; after 5 {lappend log later}; update; set log").text,
            "now");
}

TEST(Update, IdletasksRunsPresentIdleEventsOnly) {
  ScriptedRobot robot;
  EXPECT_EQ(robot
                .run("set log {}; after idle {lappend log idle; after idle {lappend log again}}; "
                     "after 0 {lappend log zero}; update idletasks; set log")
                .text,
            "idle");
  EXPECT_EQ(robot.run("update foo").text, "bad option \"foo\": must be idletasks");
}

TEST(Vwait, IsAnErrorWhereNothingCanHappen) {
  ScriptedRobot robot;
  const ScriptEnd outcome = robot.run("vwait never");
  EXPECT_FALSE(outcome.ok);
  EXPECT_EQ(outcome.text, "can't wait for variable \"never\": would wait forever");
}

TEST(Interpreters, HaveSeparateEventsInOneThread) {
  ScriptedRobot robot;
  std::string first, second;
  robot.genom::TestRobot::run([&] {
    const std::string script =
        "set name %; foreach t {10 20 30} { after $t {lappend log $name} }; "
        "after 35 {set done 1}; vwait done; set log";
    const auto with_name = [&](const char* name) { return std::string(script).replace(9, 1, name); };
    thread other([&] { second = robot.run_here(with_name("b")).text; });
    first = robot.run_here(with_name("a")).text;
    other.join();
  });
  EXPECT_EQ(first, "a a a");
  EXPECT_EQ(second, "b b b");
}

TEST(Interpreters, DoNotKeepAScriptThatBlocksAtTheEndOfTheRun) {
  ScriptedRobot robot;
  std::string after;
  robot.genom::TestRobot::run([&] {
    thread({.name = "script", .service = true}, [&] {
      after = robot.run_here("catch {vwait_forever}; catch {after 100000}; puts late").text;
    }).detach();
    this_thread::sleep_for(1s);
  });
  EXPECT_EQ(after, "");
  EXPECT_TRUE(robot.said.empty());
}

TEST(Clock, HasTheDateOfTheRunInUtc) {
  ScriptedRobot robot;
  EXPECT_EQ(robot.run("after 1500; clock format [clock seconds] -format {%Y-%m-%d %H:%M:%S}").text,
            "1970-01-01 00:00:01");
}

TEST(Surroundings, DoNotReachAScript) {
  ScriptedRobot robot;
  EXPECT_EQ(robot
                .run("list [array get env] [info commands {exec}] [info commands socket] [info commands pid] "
                     "[catch {open |ls}]")
                .text,
            "{TZ :UTC} {} {} {} 1");
  EXPECT_EQ(robot.run("expr {sin(1e6) < 2 && atan2(1, 1) * 4 > 3.14159 && hypot(3, 4) == 5}").text, "1");
  EXPECT_EQ(robot.run("expr {rand()}").text, robot.run("expr {rand()}").text);
}

TEST(Surroundings, AreNotReachedByOtherWays) {
  ScriptedRobot robot;
  for (const char* script : {"interp create c",
                             "interp cr",
                             "info hostname",
                             "::tcl::info::hostname",
                             "file tempfile n",
                             "file mtime /",
                             "file stat / s",
                             "file lstat / s",
                             "file atime /",
                             "chan pipe",
                             "pwd",
                             "cd /",
                             "open /dev/urandom",
                             "open /proc/self/stat",
                             "open /proc/../proc/uptime",
                             "source /proc/uptime",
                             "file copy /proc/uptime copy",
                             "set tcl_platform(osVersion)",
                             "set tcl_platform(user)",
                             "set env(PATH)",
                             "timerate {}",
                             "::tcl::unsupported::representation a",
                             "::tcl::unsupported::disassemble lambda {{} {}}",
                             "interp invokehidden {} cd /",
                             "interp expose {} exec",
                             "info nameofexecutable",
                             "encoding system ascii",
                             "encoding dirs",
                             "gets stdin",
                             "file attributes /",
                             "file link a b",
                             "file owned /",
                             "load libm.so",
                             "file system /"})
    EXPECT_EQ(robot.run("catch {" + std::string(script) + "}").text, "1") << script;
  EXPECT_EQ(robot.run("interp alias {} g {} list; g [info exists a] [file tail /a/b]").text, "0 b");
  EXPECT_EQ(robot.run("clock format 0").text, "Thu Jan 01 00:00:00 UTC 1970");
  robot.run("chan puts stdout said");
  EXPECT_EQ(robot.said, std::vector<std::string>{"said"});
}

TEST(Glob, IsSorted) {
  ScriptedRobot robot;
  robot.folders = {(test::project_root() / "scenarios").string()};
  const std::string names = "[glob -directory " + (test::project_root() / "scenarios").string() + " *]";
  EXPECT_EQ(robot.run("expr {" + names + " eq [lsort " + names + "] && [llength " + names + "] > 9}").text, "1");
}

}  // namespace
}  // namespace waitpoint::tcl
