// SPDX-License-Identifier: BSD-3-Clause
// The metric of relations for trajectories (Kuemmerle, Steder, Dornhege, Ruhnke, Grisetti, Stachniss, Kleiner, "On
// Measuring the Accuracy of SLAM Algorithms", Autonomous Robots 27, 2009): a relation is the displacement between the
// poses at two stamps, known from the floor itself; the error of a trajectory is that of its own displacements. No
// common frame is needed, and a mistake counts once, not for all poses after it.
//
//   a line of a file:  stamp1 stamp2 x y z roll pitch yaw        of the pose at stamp2 as seen from that at stamp1
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "core/pose.hpp"
#include "core/time.hpp"
#include "modules/playback/playback.hpp"

namespace waitpoint::tools {

struct Relation {
  Time from, to;
  Pose displacement;
};

/// Mean and standard deviation.
struct Moments {
  double mean = 0, deviation = 0;
};

struct RelationErrors {
  std::uint64_t used = 0, given = 0;  ///< those without poses at both stamps are not used
  Moments translation_m, rotation_rad;
  Moments squared_translation_m2, squared_rotation_rad2;
};

/// BadInput, with the line, for a malformed file or one without relations.
std::vector<Relation> read_relations(const std::filesystem::path& file);

/// The errors of a trajectory, of relations over at most `span`. The pose at a stamp is that between the poses before
/// and after it if they are within a second of each other, else the nearest one within a tenth of a second.
RelationErrors relation_errors(std::span<const Relation> relations, std::vector<playback::StampedPose> trajectory,
                               Duration span = Duration::max());

/// One JSON object of all relations, with those within 20 s in `within_20_s`. Errors are null if no relation was used.
std::string relations_json(std::span<const Relation> relations, const std::vector<playback::StampedPose>& trajectory);

}  // namespace waitpoint::tools
