// SPDX-License-Identifier: BSD-3-Clause
// The models of the sensors that are read alone (types/sensors.hpp). A model is made of
//
//   Model(const Description&, seed, robot)   draws from random streams of this seed and robot
//   reseed(seed, robot)                      draws from the streams of this seed from now on; biases and drifts go on
//   read(surroundings, number, reading)      on demand: fills the reading, with the noise drawn at `number`
//
// or, in the place of read(), for a sensor that measures in every step of the world,
//
//   moved(step, body)                        the body has done a step, to this state
//   reading()                                the last one, number 0 before the first
#pragma once

#include "world/sensors/bumpers.hpp"
#include "world/sensors/gps.hpp"
#include "world/sensors/imu.hpp"
#include "world/sensors/infrareds.hpp"
#include "world/sensors/optical_flow.hpp"
