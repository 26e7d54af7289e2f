// SPDX-License-Identifier: BSD-3-Clause
#include "tools/replay/replay.hpp"

#include <fmt/format.h>

#include <array>
#include <cstdio>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "core/number_text.hpp"
#include "core/printable_line.hpp"
#include "fibers/kernel/process_end.hpp"
#include "fibers/kernel/run.hpp"
#include "fibers/kernel/unfinished_run.hpp"
#include "modules/playback/playback.hpp"
#include "tools/command/interruption.hpp"
#include "tools/command/system_confinement.hpp"
#include "tools/output/json_document.hpp"
#include "tools/output/output_file.hpp"
#include "tools/output/progress.hpp"
#include "tools/output/recorders.hpp"
#include "tools/replay/log_map.hpp"
#include "tools/replay/playback_run.hpp"
#include "tools/replay/relations.hpp"
#include "tools/replay/replay_picture.hpp"
#include "tools/replay/replay_summary.hpp"
#include "tools/replay/trajectory_file.hpp"

namespace waitpoint::tools {
namespace {

using playback::PoseSource;

constexpr std::array<std::string_view, 3> names_of_sources = {"segloc", "pom", "odometry"};  // by PoseSource

/// The files, opened before the run.
struct Files {
  explicit Files(const PlayOptions& options) {
    const auto open = [](std::optional<OutputFile>& file, const std::optional<std::filesystem::path>& name) {
      if (name) file.emplace(*name);
    };
    open(trajectory, options.trajectory);
    open(summary, options.summary);
    open(picture, options.picture);
    open(map, options.map);
    if (options.map) image.emplace(image_of(*options.map));
    if (options.digests) digests.emplace(*options.digests);
    if (options.events) events.emplace(*options.events);
  }

  std::optional<OutputFile> trajectory, summary, picture, map, image;
  std::optional<DigestRecorder> digests;
  std::optional<EventRecorder> events;
};

std::string text_of(RunEnd end, bool interrupted) {
  if (interrupted) return "interrupted";
  switch (end) {
    case RunEnd::time_reached: return "time limit";
    case RunEnd::ended: return "finished";
    case RunEnd::deadlock: return "deadlock";
    case RunEnd::no_progress: return "no progress";
  }
  return "";
}

PoseSource source_of(const PlayOptions& options, const playback::Playback& playback) {
  if (options.pose) {
    if (!playback.has(*options.pose))
      throw BadInput("--pose", "expected poses of a module that runs, found '" +
                                   std::string(names_of_sources[static_cast<std::size_t>(*options.pose)]) + "'");
    return *options.pose;
  }
  for (const PoseSource source : {PoseSource::segloc, PoseSource::pom})
    if (playback.has(source)) return source;
  return PoseSource::odometry;
}

ReplayResult result_of(const PlayOptions& options, playback::Playback& playback, std::vector<Relation> relations) {
  ReplayResult result;
  result.relations = std::move(relations);
  result.digest = playback.simulation().digest();
  result.events = kernel::events(playback.simulation().scheduler());
  const PoseSource source = source_of(options, playback);
  result.pose_source = names_of_sources[static_cast<std::size_t>(source)];
  result.trajectory = playback.trajectory(source);
  return result;
}

struct Content {
  OutputFile& file;
  std::string text;
};

/// BadInput for a log that cannot be drawn.
std::vector<Content> contents(const PlayOptions& options, const logs::SensorLog& log,
                              const playback::Playback& playback, const ReplayResult& result, Files& files) {
  std::vector<Content> contents;
  const auto add = [&](std::optional<OutputFile>& file, std::string text) {
    contents.push_back({*file, std::move(text)});
  };
  const std::vector<playback::StampedPose> odometry = playback.trajectory(PoseSource::odometry);
  if (files.summary) add(files.summary, replay_json(log, playback, result));
  if (files.trajectory) add(files.trajectory, trajectory_text(*options.trajectory, log, result.trajectory, odometry));
  if (files.picture) {
    const std::string line =
        fmt::format("{} · {} after {:.1f} s · {} · {}", result.pose_source, result.outcome, result.simulated.seconds(),
                    counted(playback.player().scans(), "scan"), to_string(result.digest));
    add(files.picture, replay_picture_svg(printable_line(std::filesystem::path(log.file).filename().string()), line,
                                          log, result.trajectory, odometry, playback.segments()));
  }
  if (files.map) {
    LogMap drawn = log_map(*options.map, log, result.trajectory);
    add(files.image, std::move(drawn.image));
    add(files.map, std::move(drawn.yaml));
  }
  return contents;
}

void write_files(const std::vector<Content>& contents, Files& files) {
  for (const Content& content : contents) content.file.write(content.text);
  for (const Content& content : contents) content.file.commit();
  if (files.digests) files.digests->finish();
  if (files.events) files.events->finish();
}

}  // namespace

int play_log(const LogSource& source, const PlayOptions& options, std::span<const genom::ModuleType> types) {
  std::vector<Relation> relations;
  if (options.relations) relations = read_relations(*options.relations);
  const logs::SensorLog log = source.read();
  const kernel::UnfinishedRun unfinished(options.replay.c_str());
  playback::Playback playback(log, source.robot, types, options.simulation());
  static_cast<void>(source_of(options, playback));  // bad input is told before the run
  Files files(options);
  confine_to_listed_files();
  if (files.events) files.events->watch(playback.simulation());

  const double start_s = wall_clock_s();
  const PlaybackRun run = run_playback(playback, source.end(options.until), [&](std::int64_t second) {
    if (files.digests) files.digests->record(playback.simulation(), second);
  });
  ReplayResult result = result_of(options, playback, std::move(relations));
  result.wall_s = wall_clock_s() - start_s;
  result.outcome = text_of(run.end, run.interrupted);
  result.simulated = std::min(run.reached, playback.last()).since_start();

  const std::vector<Content> made = contents(options, log, playback, result, files);  // before anything is written
  const std::string text = replay_text(log, playback, result);
  const kernel::Commit commit;
  write_text(text, options.json || (options.summary && is_standard_output(*options.summary)));
  write_files(made, files);
  if (const std::string& trouble = playback.simulation().trouble(); !trouble.empty())
    std::fprintf(stderr, "waitpoint: %s\n", trouble.c_str());
  const bool is_stuck = run.end == RunEnd::deadlock || run.end == RunEnd::no_progress;
  const int status = run.interrupted ? interrupted_status : is_stuck ? 1 : 0;
  return options.json ? end_with_json(options.command, status, replay_json(log, playback, result)) : status;
}

int replay_log(const ReplayOptions& options, std::span<const genom::ModuleType> types) {
  heed_signals();
  PlayOptions play = options.play;
  play.replay = options.command;
  return play_log(log_source(options.source), play, types);
}

}  // namespace waitpoint::tools
