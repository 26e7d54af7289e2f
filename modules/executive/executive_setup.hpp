// SPDX-License-Identifier: BSD-3-Clause
// What an executive is made of: a robot's mission, as its scenario has it, and the parameters of its key `executive`.
//
// A class of executives has a constructor from it, and a function `takes` that is true of the missions it carries out.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/random.hpp"
#include "modules/executive/known_space.hpp"
#include "modules/executive/mission.hpp"
#include "modules/genom/name_space.hpp"
#include "modules/genom/settings.hpp"
#include "modules/posters/navigation.hpp"

namespace waitpoint::executive {

/// Parameters of the executive.
struct Parameters {
  PlanningParameters planning;
  MissionParameters mission;
  double mark_range_m = 3;
  Duration plan_cost_us = {};
  Duration replan_ms = {};
  double seen_range_m = 10;
  bool start_known = true;
  double find_s = 60;

  static void fields(auto field) {
    field("planning", &Parameters::planning, "of routes");
    field("mission", &Parameters::mission, "of the rounds of goals");
    field("mark_range_m", &Parameters::mark_range_m, "greatest distance of echoes to be marked on the map");
    field("plan_cost_us", &Parameters::plan_cost_us, "cost of planning a route");
    field("replan_ms", &Parameters::replan_ms,
          "period of planning again in motion, on the map that the robot has seen; 0: only when the way is blocked; "
          "without it 0 on a known map, 200 on one that is not");
    field("seen_range_m", &Parameters::seen_range_m, "range up to which scans are entered on that map");
    field("start_known", &Parameters::start_known,
          "false: the robot must be found at its start, by the module `locate`");
    field("find_s", &Parameters::find_s, "a lost robot looks for so long for what tells its localisation where it is");
  }
};

/// Overwrites the parameters that are set. BadInput for values that do not fit.
void read(genom::Settings& settings, Parameters& parameters);

/// A file of the mission, and the place of its name.
struct MissionFile {
  std::string file, text, named_in;
  int named_at = 0;
  std::vector<std::string> folders{};  ///< whose files a script may read and write
};

struct ExecutiveSetup {
  genom::NameSpace& names;
  std::string robot;
  Parameters parameters;
  std::shared_ptr<const KnownSpace> known;
  posters::KnownPose start;  ///< in the map frame
  std::vector<Point> goals;
  bool is_for_others = false;  ///< software outside of the modules drives the robot
  std::optional<MissionFile> script, trajectory;
  RandomStream random;  ///< the executive's own
};

}  // namespace waitpoint::executive
