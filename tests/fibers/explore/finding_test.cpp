// SPDX-License-Identifier: BSD-3-Clause
// A failure as a finding for a page: both schedules, the pair of events in each, the words of the report.
#include <gtest/gtest.h>

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>

#include "fibers/explore/explore.hpp"
#include "fibers/explore/report/event_columns.hpp"
#include "fibers/sync/mutex.hpp"
#include "fibers/sync/thread.hpp"
#include "tests/fibers/text/contains.hpp"

namespace waitpoint {
namespace {

using Json = nlohmann::json;

struct FailureAsFinding {
  ExploreReport report;
  Json json;
};

FailureAsFinding finding_of(const std::function<void()>& body) {
  const std::filesystem::path file = std::filesystem::temp_directory_path() / ("finding-" + std::to_string(getpid()));
  setenv("WAITPOINT_FINDING", file.c_str(), 1);
  FailureAsFinding found{explore(body), {}};
  unsetenv("WAITPOINT_FINDING");
  std::ifstream in(file);
  found.json = Json::parse(in, nullptr, false);
  std::filesystem::remove(file);
  return found;
}

void lock_crosswise() {
  mutex left("left"), right("right");
  thread other({.name = "other"}, [&] {
    right.lock();
    left.lock();
    left.unlock();
    right.unlock();
  });
  left.lock();
  right.lock();
  right.unlock();
  left.unlock();
  other.join();
}

// "other lock left".
std::string event_text(const Json& schedule, const Json& header, std::size_t number) {
  const Json& events = schedule["events"];
  const std::size_t at = number - events["first"].get<std::size_t>();
  const Json& object = events["objects"][events["x"][at].get<std::size_t>()];
  return events["tasks"][events["k"][at].get<std::size_t>()][1].get<std::string>() + " " +
         header["operations"][events["o"][at].get<std::size_t>()].get<std::string>() + " " +
         object[2].get<std::string>();
}

TEST(Finding, HasTheFailingScheduleBesideThePassingOne) {
  const auto [report, json] = finding_of(lock_crosswise);
  ASSERT_FALSE(report.passed);
  ASSERT_TRUE(json.is_object());
  const Json& told = json["finding"];
  EXPECT_TRUE(contains(report.text, told["failure"].get<std::string>()));
  EXPECT_TRUE(contains(told["failure"].get<std::string>(), "deadlock"));
  EXPECT_TRUE(contains(told["replay"].get<std::string>(), report.replay));
  EXPECT_TRUE(contains(told["debug"].get<std::string>(), "waitpoint gdb -- "));
  EXPECT_EQ(told["report"], report.text);
  ASSERT_EQ(json["others"].size(), 1u);
  // The two locks of one mutex, in one order and in the other.
  const Json &fails = json["events"]["marked"], &passes = json["others"][0]["events"]["marked"];
  ASSERT_TRUE(fails[0].is_number() && passes[0].is_number() && passes[1].is_number()) << json;
  EXPECT_LT(passes[1], passes[0]);
  EXPECT_TRUE(fails[1].is_null() || fails[0] < fails[1]);
  const std::string first = event_text(json, json["header"], fails[0]),
                    second = event_text(json["others"][0], json["header"], passes[1]);
  EXPECT_TRUE(contains(first, " lock ")) << first;
  EXPECT_EQ(first.substr(first.find(' ')), second.substr(second.find(' ')));
  EXPECT_NE(first, second);
  for (const Json& mark : json["marks"]) {
    EXPECT_TRUE(contains(mark["words"].get<std::string>(), "about to lock")) << mark;
    EXPECT_TRUE(contains(mark["frames"].dump(), "finding_test.cpp")) << mark;
  }
  EXPECT_FALSE(json["events"]["waits"].empty()) << "tasks in a deadlock wait";
}

exploration::Timeline steps_of_one_task(std::uint64_t count) {
  exploration::Timeline timeline;
  timeline.tasks = {{.title = "a#1", .number = 1, .name = "a", .robot = "r"}};
  for (std::uint64_t i = 0; i < count; ++i)
    timeline.events.push_back({.time = Time(), .operation = kernel::Operation::yield, .which = {7, i}});
  return timeline;
}

TEST(Finding, ALongScheduleShowsThePartAboutTheMarkedEvent) {
  const exploration::EventOf marked[] = {{7, 60}, {8, 0}};
  const Json json = Json::parse(exploration::to_columns(steps_of_one_task(100), marked, 20));
  EXPECT_EQ(json["first"], 56);
  EXPECT_EQ(json["t"].size(), 20u);
  EXPECT_EQ(json["marked"], Json::parse("[61,null]"));
  EXPECT_EQ(json["complete"], false);
  const Json last = Json::parse(exploration::to_columns(steps_of_one_task(100), {}, 20));
  EXPECT_EQ(last["first"], 81) << "without a marked event the failure is shown";
}

TEST(Finding, TheMarkedEventIsThatOfTheFirstProcess) {
  exploration::Timeline timeline = steps_of_one_task(1);
  timeline.processes = {{1000, "sh"}, {1001, "sh"}};
  timeline.tasks.push_back({.title = "a#1", .process = 1, .number = 1, .name = "a", .robot = "r"});
  const exploration::TimelineEvent of_first = timeline.events[0];
  timeline.events[0].task = 1;  // a forked copy of the task, with events of the same numbers
  timeline.events.push_back(of_first);
  const exploration::EventOf marked[] = {of_first.which};
  const Json json = Json::parse(exploration::to_columns(timeline, marked));
  EXPECT_EQ(json["marked"], Json::parse("[2]"));
  EXPECT_EQ(json["tasks"][0][2], "sh 1000");
  EXPECT_EQ(json["tasks"][1][2], "sh 1001");
}

TEST(Finding, EventsOfOneInstantAreSetApartAndKeepTheirTime) {
  const Json json = Json::parse(exploration::to_columns(steps_of_one_task(3), {}));
  EXPECT_EQ(json["t"], Json::parse("[0,1,1]"));
  EXPECT_EQ(json["s"], Json::parse("[0,1,2]"));
}

TEST(Finding, AFileThatCannotBeWrittenIsRefusedBeforeTheFirstSchedule) {
  setenv("WAITPOINT_FINDING", "/nowhere/finding.json", 1);
  EXPECT_EXIT(explore(lock_crosswise), testing::ExitedWithCode(2), "WAITPOINT_FINDING.*a file that can be written");
  unsetenv("WAITPOINT_FINDING");
}

}  // namespace
}  // namespace waitpoint
