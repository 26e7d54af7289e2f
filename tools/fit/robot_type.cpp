// SPDX-License-Identifier: BSD-3-Clause
#include "tools/fit/robot_type.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/exact_math.hpp"
#include "core/number_text.hpp"
#include "core/printable_line.hpp"

namespace waitpoint::tools {
namespace {

constexpr double degree = exact::pi / 180;
constexpr double hundredth = 0.01;   // the last digit of numbers that scenarios require to be positive
constexpr double speed_least = 0.1;  // of a log in which the robot stands
constexpr double speed_most = 1e4;   // of scenarios

/// The limits of the odometry's fit.
std::vector<std::string> odometry_notes(const OdometryFit& of) {
  std::vector<std::string> notes;
  if (of.uncorrected > 0)
    notes.push_back(fmt::format("Not from {} over which the localisation only followed the odometry.",
                                counted(of.uncorrected, "stretch")));
  if (!of.turns_seen) notes.emplace_back("The log has too few turns to show their scale.");
  if (of.left_out * 4 > of.stretches)
    notes.emplace_back("More than a quarter are outliers: the localisation may have been lost (play --picture).");
  return notes;
}

std::string base_text(const RobotFit& fit) {
  const OdometryFit& of = fit.odometry;
  std::string text = fmt::format(
      "    # Greatest speeds in the log; its kind and accelerations are not in it.\n"
      "    base:\n      kind: synchro\n      v_max_m_s: {:.2f}\n      w_max_rad_s: {:.2f}\n",
      std::clamp(fit.v_max_m_s, speed_least, speed_most), std::clamp(fit.w_max_rad_s, speed_least, speed_most));
  text += fmt::format("      # From {} of 1 to 8 m, without {}.\n", counted(of.stretches - of.left_out, "stretch"),
                      counted(of.left_out, "outlier"));
  for (const std::string& note : odometry_notes(of)) text += "      # " + note + "\n";
  return text + fmt::format(
                    "      odometry:\n"
                    "        travel_scale: {:.4f}\n"
                    "        turn_scale: {:.4f}\n"
                    "        drift_rad_per_m: {:.5f}\n"
                    "        travel_noise_m_per_sqrt_m: {:.5f}\n"
                    "        turn_noise_rad_per_sqrt_m: {:.5f}\n"
                    "        turn_noise_rad_per_sqrt_rad: {:.5f}\n"
                    "        units_per_m: 103000\n"
                    "        units_per_rad: 35000\n",
                    of.travel_scale, of.turn_scale, of.drift_rad_per_m, of.travel_noise_m_per_sqrt_m,
                    of.turn_noise_rad_per_sqrt_m, of.turn_noise_rad_per_sqrt_rad);
}

std::string laser_text(const RobotFit& fit) {
  const LaserFit& of = fit.laser;
  std::string text = of.noise_pairs > 0
                         ? fmt::format("    # Noise from {} of readings at rest.\n", counted(of.noise_pairs, "pair"))
                         : "    # The robot never stands still in the log: the noise is that of a SICK LMS 200.\n";
  text += fmt::format("    # Times between scans deviate by {:.1f} ms; {} did not come.\n", of.jitter_s * 1e3,
                      counted(of.missing, "scan"));
  text +=
      fmt::format("    lasers:\n      - name: laser\n        mount: [{:.3f}, {:.3f}, {:.2f}]\n        height_m: 0.4\n",
                  fit.mount.x, fit.mount.y, fit.mount.heading / degree);
  if (of.stride > 1) text += fmt::format("        # One beam in {} of the log's.\n", of.stride);
  text += fmt::format("        beams: {}\n        field_of_view_deg: {:.2f}\n        range_max_m: {:.2f}\n", of.beams,
                      std::max(of.field_of_view_rad / degree, hundredth), std::max(of.range_max_m, hundredth));
  constexpr double of_lms = 0.005;
  text += fmt::format("        range_noise_m: {:.4f}\n", of.noise_pairs > 0 ? of.range_noise_m : of_lms);
  if (of.resolution_m > 0) text += fmt::format("        resolution_m: {:g}\n", of.resolution_m);
  if (of.dropout > 0) text += fmt::format("        dropout: {:.5f}\n", of.dropout);
  return text + fmt::format("        period_ms: {}\n", std::max(1LL, std::llround(of.period_s * 1e3)));
}

/// The base's module expects the errors that the base has: the systematic ones, too, which it does not know.
std::string module_text(const OdometryFit& of) {
  const auto variance = [](double noise, double systematic) {
    return exact::square(noise) + exact::square(systematic);
  };
  return fmt::format(
      "      - name: rflex\n"
      "        noise:\n"
      "          travel_variance_m2_per_m: {:.6f}\n"
      "          turn_variance_rad2_per_rad: {:.6f}\n"
      "          turn_variance_rad2_per_m: {:.6f}\n",
      variance(of.travel_noise_m_per_sqrt_m, of.travel_scale - 1),
      variance(of.turn_noise_rad_per_sqrt_rad, of.turn_scale - 1),
      variance(of.turn_noise_rad_per_sqrt_m, of.drift_rad_per_m));
}

}  // namespace

std::string robot_type_text(const RobotFit& fit) {
  std::string text = fmt::format("# Fitted by waitpoint fit {}\n", printable_line(fit.log));
  text += fmt::format("format: 1\ndescription: robot type {0}\n\nrobot_types:\n  {0}:\n", fit.name);
  text += "    # Not in the log.\n    shape: {radius_m: 0.26, height_m: 1.2}\n";
  text += base_text(fit) + laser_text(fit);
  return text + "    modules:\n" + module_text(fit.odometry) +
         "      - name: sick\n"
         "      - name: segloc\n"
         "      - name: pom\n"
         "      - name: ndd\n"
         "    bridge:\n"
         "      - {poster: rflex.command, device: base.command}\n"
         "      - {poster: rflex.reading, device: base.reading}\n"
         "      - {poster: sick.command, device: laser.command}\n"
         "      - {poster: sick.reading, device: laser.reading}\n";
}

}  // namespace waitpoint::tools
