// SPDX-License-Identifier: BSD-3-Clause
// Scripts as clients of a module.
#include <gtest/gtest.h>

#include "tests/modules/tcl/scripted_robot.hpp"

namespace waitpoint::tcl {
namespace {

std::string result(const std::string& script) {
  ScriptedRobot robot;
  const ScriptEnd outcome = robot.run("connect; lm m; " + script);
  return (outcome.ok ? "" : "error: ") + outcome.text;
}

TEST(Request, GivesItsOutputAsADictionary) { EXPECT_EQ(result("m::Double 21"), "value 42"); }

TEST(Request, TakesItsInputByPlaceByNameAndAsDictionaries) {
  const std::string echo = "via {{x 1 y 2} {x 3 y 4}} speed_m_s 0.5 patience_ms 30";
  EXPECT_EQ(result("m::Echo {{1 2} {3 4}} 0.5 30"), echo);
  EXPECT_EQ(result("m::Echo {{x 1 y 2} {y 4 x 3}} patience_ms=30 speed_m_s=0.5"), echo);
  EXPECT_EQ(result("m::Echo via.0.x=1 via.0.y=2 {via.1=3 4} speed_m_s=0.5 patience_ms=30"), echo);
  EXPECT_EQ(result("m::Echo"), "via {} speed_m_s 1 patience_ms 20");
}

TEST(Request, RefusesInputThatDoesNotFit) {
  EXPECT_EQ(result("m::Double 1 2"), "error: expected at most 1 arguments, found '2'");
  EXPECT_TRUE(result("m::Double valu=1").ends_with("did you mean 'value'?")) << result("m::Double valu=1");
  EXPECT_TRUE(result("m::Double many").starts_with("error: m::Double: ")) << result("m::Double many");
  EXPECT_EQ(result("m::Echo {{1 2 3}}"), "error: expected at most 2 values for 'via.0', found 3");
  EXPECT_EQ(result("lm n"), "error: there is no module 'n'");
}

TEST(Request, BlocksTheScriptForItsVirtualTime) {
  EXPECT_EQ(result("set begin [clock milliseconds]; m::Count 5; "
                   "expr {([clock milliseconds] - $begin) in {40 50 60}}"),
            "1");
}

TEST(Request, FailureIsAnErrorWithItsReport) {
  EXPECT_EQ(result("catch {m::Count 13} message; list $message $::errorCode"),
            "{m::Count: own report 107} {WAITPOINT REPORT m::Count {own report 107}}");
}

TEST(Request, CallsBackInVwait) {
  EXPECT_EQ(result("proc cb {what id report output} { set ::done [list $what $report $output] }; "
                   "m::Count -ack {cb there} 3; m::Double 1; set early [info exists done]; vwait done; "
                   "list $early $done"),
            "0 {there ok {value 3}}");
}

TEST(Request, IsAwaitedWithATimeout) {
  EXPECT_EQ(result("set id [m::Count -async 50]; catch {wait -timeout 100 $id}; set a $::errorCode; "
                   "set b [state $id]; list $a $b [wait $id]"),
            "{WAITPOINT TIMEOUT} running {value 50}");
}

TEST(Request, IsAborted) {
  EXPECT_EQ(result("set id [m::Count -async -1]; after 30; abort $id; catch {wait $id} message; set message"),
            "m::Count: ACTIVITY_INTERRUPTED");
}

TEST(Request, IsForgottenWithItsEnd) {
  EXPECT_EQ(result("set id [m::Double -async 1]; wait $id; wait $id"),
            "error: there is no request 'm::Double#1', or its end has been told");
}

TEST(Poster, IsReadAsADictionary) {
  EXPECT_EQ(result("after 50; dict get [m::PosterRead count] value"), "7");
  EXPECT_EQ(result("m::PosterRead cunt"), "error: there is no poster 'm.cunt', did you mean 'count'?");
}

}  // namespace
}  // namespace waitpoint::tcl
