// SPDX-License-Identifier: BSD-3-Clause
#include "tools/run/viewed_run.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <system_error>

#include "core/number_text.hpp"
#include "tools/command/interruption.hpp"
#include "tools/command/version.hpp"
#include "tools/view/server/viewer.hpp"

namespace waitpoint::tools {
namespace {

constexpr int status_of_signal = 128;

view::ViewerOptions viewer_options(const RunOptions& options) {
  view::ViewerOptions viewer;
  viewer.is_controlled = options.serve_control;
  viewer.origins = options.serve_origins;
  viewer.replay_command = replay_line(options, options.seed);
  if (options.serve->empty()) return viewer;
  const std::size_t colon = options.serve->rfind(':');
  const std::string port = colon != std::string::npos ? options.serve->substr(colon + 1) : *options.serve;
  if (!parse_number(port, viewer.port))
    refuse("--serve", "an address and a port from 0 to 65535, as 127.0.0.1:8080", *options.serve);
  if (colon != std::string::npos && colon > 0) viewer.address = options.serve->substr(0, colon);
  if (viewer.address.front() == '[' && viewer.address.back() == ']')
    viewer.address = viewer.address.substr(1, viewer.address.size() - 2);
  return viewer;
}

/// The run's process, as the viewer's sees it.
class RunProcess {
 public:
  explicit RunProcess(pid_t process) : process_(process) {}

  /// True when the viewer has nothing more to do: after a signal, once the run has ended.
  bool is_done(const std::string& url) {
    if (!has_ended_ && waitpid(process_, &status_, WNOHANG) == process_) {
      has_ended_ = true;
      if (interruption() == 0)
        std::fprintf(stderr, "waitpoint: the run is over; until Ctrl-C it is shown at %s\n", url.c_str());
    }
    if (interruption() == 0) return false;
    // One signal of a terminal reaches both; the run takes the second for its echo.
    if (!has_ended_ && !std::exchange(is_told_, true)) kill(process_, interruption());
    return has_ended_;
  }
  int status() const { return WIFEXITED(status_) ? WEXITSTATUS(status_) : status_of_signal + WTERMSIG(status_); }

 private:
  pid_t process_;
  int status_ = 0;
  bool has_ended_ = false, is_told_ = false;
};

}  // namespace

view::SceneOptions scene_options(const RunOptions& options, const scenario::Scenario& scenario) {
  const std::string version = version_text();
  return {options.seed, options.order, options.limit(scenario.until), version.substr(0, version.find('\n')),
          options.serve_control};
}

void check_can_be_viewed(const scenario::Scenario& scenario) {
  for (const scenario::RobotScenario& robot : scenario.robots)
    if (!robot.programs.empty())
      throw BadInput("--serve", "expected robots without programs, found '" + robot.programs.front().name + "' of " +
                                    robot.name + " (" + robot.programs.front().written.text() + ")");
}

int run_viewed(const RunOptions& options, const std::function<int(view::Channel& viewer)>& run) {
  const view::ViewerOptions viewing = viewer_options(options);
  auto [here, there] = view::Channel::make();
  std::fflush(nullptr);
  const pid_t process = fork();
  if (process < 0) throw std::system_error(errno, std::generic_category(), "a process for the viewer");
  if (process == 0) {
    here = view::Channel(view::Descriptor());
    if (!there.receive()) _exit(0);  // the viewer cannot listen, and says so
    return run(there);
  }
  there = view::Channel(view::Descriptor());
  view::Viewer viewer(viewing, std::move(here));
  const std::string url = viewer.url();
  std::fprintf(stderr, "waitpoint: the run is shown at %s\n", url.c_str());
  std::fprintf(stderr, "waitpoint: Foxglove can connect to %s\n", viewer.foxglove_url().c_str());
  viewer.begin_run();
  RunProcess of_run(process);
  viewer.serve([&] { return of_run.is_done(url); });
  return of_run.status();
}

}  // namespace waitpoint::tools
