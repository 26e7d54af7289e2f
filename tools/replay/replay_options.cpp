// SPDX-License-Identifier: BSD-3-Clause
#include "tools/replay/replay_options.hpp"

#include "core/error.hpp"
#include "tools/command/distinct_files.hpp"
#include "tools/command/installed_part.hpp"
#include "tools/command/option_values.hpp"

namespace waitpoint::tools {
namespace {

std::vector<std::string> names_of(const std::string& list) {
  std::vector<std::string> names;
  for (std::size_t begin = 0; begin < list.size();) {
    const std::size_t end = std::min(list.find(',', begin), list.size());
    if (end == begin) refuse("--modules", "names with commas between them", list);
    names.push_back(list.substr(begin, end - begin));
    begin = end + 1;
  }
  return names;
}

}  // namespace

ReplayArguments::ReplayArguments(CommandLine& line)
    : command_(line.add_command("replay", "Feeds a log of sensors to a robot's modules (docs/replay.md).")) {
  command_.argument("LOG", log_, "of CARMEN or GMapping, a ROS 1 bag or MCAP; also compressed by gzip",
                    Command::Presence::required);
  command_.option("--modules", modules_, "NAME,NAME,...", "run these modules (default: rflex, sick, segloc and pom)");
  command_.option("--scenario", scenario_, "FILE",
                  "the modules' parameters are those of the first robot of this scenario\n(default: the modules' own)");
  command_.repeated("--set", assignments_, "MODULE.KEY=VALUE",
                    "override a parameter of a module; may be repeated. For example:\n  segloc.chi2_match=6");
  command_.option("--scan", scan_, "NAME", "take the scans of this type of record or topic");
  command_.option("--odometry", odometry_, "TOPIC", "take the odometry of this topic");
  command_.option("--robot", robot_, "NAME",
                  "take the records of this robot or host: a log of CARMEN may have several");
  command_.option("--until", until_, "S", "end S seconds after the first record (default: at the end of the log)");
  command_.option("--pose", pose_, "NAME",
                  "the poses of trajectory, relations and picture: segloc, as its map is corrected\n"
                  "at the end; pom, as it knew them at the time; odometry (default: the first that\nthere is)");
  command_.option("--trajectory", trajectory_, "FILE.tum",
                  "write the pose at each scan in TUM format; as FILE.log as CARMEN's FLASER records");
  command_.option("--relations", relations_, "FILE",
                  "print the errors of the displacements between poses, which FILE has as\n"
                  "  stamp1 stamp2 x y z roll pitch yaw");
  command_.option("--summary", summary_, "FILE.json",
                  "write the summary as JSON; -: to standard output, in place of the text");
  command_.option("--picture", picture_, "FILE.svg", "draw the path and the map");
  command_.option("--digests", digests_, "FILE", "write a digest per simulated second");
  command_.option("--events", events_, "FILE", "write every event as a line of text");
}

ReplayOptions ReplayArguments::options() const {
  ReplayOptions options;
  options.log = log_;
  options.choice = {scan_, odometry_, robot_};
  if (!scenario_.empty()) options.scenario = find_scenario(scenario_);
  options.modules = names_of(modules_);
  options.assignments = assignments_;
  options.until = positive_seconds("--until", until_);
  if (pose_ == "segloc") {
    options.pose = playback::PoseSource::segloc;
  } else if (pose_ == "pom") {
    options.pose = playback::PoseSource::pom;
  } else if (pose_ == "odometry") {
    options.pose = playback::PoseSource::odometry;
  } else if (!pose_.empty()) {
    refuse("--pose", "segloc, pom or odometry", pose_);
  }
  const auto file = [](const std::string& name) {
    return name.empty() ? std::nullopt : std::optional<std::filesystem::path>(name);
  };
  check_distinct({{"--trajectory", trajectory_},
                  {"--summary", summary_},
                  {"--picture", picture_},
                  {"--digests", digests_},
                  {"--events", events_},
                  {"--relations", relations_, NamedFile::Use::read},
                  {"LOG", log_, NamedFile::Use::read}});
  options.trajectory = file(trajectory_);
  options.relations = file(relations_);
  options.summary = file(summary_);
  options.picture = file(picture_);
  options.digests = file(digests_);
  options.events = file(events_);
  return options;
}

}  // namespace waitpoint::tools
