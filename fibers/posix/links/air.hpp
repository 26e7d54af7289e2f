// SPDX-License-Identifier: BSD-3-Clause
// Messages between the processes of a family that are parts of robots: they go over a medium, as those of the robots'
// own tasks do (fibers/io/medium.hpp), or, within a robot, take a fixed delay.
//
// The family shares the declaration, the robots' places and the state of each link. Processes learn from the
// environment of which robot they are; those of none, as the world and the master, are of robot 0.
//
//   write() --> on the air, an event of the sender --> written into the socket, the receiver is rung
//
// Connections are made at once; what is sent over them takes time. A lost piece of a stream is sent again, as by TCP,
// and those behind it wait for it. A process that ends by itself leaves nothing on the air: it arrives then.
#pragma once

#include <cstdint>

#include "core/time.hpp"

namespace waitpoint::posix {

/// The environment variable with the number of a process's robot, from 1 on.
inline constexpr char robot_variable[] = "WAITPOINT_ROBOT";

/// Plain values in the family's memory, all zero at first.
struct Air {
  static constexpr int robots_max = 64;  ///< with robot 0
  static constexpr char symbol[] = "waitpoint_air";
  using Take = Air* (*)();

  /// As in io::Medium. 0: unlimited.
  struct Medium {
    Duration latency_least, latency_most, latency_per_metre, range_check;
    std::uint64_t bandwidth_bit_s = 0, queue_bytes = 0;
    double range_m = 0, loss = 0;
  };
  struct Robot {
    char name[64] = {};
    double x_m = 0, y_m = 0;
  };
  /// From one robot to another.
  struct Link {
    std::uint64_t number = 0;  ///< messages so far
    Time free_at;              ///< when the last bit of all is transmitted
    std::uint64_t lost = 0, sent_again = 0;
  };

  bool has_medium = false;  ///< else messages between robots are at once
  Medium medium;
  Duration delay;  ///< within a robot, and between it and the world
  Robot robots[robots_max];
  Link links[robots_max][robots_max];
  std::uint8_t owners[65536] = {};  ///< robots, by port of the internet sockets of their processes
};

/// Before the process's program: its messages go over the air from now on, if the run has one.
void begin_air();

}  // namespace waitpoint::posix
