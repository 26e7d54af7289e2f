// SPDX-License-Identifier: BSD-3-Clause
// Mutual exclusion by timing alone.
#include "fibers/sync/mutex.hpp"
#include "tests/fibers/explore/timed_together.hpp"

namespace waitpoint::timed {
namespace {

// A pose is written in two steps, and read at another time.
void torn_pose(Times& times) {
  Flag x{0}, y{0};
  together(
      [&] {
        x.store(1);
        times.critical(5, 10, 40);
        y.store(1);
      },
      [&] {
        times.spend(20, 30);
        const int seen = x.load();
        check(seen == y.load(), "half a pose");
      });
}

// Two uses of one command: the fast one has ended when the command is replaced.
void command_replaced(Times& times) {
  Flag command{1};
  together(
      [&] {
        times.critical(10, 20, 45);
        check(command.load() == 1, "the first command is lost");
      },
      [&] {
        times.spend(30, 40);
        command.store(2);
      });
}

// Check, then act, too quickly for another task to intervene.
void check_then_act(Times& times) {
  Flag owner{0}, owners{0};
  const auto take = [&](int from, int to, bool critical) {
    times.spend(from, to);
    if (owner.load() != 0) return;
    critical ? times.critical(1, 2, 30) : times.spend(1, 2);
    owner.store(1);
    check(owners.fetch_add(1) == 0, "two owners");
  };
  together([&] { take(10, 12, true); }, [&] { take(20, 22, false); });
}

// Read, compute, write: the other task comes much later.
void lost_odometry(Times& times) {
  Flag distance{0};
  together(
      [&] {
        const int seen = distance.load();
        times.critical(3, 5, 25);
        distance.store(seen + 1);
      },
      [&] {
        times.spend(15, 20);
        distance.fetch_add(1);
      });
  check(distance.load() == 2, "a step is lost");
}

// A double buffer: while one half is filled, the other is read.
void double_buffer(Times& times) {
  std::array<Flag, 2> half{};
  together(
      [&] {
        for (int i = 0; i < 4; ++i) {
          times.spend(18, 20);
          half[static_cast<std::size_t>(i % 2)].store(i);
        }
      },
      [&] {
        times.spend(45, 47);  // the second value is in, the third comes at 54 at the earliest
        const int first = half[0].load();
        times.critical(4, 6, 20);
        check(half[0].load() == first, "overwritten while it was read");
      });
}

// Two robots pass one door, at different times.
void door_in_turns(Times& times) {
  Flag inside{0};
  const auto pass = [&](int from, int to, bool critical) {
    times.spend(from, to);
    check(inside.fetch_add(1) == 0, "two in the door");
    critical ? times.critical(5, 8, 30) : times.spend(5, 8);
    inside.fetch_sub(1);
  };
  together(
      [&] {
        pass(10, 12, true);
        pass(40, 42, false);
      },
      [&] { pass(30, 33, false); });
}

// A sequence number is odd only at times without readers.
void sequence_lock(Times& times) {
  Flag sequence{0};
  together(
      [&] {
        times.spend(10, 11);
        sequence.fetch_add(1);
        times.critical(2, 4, 25);
        sequence.fetch_add(1);
      },
      [&] {
        times.spend(20, 24);
        check(sequence.load() % 2 == 0, "caught in the middle");
      });
}

// Two locks in opposite orders, at different times.
void opposite_locks(Times& times) {
  mutex left, right;
  together(
      [&] {
        const std::lock_guard a(left);
        times.critical(2, 4, 30);
        const std::lock_guard b(right);
      },
      [&] {
        times.spend(10, 20);
        const std::lock_guard b(right);
        times.spend(2, 4);
        const std::lock_guard a(left);
      });
}

// The buffer is returned after its reader has finished.
void returned_too_early(Times& times) {
  Flag in_use{1};
  together(
      [&] {
        for (int i = 0; i < 2; ++i) {
          times.critical(5, 9, 20);
          check(in_use.load() == 1, "read after it was returned");
        }
      },
      [&] {
        times.spend(25, 30);
        in_use.store(0);
      });
}

// The second request comes after the first has been served, so no queue is needed.
void one_request_at_a_time(Times& times) {
  Flag busy{0};
  const auto serve = [&](bool critical) {
    check(busy.exchange(1) == 0, "a request while another is served");
    critical ? times.critical(10, 15, 40) : times.spend(10, 15);
    busy.store(0);
  };
  together([&] { serve(true); },
           [&] {
             times.spend(20, 30);
             serve(false);
           });
}

}  // namespace

const std::vector<Program> exclusions = {
    {"torn_pose", torn_pose},
    {"command_replaced", command_replaced},
    {"check_then_act", check_then_act},
    {"lost_odometry", lost_odometry},
    {"double_buffer", double_buffer},
    {"door_in_turns", door_in_turns},
    {"sequence_lock", sequence_lock},
    {"opposite_locks", opposite_locks},
    {"returned_too_early", returned_too_early},
    {"one_request_at_a_time", one_request_at_a_time},
};

}  // namespace waitpoint::timed
