// SPDX-License-Identifier: BSD-3-Clause
// Order by timing alone.
#include "tests/fibers/explore/timed_together.hpp"

namespace waitpoint::timed {
namespace {

// The laser's scan ends before the filter reads it.
void scan_before_filter(Times& times) {
  Flag scan{0};
  together(
      [&] {
        times.critical(20, 30, 60);
        scan.store(1);
      },
      [&] {
        times.spend(40, 50);
        check(scan.load() == 1, "the filter has no scan");
      });
}

// Three stages, each delayed against the previous one.
void pipeline_of_three(Times& times) {
  Flag segments{0}, pose{0};
  together(
      [&] {
        times.spend(10, 20);
        segments.store(1);
      },
      [&] {
        times.critical(30, 40, 90);
        pose.store(1 + segments.load());
      },
      [&] {
        times.spend(60, 70);
        check(pose.load() == 2, "the pose is from no segments");
      });
}

// The watchdog checks after the heartbeats.
void heartbeat(Times& times) {
  Flag beats{0};
  together(
      [&] {
        for (int i = 0; i < 3; ++i) {
          times.critical(8, 10, 16);
          beats.fetch_add(1);
        }
      },
      [&] {
        times.spend(35, 40);
        check(beats.load() == 3, "the watchdog bites");
      });
}

// Stop comes after the last message.
void stop_after_the_last(Times& times) {
  Flag messages{0}, stopped{0};
  together(
      [&] {
        for (int i = 0; i < 2; ++i) {
          times.critical(10, 15, 30);
          check(stopped.load() == 0, "sent after the stop");
          messages.fetch_add(1);
        }
      },
      [&] {
        times.spend(40, 45);
        stopped.store(1);
      });
}

// The motor is on before the brake is off.
void motor_before_brake(Times& times) {
  Flag motor{0}, brake{1};
  together(
      [&] {
        times.critical(5, 10, 30);
        motor.store(1);
      },
      [&] {
        times.spend(20, 25);
        brake.store(0);
        check(motor.load() == 1, "the arm falls");
      });
}

// Four initialisers, each later than its dependency.
void initialisation_chain(Times& times) {
  Flag clock{0}, bus{0}, base{0};
  together(
      [&] {
        times.spend(5, 8);
        clock.store(1);
      },
      [&] {
        times.spend(12, 16);
        check(clock.load() == 1, "no clock");
        bus.store(1);
      },
      [&] {
        times.critical(20, 24, 40);
        base.store(bus.load());
      },
      [&] {
        times.spend(30, 36);
        check(base.load() == 1, "no base");
      });
}

// The timeout is longer than the response time.
void answer_in_time(Times& times) {
  Flag answered{0}, given_up{0};
  together(
      [&] {
        times.critical(20, 40, 70);
        answered.store(1);
        check(given_up.load() == 0, "nobody waits any more");
      },
      [&] {
        times.spend(50, 60);
        if (answered.load() == 0) given_up.store(1);
      });
}

// The map is saved after the last of three updates.
void save_after_updates(Times& times) {
  Flag updates{0};
  const auto update = [&](int from, int to) {
    times.spend(from, to);
    updates.fetch_add(1);
  };
  together([&] { update(5, 10); }, [&] { update(10, 15); },
           [&] {
             times.critical(15, 20, 50);
             updates.fetch_add(1);
           },
           [&] {
             times.spend(30, 40);
             check(updates.load() == 3, "the map misses an update");
           });
}

// Late data is dropped by its date; the earlier one is in time.
void dates_ascend(Times& times) {
  Flag last{0};
  together(
      [&] {
        times.critical(10, 20, 50);
        check(last.exchange(1) < 1, "an old date after a new one");
      },
      [&] {
        times.spend(30, 40);
        check(last.exchange(2) < 2, "a date twice");
      });
}

// The slower of two sensors is fused with the newest of the faster.
void fusion(Times& times) {
  Flag gyro{0}, odometry{0};
  together(
      [&] {
        for (int i = 1; i <= 3; ++i) {
          times.spend(6, 7);
          gyro.store(i);
        }
      },
      [&] {
        times.critical(22, 25, 40);
        odometry.store(gyro.load());
      },
      [&] {
        times.spend(30, 32);
        check(odometry.load() == 3, "fused with an old one");
      });
}

}  // namespace

const std::vector<Program> orders = {
    {"scan_before_filter", scan_before_filter},
    {"pipeline_of_three", pipeline_of_three},
    {"heartbeat", heartbeat},
    {"stop_after_the_last", stop_after_the_last},
    {"motor_before_brake", motor_before_brake},
    {"initialisation_chain", initialisation_chain},
    {"answer_in_time", answer_in_time},
    {"save_after_updates", save_after_updates},
    {"dates_ascend", dates_ascend},
    {"fusion", fusion},
};

}  // namespace waitpoint::timed
