// SPDX-License-Identifier: BSD-3-Clause
// An inertial measurement unit in the plane: a gyro about the vertical, and accelerometers ahead, to the left and up.
//
// A sample is the mean over the time T since the last one, with the usual errors, independent on each axis:
//
//   reading = s truth + b + d + N n / sqrt(T)               white noise
//   b' = b + K sqrt(T) n        b ~ N(0, B)                 turn-on bias, and its random walk
//   d' = p d + D sqrt(1 - p^2) n,  p = e^(-T/tau)           first-order Gauss-Markov bias about 0
//
// so the angle integrated from the gyro has the variance
//
//   N^2 t + B^2 t^2 + K^2 t^3 / 3 + 2 D^2 tau (t - tau (1 - e^(-t/tau)))
//
// and the Allan variance over t is
//
//   N^2 / t + K^2 t / 3 + (2 D^2 tau / t) (1 - tau / (2 t) (3 - 4 e^(-t/tau) + e^(-2t/tau)))
//
// (IEEE Std 952, annexes B and C). Accelerometers measure the specific force, gravity included: at rest the upward one
// reads 9.81 m/s2.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "core/random.hpp"
#include "world/sensors/surroundings.hpp"
#include "world/sensors/types/imu.hpp"

namespace waitpoint::world {

class Imu::Model {
 public:
  /// Draws from the streams (seed, robot, "imu.gyro.noise"), likewise ".bias", ".walk" and ".drift", and those of
  /// "imu.ahead", "imu.left" and "imu.up", at tick = number of the sample.
  Model(const Description& description, std::uint64_t seed, std::string_view robot);

  /// Draws from the streams of this seed from now on; the biases go on from where they are.
  void reseed(std::uint64_t seed, std::string_view robot);

  /// Adds the body's motion in the step. With a period shorter than the step there is one sample per step.
  void moved(const StepDone& step, const BodyState& body);
  const Reading& reading() const { return sample_; }

 private:
  /// One axis: the integral of its quantity since the last sample, and its errors.
  class Axis {
   public:
    Axis(const InertialErrors& errors, std::uint64_t seed, std::string_view robot, const std::string& name);
    void reseed(std::uint64_t seed, std::string_view robot) { draws_ = Draws(seed, robot, name_); }
    void add(double of_step) { sum_ += of_step; }
    /// The reading over the last `elapsed_s`; resets the integral.
    double take(std::uint64_t number, double elapsed_s);

   private:
    struct Draws {
      RandomStream noise, walk, drift;

      Draws(std::uint64_t seed, std::string_view robot, const std::string& name);
    };

    InertialErrors errors_;
    std::string name_;
    Draws draws_;
    double bias_, wandered_, sum_ = 0;
  };

  Duration period_, summed_;
  Axis gyro_, ahead_, left_, up_;
  Velocity velocity_;  // at the end of the step before
  Reading sample_;
};

}  // namespace waitpoint::world
