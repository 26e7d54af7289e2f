// SPDX-License-Identifier: BSD-3-Clause
#include "tools/replay/replay_options.hpp"

#include "tools/command/option_values.hpp"
#include "tools/command/options/time_limits.hpp"
#include "tools/command/shell_words.hpp"
#include "tools/replay/log_map.hpp"

namespace waitpoint::tools {
namespace {

/// It names two files.
OptionValue map_files(OptionalFile& into) {
  OptionValue value = written_file(into, "FILE.yaml");
  value.take = [&into](const std::string& source, const std::string& text) {
    into = text;
    if (into->extension() == ".pgm") refuse(source, "the name of a YAML file", text);
  };
  value.files = [](const std::string& text) { return std::vector{text, image_of(text).string()}; };
  return value;
}

void declare_outputs(Command& command, PlayOptions& play) {
  using playback::PoseSource;
  declare_summary(command, play.summary, play.json);
  declare_picture(command, play.picture, "draw the path and the map");
  command.add("--map", map_files(play.map),
              "write a map for ROS's map_server and scenarios, and its image as FILE.pgm");
  command.add("--trajectory", written_file(play.trajectory, "FILE.tum"), "write the pose at each scan in TUM format",
              {.more = "FILE.log: as CARMEN's FLASER records."});
  command.add(
      "--pose",
      word<PoseSource>(play.pose,
                       {{"segloc", PoseSource::segloc}, {"pom", PoseSource::pom}, {"odometry", PoseSource::odometry}}),
      "the poses of trajectory, relations and picture",
      {.usual = "the first that there is",
       .more = "segloc: as its map is corrected at the end; pom: as they were known at the time."});
  command.add("--relations", read_file(play.relations, "FILE"),
              "print the errors of the displacements between poses in FILE",
              {.more = "Its lines are\n  stamp1 stamp2 x y z roll pitch yaw"});
  command.section("Events, and their comparison");
  declare_event_files(command, play.digests, "write a digest per simulated second", play.events);
}

}  // namespace

void declare(Command& command, ReplayOptions& options) {
  command.description = "Plays a log of sensors to a robot's modules (docs/replay.md).";
  command.examples = {"intel.log --picture map.svg"};
  declare_log(command, options.source);
  command.section("Time");
  command.add("--until", seconds(options.play.until), "end S seconds after the first record",
              {.usual = "the end of the log"});
  declare_outputs(command, options.play);
  declare_verify(command, options.verify,
                 {"--pose", "--trajectory", "--relations", "--summary", "--picture", "--map", "--digests", "--events"});
  command.finally([&command, &options] {
    const Invocation& invocation = command.invocation();
    options.command = quoted(invocation.program) + " " + command.name + quoted(invocation.words);
  });
}

SimulationOptions PlayOptions::simulation() const {
  SimulationOptions options;
  options.order = order;
  options.seed = seed;
  return options;
}

}  // namespace waitpoint::tools
