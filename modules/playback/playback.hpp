// SPDX-License-Identifier: BSD-3-Clause
// A run of a robot's modules on a log: no world, no executive; the log's player is in the place of the devices.
//
//   replay   starts the modules, gives them their pose, switches the laser on, starts the localisation, then the player
//   player   at the dates of the log's records, in the world's phase (log_player.hpp)
//
// The modules begin at the pose (0, 0, 0), the frame of all poses; the first record of the log is at time 0. The
// run ends a second after the last scan.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "fibers/sync/semaphore.hpp"
#include "fibers/sync/simulation.hpp"
#include "modules/bridge/path.hpp"
#include "modules/bridge/run_result.hpp"
#include "modules/genom/client.hpp"
#include "modules/genom/module.hpp"
#include "modules/logs/playing_order.hpp"
#include "modules/logs/sensor_log.hpp"
#include "modules/playback/log_player.hpp"
#include "modules/posters/position.hpp"
#include "modules/scenario/scenario.hpp"

namespace waitpoint::playback {

/// The module of the poses.
enum class PoseSource : std::uint8_t { segloc, pom, odometry };

/// A pose at the stamp that a scan has in the log.
struct StampedPose {
  Time stamp;
  Pose pose;
  std::size_t scan = 0;  ///< its index in the log
};

class Playback {
 public:
  /// Inconsistencies are BadInput, so are modules of which none reads the log's data. Settings that follow from the
  /// log replace those of the modules (log_settings.hpp). `log` and `robot`, whose modules run, must outlive the run.
  Playback(const logs::SensorLog& log, const scenario::RobotScenario& robot, std::span<const genom::ModuleType> types,
           const SimulationOptions& options);
  ~Playback();

  /// Runs all events before `until`; may be called again with a later time. BadInput if the modules do not
  /// take the log's records.
  RunEnd run_before(Time until);

  const logs::PlayingOrder& order() const { return order_; }
  const LogPlayer& player() const { return *player_; }
  std::size_t modules() const { return modules_.size(); }
  Simulation& simulation() { return simulation_; }
  const Simulation& simulation() const { return simulation_; }
  /// The date of the last record.
  Time last() const { return order_.records.back().date; }

  /// True if the modules have such poses.
  bool has(PoseSource source) const;
  /// For each scan so far that has one, in the order of play. Of `segloc`: as it has corrected them by
  /// now.
  std::vector<StampedPose> trajectory(PoseSource source) const;
  /// The segments of the map; empty without one.
  std::vector<bridge::Line> segments() const;

 private:
  void make_modules(std::span<const genom::ModuleType> types);
  std::vector<Setting> settings_of(const scenario::ModuleScenario& module) const;
  void check_readers() const;
  std::string name_of(const char* module_type) const;
  void run_modules();
  template <class Input>
  void request(genom::Client& client, const char* module_type, const char* request, const Input& input);
  void observe();
  std::vector<bridge::DatedPose> corrected() const;

  const logs::SensorLog& log_;
  const scenario::RobotScenario& robot_;
  logs::PlayingOrder order_;
  genom::NameSpace names_;
  std::vector<std::unique_ptr<genom::Module>> modules_;
  std::optional<LogPlayer> player_;
  const genom::Poster<posters::Localisation>* localisation_ = nullptr;  // or null
  const genom::Poster<posters::FusedPosition>* position_ = nullptr;     // or null
  std::vector<bridge::DatedPose> localised_, fused_;
  counting_semaphore<> begin_{0, "begin of the log"}, end_{0, "end of the log"};
  Time reached_;
  Simulation simulation_;  // destroyed before the objects that its tasks use
};

}  // namespace waitpoint::playback
