// SPDX-License-Identifier: BSD-3-Clause
#include "tools/run/viewed_run.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <optional>
#include <system_error>

#include "tools/command/serve_address.hpp"
#include "tools/command/shown_process.hpp"
#include "tools/command/version.hpp"
#include "tools/view/server/viewer.hpp"

namespace waitpoint::tools {
namespace {

view::ViewerOptions viewer_options(const RunOptions& options, const scenario::Scenario& scenario) {
  view::ViewerOptions viewer;
  viewer.until = options.limit(scenario.until);
  viewer.is_controlled = options.serve_control;
  viewer.replay_command = replay_line(options, options.seed);
  viewer.address = options.serve->address;
  viewer.port = options.serve->port;
  return viewer;
}

}  // namespace

view::SceneOptions scene_options(const RunOptions& options, const scenario::Scenario& scenario) {
  return {options.seed, options.order, options.limit(scenario.until), version_line(), options.serve_control};
}

void check_can_be_viewed(const scenario::Scenario& scenario) {
  for (const scenario::RobotScenario& robot : scenario.robots)
    if (!robot.programs.empty())
      throw BadInput("--serve", "expected robots without programs, found '" + robot.programs.front().name + "' of " +
                                    robot.name + " (" + robot.programs.front().written.text() + ")");
}

int run_viewed(const RunOptions& options, const scenario::Scenario& scenario,
               const std::function<int(view::Channel& viewer)>& run) {
  const view::ViewerOptions viewing = viewer_options(options, scenario);
  auto [here, there] = view::Channel::make();
  std::fflush(nullptr);
  const pid_t process = fork();
  if (process < 0) throw std::system_error(errno, std::generic_category(), "a process for the viewer");
  if (process == 0) {
    ShownProcess::end_with_parent();
    here = view::Channel(view::Descriptor());
    if (!there.receive()) _exit(0);  // the viewer cannot listen, and says so
    return run(there);
  }
  there = view::Channel(view::Descriptor());
  std::optional<view::Viewer> viewer(std::in_place, viewing, std::move(here));
  const std::string url = viewer->url();
  std::fprintf(stderr, "waitpoint: the run is shown at %s\n", url.c_str());
  viewer->begin_run();
  ShownProcess of_run(process, "run");
  viewer->serve([&] { return of_run.is_done(url); });
  viewer.reset();
  ShownProcess::end_others();
  return of_run.status();
}

}  // namespace waitpoint::tools
