// SPDX-License-Identifier: BSD-3-Clause
// Costs of many robots and many obstacles.
#pragma once

#include "tests/bench/world/figures.hpp"

namespace waitpoint::bench {

/// Contacts of 100 robots, in a step of 10 ms in the office.
void collisions_of_a_hundred(bool quick, Figures& figures);

/// Robots with one thread each, which go ahead if twelve rays are free and turn otherwise: the cost of a simulated
/// second of one among 1 000, 10 000 and 100 000, on proportionally larger grounds.
void simple_robots(bool quick, Figures& figures);

/// A scan among 10^3 to 10^6 obstacles on proportionally larger grounds.
void growing_grounds(bool quick, Figures& figures);

/// Stage's own benchmarks, unchanged: robots that wander by range finders, with all their threads.
void stages_cave(bool quick, Figures& figures);
void stages_hospital(bool quick, Figures& figures);

}  // namespace waitpoint::bench
