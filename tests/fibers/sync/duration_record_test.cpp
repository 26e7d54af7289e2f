// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/sync/duration_record.hpp"

#include <gtest/gtest.h>

#include "fibers/sync/threads.hpp"
#include "tests/fibers/sync/orders.hpp"

namespace waitpoint {
namespace {

using namespace std::chrono_literals;
using kernel::ClockKind;

// Threads whose order depends on measured and chosen costs.
void spawn_racing_threads(Simulation& simulation, int rounds = 20) {
  for (const char* robot : {"r0", "r1"})
    simulation.spawn(simulation.add_robot(robot), {.name = "main"}, [rounds] {
      mutex turn;
      std::string order;
      std::vector<thread> threads;
      for (const ClockKind kind : {ClockKind::cpu, ClockKind::proportional, ClockKind::interval, ClockKind::fixed})
        threads.emplace_back(thread_attributes{.name = "racer", .clock = {.kind = kind}}, [&, kind] {
          for (int i = 0; i < rounds; ++i) {
            std::lock_guard lock(turn);
            order += static_cast<char>('a' + static_cast<int>(kind));
            for (int k = 0; k < 100 * (i % 4); ++k) asm volatile("");
            compute(Duration::from_ns(50), Duration::from_ns(1000));
          }
        });
      for (thread& t : threads) t.join();
    });
}

struct Recorded {
  std::string digest;
  DurationRecord record;
};

Recorded record_run(const SimulationOptions& options, int rounds = 20) {
  Simulation simulation(options);
  DurationRecorder recorder(simulation, "racing");
  spawn_racing_threads(simulation, rounds);
  EXPECT_EQ(simulation.run_before(), RunEnd::ended);
  return {to_string(simulation.digest()), recorder.record()};
}

TEST(DurationRecord, MeasuredRunsReplayFromTheirRecordToTheSameDigest) {
  for (std::uint64_t number = 0; number <= 5; ++number) {
    const Recorded recorded = record_run(order_number(number));
    EXPECT_GT(recorded.record.entries.size(), 100u);
    EXPECT_NE(record_run(order_number(number)).digest, recorded.digest);  // two measurements never agree
    const DurationRecord read = parse_duration_record("file", to_text(recorded.record));
    EXPECT_EQ(read, recorded.record);
    for (int repeat = 0; repeat < 2; ++repeat) {
      Simulation simulation(order_number(number));
      DurationReplay replay(simulation, read, "racing", "file");
      spawn_racing_threads(simulation);
      // Also in windows.
      for (Time until; simulation.run_before(until) == RunEnd::time_reached; until += 1us)
        ASSERT_LT(until, Time() + 10s);
      EXPECT_EQ(to_string(simulation.digest()), recorded.digest);
      EXPECT_NO_THROW(replay.check_used_up());
    }
  }
}

std::string error_of(const std::function<void()>& body) {
  try {
    body();
  } catch (const BadInput& error) {
    return error.what();
  }
  return "no error";
}

std::string error_of_replay(const DurationRecord& record, int rounds, const SimulationOptions& options = {}) {
  return error_of([&] {
    Simulation simulation(options);
    DurationReplay replay(simulation, record, "racing", "the file");
    spawn_racing_threads(simulation, rounds);
    simulation.run_before();
    replay.check_used_up();
  });
}

TEST(DurationRecord, OneOfAnotherRunIsANamedError) {
  const DurationRecord record = record_run({}).record;
  const std::string size = std::to_string(record.entries.size());
  EXPECT_EQ(error_of_replay(record, 20), "no error");
  EXPECT_EQ(error_of([&] {
              Simulation simulation;
              DurationReplay(simulation, record, "walking", "the file");
            }),
            "the file:2: the record of durations is of run 'racing', but this is 'walking'");
  EXPECT_NE(error_of_replay(record, 21).find("the file: the record of durations "), std::string::npos);
  EXPECT_NE(error_of_replay(record, 19).find("belongs to another run"), std::string::npos);
  DurationRecord cut = record;
  cut.entries.pop_back();
  EXPECT_NE(error_of_replay(cut, 20).find("ends early: the run continues after its " +
                                          std::to_string(cut.entries.size()) + " durations, at "),
            std::string::npos)
      << error_of_replay(cut, 20);
  cut.cut_off = "the process dies";
  EXPECT_EQ(parse_duration_record("f", to_text(cut)), cut);
  EXPECT_NE(error_of_replay(cut, 20).find(" durations, as its own was cut off: the process dies, at "),
            std::string::npos)
      << error_of_replay(cut, 20);
  DurationRecord moved = record;
  for (std::size_t i = 0; i + 1 < moved.entries.size(); ++i)
    if (moved.entries[i].task != moved.entries[i + 1].task) {
      std::swap(moved.entries[i], moved.entries[i + 1]);
      EXPECT_NE(error_of_replay(moved, 20).find("belongs to another run: its duration " + std::to_string(i + 1)),
                std::string::npos);
      break;
    }
}

TEST(DurationRecord, ATextThatIsNoneIsRefusedWithItsLine) {
  const std::string good = "waitpoint durations 1\nrun racing\ntask 1 1f r.t\n1 5\ntask 2 2f r.u\n2 7\n1 0\nend 3\n";
  EXPECT_EQ(to_text(parse_duration_record("f", good)), good);
  const auto error = [&](const std::string& old_part, const std::string& new_part) {
    std::string text = good;
    text.replace(text.find(old_part), old_part.size(), new_part);
    return error_of([&] { parse_duration_record("f", text); });
  };
  EXPECT_EQ(error(good, ""), "f:1: the record of durations ends early: expected its last line, 'end' and a number");
  EXPECT_EQ(error(good, "something\n"), "f:1: expected a record of durations, 'waitpoint durations 1'");
  EXPECT_EQ(error("durations 1", "durations 2"), "f:1: expected a record of durations, 'waitpoint durations 1'");
  EXPECT_EQ(error("run racing\n", "ran\n"), "f:2: expected 'run' and the run of the record");
  EXPECT_EQ(error("end 3\n", ""),
            "f:8: the record of durations ends early: expected its last line, 'end' and a number");
  EXPECT_EQ(error("1 0\nend 3\n", "1 "), "f:7: expected a task and its duration, found '1 '");
  EXPECT_EQ(error("end 3\n", "end 3\n1 0\n"), "f:9: expected nothing after 'end' but '# cut off: ' and a reason");
  EXPECT_EQ(error("end 3", "end 4"), "f:8: the record says that it has 4 durations, but 3 are there");
  for (const char* bad : {"3 7", "0 7", "2 -7", "2 7 7", "2", "", "2 x", "task 2 2f", "task 4 2f r.u", "task 2 xx r.u"})
    EXPECT_NE(error("2 7", bad).find("f:6: expected a task and its duration"), std::string::npos) << bad;
}

}  // namespace
}  // namespace waitpoint
