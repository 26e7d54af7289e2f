// SPDX-License-Identifier: BSD-3-Clause
// Ranges of valid numbers, with the phrases that messages and schemas describe them by.
#pragma once

#include <cstdint>
#include <string_view>

namespace waitpoint {

inline constexpr double least_nonzero = 1e-12;

/// A range of valid numbers, and its description in messages. Numbers nearer to 0 than `least`, but not 0, are not
/// valid either: quotients by them would leave the range of integers.
struct NumberRange {
  double low, high;         ///< inclusive
  std::string_view phrase;  ///< "a positive number"
  double least = least_nonzero;
};

/// Whole numbers, inclusive.
struct CountRange {
  std::uint64_t low, high;
};

/// The ranges that several keys have.
namespace ranges {

inline constexpr NumberRange positive_number{least_nonzero, 1e9, "a positive number"};
inline constexpr NumberRange number_from_zero{0, 1e9, "a number that is not negative"};
/// Of times in seconds that are not durations of the simulation, such as time constants.
inline constexpr NumberRange time_constant{1e-3, 1e9, "a number of seconds from 0.001 to 1e9"};
inline constexpr NumberRange length{1e-4, 1e5, "a length from 0.0001 to 100000 m"};
/// Of the places of devices on bodies, and of the ends of bodies.
inline constexpr NumberRange height{0, 1e5, "a height from 0 to 100000 m"};
inline constexpr NumberRange coordinate{-1e5, 1e5, "a coordinate within 100 km"};
/// Of errors and noises of angles: within the headings that the simulation can stand, after any way.
inline constexpr NumberRange angle_error{0, 10, "a number of rad from 0 to 10"};
inline constexpr NumberRange signed_angle_error{-10, 10, "a number of rad from -10 to 10"};
/// Of errors and noises of places.
inline constexpr NumberRange length_error{0, 1e5, "a number of metres from 0 to 100000"};
/// Of the steps in which readings are rounded: 0 for none.
inline constexpr NumberRange resolution{0, 1e3, "0, or a resolution from 0.000001 to 1000", 1e-6};
/// The same where there always is one.
inline constexpr NumberRange resolution_step{1e-6, 1e3, "a resolution from 0.000001 to 1000"};
inline constexpr NumberRange factor{1e-3, 1e3, "a factor from 0.001 to 1000"};
/// Of speeds, accelerations and the errors of sensors for them.
inline constexpr NumberRange rate{least_nonzero, 1e4, "a positive number up to 10000"};
inline constexpr NumberRange acceleration{1e-6, 1e6, "an acceleration from 0.000001 to 1000000"};
/// Of the units of an encoder for a metre or a radian.
inline constexpr NumberRange units{1e-3, 1e9, "a number of units from 0.001 to 1e9"};
inline constexpr NumberRange rate_error{0, 1e3, "a number from 0 to 1000"};
inline constexpr NumberRange probability{0, 1, "a probability from 0 to 1"};

}  // namespace ranges
}  // namespace waitpoint
