// SPDX-License-Identifier: BSD-3-Clause
// Localisation and mapping on the points of scans: a pose graph over key scans, with loop closure.
//
//   every scan     is matched with the active sub-map, the last key scans, from where the odometry predicts it
//   a key scan     is kept after some travel: a pose of the graph, measured from the one before and from the first one
//   of
//                  its sub-map
//   a closure      is a match of a key scan with older ones: the best pose of a window as large as the drift since,
//   with
//                  no rival, most points explained; a large correction waits for a second one that agrees with it
//
// Sub-maps overlap by half. Older ones are drawn when a scan is to be matched with them, from their key scans where the
// graph has them now.
//
// Sources: Konolige, Grisetti, Kuemmerle, Burgard, Limketkai, Vincent, IROS 2010; Hess, Kohler, Rapp, Andor, ICRA 2016;
// Olson, "Recognizing places using spectrally clustered local matches", 2009 (agreement of closures).
#pragma once

#include <array>
#include <cstddef>
#include <deque>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "modules/matching/correlative_search.hpp"
#include "modules/matching/refinement.hpp"
#include "modules/pose_graph/pose_graph.hpp"
#include "modules/posters/corrected_trajectory.hpp"
#include "modules/segloc/point_parameters.hpp"

namespace waitpoint::segloc {

class PointMap {
 public:
  /// Starts at a known pose. `known`: surfaces mapped before, in the map's frame; `lost`: the pose is a guess, and the
  /// robot is to be found on those.
  PointMap(const PointParameters& parameters, const Pose& start, std::vector<matching::SurfacePoint> known = {},
           bool lost = false);

  /// The next scan: its date, the odometry's motion since the scan before, its points in the robot's frame.
  void observe(Time date, const Pose& motion, std::span<const matching::SurfacePoint> scan);

  /// The robot at the last scan, and the covariance of (x, y, heading).
  Pose pose() const;
  matching::Matrix3 covariance() const;
  /// The pose relative to the map is not known: no match for some way, and no loop closed since.
  bool lost() const { return adrift_since_ || !trusted_; }
  /// How often the pose was found elsewhere than the odometry leads.
  std::uint32_t jumps() const { return jumps_; }
  /// Share of the last scan's points that the map explains.
  double explained() const { return explained_; }

  std::size_t keys() const { return keys_.size(); }
  std::size_t closures() const { return closures_; }
  const pose_graph::PoseGraph& graph() const { return graph_; }
  std::span<const matching::SurfacePoint> points(std::size_t key) const { return keys_[key].points; }

  /// The pose at each scan's date as the graph has it now.
  std::vector<posters::StampedPose> corrected() const;

 private:
  struct Key {
    std::vector<matching::SurfacePoint> points;
    double travel_m = 0;  ///< of the robot up to it
    double drift_m = 0;   ///< assumed standard deviation of its position
  };
  struct Submap {
    std::size_t first;  ///< key: the sub-map's frame is its pose
    std::size_t keys = 0;
    matching::SurfaceMap map;
  };
  struct Drawn {
    std::size_t submap;
    std::size_t optimised;
    std::unique_ptr<matching::SurfaceMap> map;
    std::unique_ptr<matching::ScorePyramid> pyramid;
  };
  struct Closure {
    pose_graph::Measurement measurement;
    Pose correction;  ///< of the frame around the key scan
    double travel_m;
  };
  struct Scan {
    Time date;
    std::size_t key;
    Pose from_key;
  };

  struct Candidate {
    double distance_m;
    std::size_t submap, key;
  };
  enum class Verdict { none, waiting, small, large };

  void match(const Pose& motion, std::span<const matching::SurfacePoint> scan);
  double contradicted(const Pose& robot, std::span<const matching::SurfacePoint> scan) const;
  bool key_due() const;
  void add_key(std::span<const matching::SurfacePoint> scan);
  void begin_again(std::span<const matching::SurfacePoint> scan);
  std::vector<Candidate> old_ones_nearby() const;
  double search_m(std::size_t old) const;
  std::optional<pose_graph::Measurement> one_match(const Drawn& drawn, std::size_t frame,
                                                   const matching::SearchWindow& window, double explained_min) const;
  Verdict judge(const pose_graph::Measurement& measurement);
  void move_adrift_by(const Pose& correction);
  void accept(const pose_graph::Measurement& closure);
  void close_loops();
  Verdict search_everywhere();
  const Drawn& drawn(std::size_t submap);
  void optimise(const Pose& before);
  matching::SurfaceMap empty_map() const;
  matching::Matrix3 information_of(const matching::Matrix3& match) const;

  PointParameters parameters_;
  pose_graph::PoseGraph graph_;
  std::vector<Key> keys_;
  std::vector<Scan> scans_;
  std::optional<Submap> active_, next_;
  Pose in_active_;      // the robot, in the frame of the active sub-map
  Pose key_in_active_;  // the last key scan there
  Pose next_in_active_;
  matching::Matrix3 match_information_{};
  double explained_ = 1, travel_m_ = 0;
  std::array<double, 360> free_m_{};  // as far as the last key scan saw free space, by degrees; 0: did not look
  bool trusted_ = true;
  double open_m2_ = 0, open_rad2_ = 0;  // variances of the odometry since the last match
  double lost_m_ = 0;                   // travel without a match
  unsigned lost_scans_ = 0;
  std::size_t closures_ = 0, optimised_ = 0, closed_since_ = 0;
  std::vector<Closure> waiting_;
  std::deque<Drawn> drawn_;
  std::optional<std::size_t> adrift_since_;  // the first key scan after a loss
  std::optional<Drawn> whole_;
  std::uint32_t jumps_ = 0;
};

}  // namespace waitpoint::segloc
