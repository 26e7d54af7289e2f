// SPDX-License-Identifier: BSD-3-Clause
#include "tools/replay/replay_options.hpp"

#include <vector>

#include "core/error.hpp"
#include "tools/command/distinct_files.hpp"
#include "tools/command/option_values.hpp"
#include "tools/replay/log_map.hpp"

namespace waitpoint::tools {

ReplayArguments::ReplayArguments(CommandLine& line)
    : command_(line.add_command("replay", "Feeds a log of sensors to a robot's modules (docs/replay.md).")) {
  source_.add(command_);
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
  command_.json(json_);
  command_.option("--picture", picture_, "FILE.svg", "draw the path and the map");
  command_.option("--map", map_, "FILE.yaml",
                  "write a map for ROS's map_server and scenarios, and its image as FILE.pgm");
  command_.option("--digests", digests_, "FILE", "write a digest per simulated second");
  command_.option("--events", events_, "FILE", "write every event as a line of text");
  command_.flag("--check", check_,
                "replay twice in this process and once in a perturbed one and compare event\n"
                "by event, as run --check (docs/determinism.md)");
}

SimulationOptions PlayOptions::simulation() const {
  SimulationOptions options;
  options.order = order;
  options.seed = seed;
  return options;
}

ReplayOptions ReplayArguments::options() const {
  ReplayOptions options;
  options.check = check_;
  if (check_)
    check_not_together("--check", {{"--pose", pose_},
                                   {"--trajectory", trajectory_},
                                   {"--relations", relations_},
                                   {"--summary", summary_},
                                   {"--picture", picture_},
                                   {"--map", map_},
                                   {"--digests", digests_},
                                   {"--events", events_}});
  options.source = source_.options();
  PlayOptions& play = options.play;
  play.until = positive_seconds("--until", until_);
  if (pose_ == "segloc") {
    play.pose = playback::PoseSource::segloc;
  } else if (pose_ == "pom") {
    play.pose = playback::PoseSource::pom;
  } else if (pose_ == "odometry") {
    play.pose = playback::PoseSource::odometry;
  } else if (!pose_.empty()) {
    refuse("--pose", "segloc, pom or odometry", pose_);
  }
  const auto file = [](const std::string& name) {
    return name.empty() ? std::nullopt : std::optional<std::filesystem::path>(name);
  };
  const std::vector<NamedFile> files = {{"--trajectory", trajectory_},
                                        {"--summary", summary_},
                                        {"--picture", picture_},
                                        {"--map", map_},
                                        {"--map", map_.empty() ? "" : image_of(map_).string()},
                                        {"--digests", digests_},
                                        {"--events", events_},
                                        {"--relations", relations_, NamedFile::Use::read},
                                        {"--scenario", source_.scenario(), NamedFile::Use::read},
                                        {"LOG", source_.log(), NamedFile::Use::read}};
  check_distinct(files);
  if (json_) check_beside_json(files);
  play.trajectory = file(trajectory_);
  play.relations = file(relations_);
  play.summary = file(summary_);
  play.picture = file(picture_);
  play.map = file(map_);
  if (play.map && play.map->extension() == ".pgm") refuse("--map", "the name of a YAML file", map_);
  play.digests = file(digests_);
  play.events = file(events_);
  play.json = json_;
  return options;
}

}  // namespace waitpoint::tools
