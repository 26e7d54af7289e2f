// SPDX-License-Identifier: BSD-3-Clause
// What many robots cost, and many obstacles.
#pragma once

#include "tests/bench/world/figures.hpp"

namespace waitpoint::bench {

/// Who of 100 robots touches whom or what, in a step of 10 ms in the office.
void collisions_of_a_hundred(bool quick, Figures& figures);

/// Robots of one thread each, that go ahead where twelve rays find nothing and else turn: what a simulated second of
/// one costs among 1 000, 10 000 and 100 000 on so much larger grounds.
void simple_robots(bool quick, Figures& figures);

/// A scan among 10^3 to 10^6 obstacles on so much larger grounds.
void growing_grounds(bool quick, Figures& figures);

/// Stage's own benchmarks, unchanged: robots that wander by their range finders, with all their threads.
void stages_cave(bool quick, Figures& figures);
void stages_hospital(bool quick, Figures& figures);

}  // namespace waitpoint::bench
