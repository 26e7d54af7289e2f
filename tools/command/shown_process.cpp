// SPDX-License-Identifier: BSD-3-Clause
#include "tools/command/shown_process.hpp"

#include <sys/prctl.h>
#include <sys/wait.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <fstream>
#include <thread>
#include <utility>

#include "tools/command/interruption.hpp"

namespace waitpoint::tools {
namespace {

constexpr int status_of_signal = 128;

}  // namespace

ShownProcess::ShownProcess(pid_t process, std::string what) : process_(process), what_(std::move(what)) {
  prctl(PR_SET_CHILD_SUBREAPER, 1);
}

void ShownProcess::end_with_parent() { prctl(PR_SET_PDEATHSIG, SIGKILL); }

void ShownProcess::end_others() {
  constexpr int looks = 50;
  for (int look = 0; look <= looks; ++look) {
    pid_t ended = 0;
    while ((ended = waitpid(-1, nullptr, WNOHANG)) > 0) {
    }
    if (ended < 0) return;
    if (look == looks) {
      std::ifstream children("/proc/thread-self/children");
      for (pid_t child = 0; children >> child;) kill(child, SIGKILL);
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
}

bool ShownProcess::is_done(const std::string& url) {
  int status = 0;
  for (pid_t ended = 0; (ended = waitpid(-1, &status, WNOHANG)) > 0;) {
    if (ended != process_) continue;
    status_ = status;
    has_ended_ = true;
    if (interruption() == 0)
      std::fprintf(stderr, "waitpoint: the %s is over; until Ctrl-C it is shown at %s\n", what_.c_str(), url.c_str());
  }
  if (interruption() == 0) return false;
  // One signal of a terminal reaches both; the process takes the second for its echo.
  if (!has_ended_ && !std::exchange(is_interrupted_, true)) kill(process_, interruption());
  return has_ended_;
}

int ShownProcess::status() const {
  return WIFEXITED(status_) ? WEXITSTATUS(status_) : status_of_signal + WTERMSIG(status_);
}

}  // namespace waitpoint::tools
