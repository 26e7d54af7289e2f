// SPDX-License-Identifier: BSD-3-Clause
// Errors of scripts: their places, before and while they are executed, and recursion without end.
#include <gtest/gtest.h>

#include "fibers/sync/thread.hpp"
#include "tests/modules/tcl/scripted_robot.hpp"

namespace waitpoint::tcl {
namespace {

std::string error_of(const std::string& script) {
  const auto error = tcl_library().check(script);
  return error ? std::to_string(error->line) + ": " + error->text : "none";
}

TEST(Syntax, IsCheckedBeforeAScriptIsExecuted) {
  EXPECT_EQ(error_of("puts a\nproc f {x} {\n  puts $x\n}\nif 1 {\n f 3\n} else {\n f 4\n}\n"), "none");
  EXPECT_EQ(error_of("puts a\nproc f {} {\n  puts b\n"), "2: expected a closing brace for this one");
  EXPECT_EQ(error_of("puts a\nputs [list b\nputs c"), "2: expected a closing bracket for this one");
  EXPECT_EQ(error_of("puts \"a\nputs c"), "1: expected a closing quote for this one");
  EXPECT_EQ(error_of("if 1 {\n}else {\n}"), "2: expected white space after a closing brace");
  EXPECT_EQ(error_of("proc f {} {\n  while 1 {\n    puts {a}b\n  }\n}"),
            "3: expected white space after a closing brace");
  EXPECT_EQ(error_of("if 1 {\n puts a\n} elseif {2} {\n puts \"a\"b\n}"),
            "4: expected white space after a closing quote");
}

TEST(Errors, HaveTheLineOfTheirCommand) {
  ScriptedRobot robot;
  EXPECT_EQ(robot.run("set a 1\nset b 2\nerror c").line, 3);
  EXPECT_EQ(robot.run("set a 1\nforeach b {1 2} {\n  set a 2\n  unknown_command\n}").line, 4);
  EXPECT_EQ(robot.run("proc f {} {\n  set a 1\n  if 1 {\n    g\n  }\n}\nproc g {} {\n\n  error here\n}\nf").line, 9);
  const ScriptEnd outcome = robot.run("proc f {} { error here }\nf");
  EXPECT_EQ(outcome.text, "here");
  EXPECT_NE(outcome.trace.find("(procedure \"f\" line 1)"), std::string::npos) << outcome.trace;
}

TEST(Exit, EndsTheScriptAlone) {
  ScriptedRobot robot;
  const ScriptEnd outcome = robot.run("catch {exit}\nputs late");
  EXPECT_TRUE(outcome.ok) << outcome.text;
  EXPECT_TRUE(robot.said.empty());
}

TEST(Puts, IsALineOfTheLog) {
  ScriptedRobot robot;
  robot.run("puts -nonewline a; puts b; puts stderr \"c\\nd\"; puts -nonewline e");
  EXPECT_EQ(robot.said, (std::vector<std::string>{"ab", "c", "d", "e"}));
}

/// The part of a stack that a call used.
std::size_t used_stack(const std::string& script, std::string& text) {
  ScriptedRobot robot;
  std::size_t used = 0;
  robot.genom::TestRobot::run([&] {
    thread(thread_attributes{.name = "script", .stack = kernel::StackSize::program}, [&] {
      constexpr std::size_t most = 7 << 20;
      constexpr unsigned char mark = 0xA5;
      const volatile unsigned char here = 0;
      // Below this frame: nothing is there yet.
      auto* const high = const_cast<volatile unsigned char*>(&here) - 65536;
      for (std::size_t i = 0; i < most; ++i) *(high - i) = mark;
      text = robot.run_here(script).text;
      std::size_t left = most;
      while (left > 0 && *(high - left + 1) == mark) --left;
      used = left + 65536;
    }).join();
  });
  return used;
}

TEST(Recursion, WithoutEndIsAnErrorWithinTheStack) {
  for (const char* script :
       {"proc f {} { f }; f", "proc f {args} { after 0 f; update }; f",
        "proc f {args} { lsort -command f {a b}; return 0 }; f", "proc f {args} { uplevel #0 { eval { f } } }; f",
        "proc f {} { expr {[f] + 1} }; f", "proc f {args} { regsub a a [f] }; f",
        "proc f {args} { namespace eval n { ::f } }; f", "proc f {args} { interp eval {} f }; f"}) {
    std::string text;
    const std::size_t used = used_stack(script, text);
    EXPECT_NE(text.find("too many nested evaluations"), std::string::npos) << script << ": " << text;
    EXPECT_LT(used, kernel::bytes(kernel::StackSize::program) / 2) << script;
  }
}

}  // namespace
}  // namespace waitpoint::tcl
