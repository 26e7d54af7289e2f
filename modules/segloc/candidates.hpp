// SPDX-License-Identifier: BSD-3-Clause
// Lines that may become landmarks: those seen again and again from different places, and no others. A robot passing by
// or a door that swings is not a wall.
#pragma once

#include <cstdint>

#include "core/fields.hpp"
#include "modules/segloc/landmark.hpp"

namespace waitpoint::segloc {

struct CandidateParameters {
  double angle_rad_max = 0.06, offset_m_max = 0.08;  ///< between sightings of one line
  std::uint32_t sightings_min = 4;                   ///< before a line is trusted
  double travel_m_min = 0.15, turn_rad_min = 0.15;   ///< the robot must have moved so far, or turned, in between
  std::uint32_t sightings_enough = 8;                ///< trusted even if the robot stood still
  std::uint32_t patience_updates = 15;               ///< forgotten when not seen for so long

  static constexpr auto fields() {
    using P = CandidateParameters;
    return std::tuple(field("angle_rad_max", &P::angle_rad_max), field("offset_m_max", &P::offset_m_max),
                      field("sightings_min", &P::sightings_min), field("travel_m_min", &P::travel_m_min),
                      field("turn_rad_min", &P::turn_rad_min), field("sightings_enough", &P::sightings_enough),
                      field("patience_updates", &P::patience_updates));
  }
};

class Candidates {
 public:
  explicit Candidates(const CandidateParameters& parameters) : parameters_(parameters) {}

  /// Notes a sighting from `robot` that no landmark explains, in update `update`. True if the line is confirmed by it;
  /// it is then no candidate any more, and `seen` is all that was seen of it.
  bool sight(const Pose& robot, const LineObservation& observation, std::uint64_t update, Landmark& confirmed);

  /// Forgets what was not seen for too long.
  void forget_old(std::uint64_t update);

  std::size_t size() const { return items_.size(); }

 private:
  struct Candidate {
    Landmark landmark;
    Pose first_seen_from;
  };

  void remove(std::size_t i);

  CandidateParameters parameters_;
  Bounded<Candidate, 64> items_;
};

}  // namespace waitpoint::segloc
