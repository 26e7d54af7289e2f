// SPDX-License-Identifier: BSD-3-Clause
#include "tools/command/shown_process.hpp"

#include <sys/wait.h>

#include <csignal>
#include <cstdio>
#include <utility>

#include "tools/command/interruption.hpp"

namespace waitpoint::tools {
namespace {

constexpr int status_of_signal = 128;

}  // namespace

bool ShownProcess::is_done(const std::string& url) {
  if (!has_ended_ && waitpid(process_, &status_, WNOHANG) == process_) {
    has_ended_ = true;
    if (interruption() == 0)
      std::fprintf(stderr, "waitpoint: the %s is over; until Ctrl-C it is shown at %s\n", what_.c_str(), url.c_str());
  }
  if (interruption() == 0) return false;
  // One signal of a terminal reaches both; the process takes the second for its echo.
  if (!has_ended_ && !std::exchange(is_told_, true)) kill(process_, interruption());
  return has_ended_;
}

int ShownProcess::status() const {
  return WIFEXITED(status_) ? WEXITSTATUS(status_) : status_of_signal + WTERMSIG(status_);
}

}  // namespace waitpoint::tools
