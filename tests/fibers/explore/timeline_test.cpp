// SPDX-License-Identifier: BSD-3-Clause
// The actions of each task, as a trace with spans in virtual time, and as text with repetitions counted.
#include <gtest/gtest.h>

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <regex>
#include <sstream>
#include <string>

#include "fibers/explore/explore.hpp"
#include "fibers/explore/report/timeline.hpp"
#include "fibers/sync/atomic.hpp"
#include "fibers/sync/mutex.hpp"
#include "fibers/sync/semaphore.hpp"
#include "fibers/sync/thread.hpp"
#include "tests/fibers/text/contains.hpp"

namespace waitpoint {
namespace {

using namespace std::chrono_literals;

// The trace of a failure, as requested by the environment.
std::string trace_of(const std::function<void()>& body) {
  const std::filesystem::path file = std::filesystem::temp_directory_path() / ("trace-" + std::to_string(getpid()));
  setenv("WAITPOINT_TRACE", file.c_str(), 1);
  const ExploreReport report = explore(body, {.strategy = "fifo"});
  unsetenv("WAITPOINT_TRACE");
  EXPECT_FALSE(report.passed);
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  std::filesystem::remove(file);
  return text.str();
}

// The length in microseconds of the slice with that title, as in the trace; -1 if there is none.
double length_us(const std::string& trace, const std::string& title) {
  const std::size_t slice = trace.find("\"name\":\"" + title);
  if (slice == std::string::npos) return -1;
  return std::stod(trace.substr(trace.find("\"dur\":", slice) + 6));
}

TEST(Timeline, ATraceShowsHowLongTasksComputeSleepAndWait) {
  const std::string trace = trace_of([] {
    mutex door("door");
    binary_semaphore never(0, "never");
    thread computing({.name = "computing"}, [&] {
      const std::lock_guard guard(door);
      compute(90ms);
    });
    thread waiting({.name = "waiting"}, [&] {
      this_thread::sleep_for(10ms);
      const std::lock_guard guard(door);
    });
    thread stuck({.name = "stuck"}, [&] { never.acquire(); });
    thread late({.name = "late"}, [] { this_thread::sleep_for(500ms); });
    for (thread* each : {&computing, &waiting, &late, &stuck}) each->join();
  });
  ASSERT_TRUE(contains(trace, "traceEvents"));
  constexpr double about = 0.1;  // events of one instant are a nanosecond apart
  EXPECT_NEAR(length_us(trace, "computing\",\"cat"), 90'000, about) << trace;
  EXPECT_NEAR(length_us(trace, "sleeping"), 10'000, about) << trace;
  EXPECT_NEAR(length_us(trace, "waiting for mutex #2 \\\"door"), 80'000, about) << trace;
  EXPECT_NEAR(length_us(trace, "waiting for semaphore #3 \\\"never"), 500'000, about) << trace;  // to the end
}

TEST(Timeline, ATraceShowsTasksBelowTheirProcesses) {
  exploration::Timeline timeline;
  timeline.processes = {{1000, "sh"}, {1001, "cat#1001"}};
  timeline.tasks = {{"main#0 of sh"}, {"main#0 of cat#1001", 1}};
  for (const std::uint32_t task : {0u, 1u}) timeline.events.push_back({.time = Time(), .task = task});
  std::ostringstream trace;
  write_trace(trace, timeline);
  for (const char* const part :
       {"\"process_name\",\"pid\":1000,\"args\":{\"name\":\"sh\"}}", "\"pid\":1001,\"args\":{\"name\":\"cat#1001\"}}",
        "\"thread_name\",\"pid\":1001,\"tid\":2,\"args\":{\"name\":\"main#0 of cat#1001\"}}",
        "\"ts\":0.001,\"dur\":0.001,\"pid\":1001,\"tid\":2}"})
    EXPECT_TRUE(contains(trace.str(), part)) << part << "\n" << trace.str();
}

TEST(Timeline, ALivelockIsToldInFewLines) {
  const ExploreReport report = explore([] {
    atomic<bool> never{false};
    thread other([&] {
      while (!never.load()) {
      }
    });
    while (!never.load()) {
    }
  });
  ASSERT_TRUE(contains(report.text, "no progress")) << report;
  EXPECT_TRUE(std::regex_search(report.text, std::regex("\\.\\.\\. \\d+ lines repeated \\d{2,} times\n"))) << report;
}

TEST(Timeline, RepetitionsArePrintedOnceWithACount) {
  using kernel::Operation;
  exploration::Timeline timeline;
  timeline.tasks = {{"a#1"}};
  timeline.objects = {{.title = "atomic #1"}, {.title = "atomic #2"}};
  const auto add = [&](Operation operation, std::int32_t object) {
    timeline.events.push_back({.operation = operation, .object = object});
  };
  add(Operation::start, -1);
  for (int i = 0; i < 20; ++i) {
    add(Operation::load, 0);
    add(Operation::load, 1);
  }
  add(Operation::end, -1);
  EXPECT_EQ(to_text(timeline, 40),
            "  0.000000000   a#1  start\n  0.000000000   a#1  load atomic #1\n  0.000000000   a#1  load atomic #2\n"
            "      ... 2 lines repeated 19 times\n  0.000000000   a#1  end\n");
  EXPECT_EQ(to_text(timeline, 1), "  ... 4 earlier lines\n  0.000000000   a#1  end\n");
}

TEST(Timeline, NestedRepetitionsArePrintedOnce) {
  using kernel::Operation;
  exploration::Timeline timeline;
  timeline.tasks = {{"a#1"}, {"b#2"}};
  const auto add = [&](std::uint32_t task, Operation operation, int times) {
    for (int i = 0; i < times; ++i) timeline.events.push_back({.task = task, .operation = operation});
  };
  for (int long_turn = 0; long_turn < 5; ++long_turn) {
    for (int turn = 0; turn < 6; ++turn) {
      add(0, Operation::load, 6);
      add(1, Operation::load, 1);
    }
    add(1, Operation::yield, 1);
  }
  EXPECT_EQ(to_text(timeline, 40),
            "  0.000000000   a#1  load\n      ... repeated 5 times\n  0.000000000   b#2  load\n"
            "      ... 3 lines repeated 5 times\n  0.000000000   b#2  yield\n"
            "      ... 5 lines repeated 4 times\n");
}

}  // namespace
}  // namespace waitpoint
