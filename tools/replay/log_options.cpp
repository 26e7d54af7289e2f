// SPDX-License-Identifier: BSD-3-Clause
#include "tools/replay/log_options.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "tools/command/installed_part.hpp"
#include "tools/command/option_values.hpp"

namespace waitpoint::tools {
namespace {

std::vector<std::string> names_of(const std::string& list) {
  std::vector<std::string> names;
  for (std::size_t begin = 0; begin < list.size();) {
    const std::size_t end = std::min(list.find(',', begin), list.size());
    if (end == begin) refuse("--modules", "names with commas between them", list);
    const std::string name = list.substr(begin, end - begin);
    if (std::find(names.begin(), names.end(), name) != names.end()) refuse("--modules", "each name once", list);
    names.push_back(name);
    begin = end + 1;
  }
  return names;
}

}  // namespace

void LogArguments::add(Command& command) {
  command.argument("LOG", log_, "of CARMEN or GMapping, a ROS 1 bag or MCAP; also compressed by gzip",
                   Command::Presence::required);
  command.option("--modules", modules_, "NAME,NAME,...", "run these modules (default: rflex, sick, segloc and pom)");
  command.option("--scenario", scenario_, "FILE",
                 "the modules' parameters are those of the first robot of this scenario\n(default: the modules' own)");
  command.repeated("--set", assignments_, "MODULE.KEY=VALUE",
                   "override a parameter of a module; may be repeated. For example:\n  segloc.points.key_travel_m=0.2");
  command.option("--scan", scan_, "NAME", "take the scans of this type of record or topic");
  command.option("--odometry", odometry_, "TOPIC", "take the odometry of this topic");
  command.option("--robot", robot_, "NAME", "take the records of this robot or host: a log of CARMEN may have several");
}

LogOptions LogArguments::options() const {
  LogOptions options;
  options.log = log_;
  options.choice = {scan_, odometry_, robot_};
  if (!scenario_.empty()) options.scenario = find_scenario(scenario_);
  options.modules = names_of(modules_);
  options.assignments = assignments_;
  return options;
}

}  // namespace waitpoint::tools
