// SPDX-License-Identifier: BSD-3-Clause
// Candidate landmarks: lines are accepted only after repeated sightings from different poses, unlike those of a passing
// robot or a swinging door.
#pragma once

#include <cstdint>

#include "core/fields.hpp"
#include "modules/segloc/landmark.hpp"

namespace waitpoint::segloc {

struct CandidateParameters {
  double angle_rad_max = 0.06, offset_m_max = 0.08;
  std::uint32_t sightings_min = 4;
  double travel_m_min = 0.15, turn_rad_min = 0.15;
  std::uint32_t sightings_enough = 8;
  std::uint32_t patience_updates = 15;

  static void fields(auto field) {
    using P = CandidateParameters;
    field("angle_rad_max", &P::angle_rad_max, "greatest difference in angle between sightings of one line");
    field("offset_m_max", &P::offset_m_max, "the same of their offsets");
    field("sightings_min", &P::sightings_min, "before a line is accepted");
    field("travel_m_min", &P::travel_m_min, "motion in between that is needed, this travel");
    field("turn_rad_min", &P::turn_rad_min, "or this turn");
    field("sightings_enough", &P::sightings_enough, "so many are accepted without motion, too");
    field("patience_updates", &P::patience_updates,
          "a candidate is forgotten after so many updates without a sighting");
  }
};

class Candidates {
 public:
  explicit Candidates(const CandidateParameters& parameters) : parameters_(parameters) {}

  /// Records a sighting from `robot` that no landmark explains, in update `update`. True if it confirms a line, which
  /// is then removed from the candidates; `confirmed` has all sightings of it.
  bool sight(const Pose& robot, const LineObservation& observation, std::uint64_t update, Landmark& confirmed);

  /// Deletes candidates not seen for too long.
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
