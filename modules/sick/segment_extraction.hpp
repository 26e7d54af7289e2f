// SPDX-License-Identifier: BSD-3-Clause
// Straight segments of aligned echoes, found in a laser scan by split and merge.
//
//   echoes ──break──> regions ──split──> runs ──merge──> runs ──fit──> segments
//
//   break   at missing beams, or at a jump in range that a wall at the flattest grazing angle does not explain
//   split   a run at the echo farthest (Mahalanobis) from its chord, recursively, until none exceeds the chi2 bound
//   merge   neighbouring runs explained by one line
//   fit     total least squares; the covariance follows from each echo's range and bearing noise, scaled up if the
//           echoes scatter more, plus the effect of a range bias common to all echoes
//
// Sources: Nguyen, Martinelli, Tomatis, Siegwart, "A comparison of line extraction algorithms using 2D laser
// rangefinder for indoor mobile robotics", IROS 2005; Borges, Aldon, "Line extraction in 2D range images", 2004
// (break).
#pragma once

#include <array>
#include <cstdint>

#include "core/error.hpp"
#include "modules/posters/laser.hpp"

namespace waitpoint::sick {

/// Defaults for a SICK LMS indoors.
struct SegmentExtractionParameters {
  double range_noise_m = 0.005;
  double range_noise_near_m = 8;
  double range_noise_growth_m_per_m = 0.0004;
  double range_resolution_m = 0.01;
  double range_bias_m = 0.004;
  double bearing_noise_rad = 0.001;
  double roughness_m = 0.013;
  double range_min_m = 0.05;
  double beam_gap_rad_max = 0.035;
  double grazing_angle_rad = 0.12;
  double jump_m_min = 0.1;
  double chi2_split = 9.0;
  double merge_gap_m_max = 0.4;
  double bow_m_max = 0.012;
  std::uint32_t points_min = 6;
  double length_m_min = 0.4;

  static void fields(auto field) {
    using P = SegmentExtractionParameters;
    constexpr NumberRange positive_length{least_nonzero, 1e5, "a positive length"};
    field("range_noise_m", &P::range_noise_m, positive_length,
          "standard deviation up to range_noise_near_m, then growing linearly");
    field("range_noise_near_m", &P::range_noise_near_m, "range up to which the noise is constant");
    field("range_noise_growth_m_per_m", &P::range_noise_growth_m_per_m, "growth beyond range_noise_near_m");
    field("range_resolution_m", &P::range_resolution_m, "quantisation, a uniform error");
    field("range_bias_m", &P::range_bias_m, "standard deviation of the error shared by all echoes of a scan");
    field("bearing_noise_rad", &P::bearing_noise_rad, "standard deviation of a beam's direction");
    field("roughness_m", &P::roughness_m,
          "standard deviation of a wall about its line: plaster, cells of a raster map");
    field("range_min_m", &P::range_min_m, "nearer echoes are of the robot itself");
    field("beam_gap_rad_max", &P::beam_gap_rad_max, "between the beams of neighbouring echoes");
    field("grazing_angle_rad", &P::grazing_angle_rad, "flattest angle between beam and wall");
    field("jump_m_min", &P::jump_m_min, "a smaller range jump never breaks");
    field("chi2_split", &P::chi2_split, "squared Mahalanobis distance of the farthest echo of a straight run");
    field("merge_gap_m_max", &P::merge_gap_m_max, "between runs that are merged");
    field("bow_m_max", &P::bow_m_max, "height of the arc through the echoes; greater: a round object, not a wall");
    field("points_min", &P::points_min, CountRange{3, UINT32_MAX}, "of a segment");
    field("length_m_min", &P::length_m_min, positive_length, "of a segment");
  }
};

class SegmentExtraction {
 public:
  explicit SegmentExtraction(const SegmentExtractionParameters& parameters) : parameters_(parameters) {}

  /// Finds the segments of a scan, in the robot's frame, counter-clockwise; the longest first if there are more than
  /// the poster holds. A scan without echoes gives none.
  void extract(const posters::Echoes& echoes, posters::Segments& segments) const;

 private:
  SegmentExtractionParameters parameters_;
};

}  // namespace waitpoint::sick
