// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/kernel/measured.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstring>
#include <sstream>
#include <vector>

#include "core/error.hpp"
#include "tests/bench/kernel/meter.hpp"

namespace waitpoint::bench {
namespace {

struct Child {
  pid_t id = -1;
  int output = -1;  // stdout and stderr
};

Child start(const std::vector<std::string>& words) {
  int ends[2];
  WAITPOINT_CHECK(pipe(ends) == 0, "no pipe to a measuring process");
  std::vector<char*> arguments;
  arguments.reserve(words.size() + 1);
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  const pid_t id = fork();
  WAITPOINT_CHECK(id >= 0, "no measuring process can be started");
  if (id == 0) {
    dup2(ends[1], STDOUT_FILENO);
    dup2(ends[1], STDERR_FILENO);
    close(ends[0]);
    close(ends[1]);
    setenv("SYSTEMC_DISABLE_COPYRIGHT_MESSAGE", "DISABLE", 1);
    execv(arguments[0], arguments.data());
    _exit(127);
  }
  close(ends[1]);
  return {id, ends[0]};
}

// Reads all output; false if the process exceeded its time limit.
bool read_output(const Child& child, int limit_s, std::string& text) {
  using std::chrono::milliseconds;
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(limit_s);
  for (;;) {
    const auto left = std::chrono::duration_cast<milliseconds>(deadline - std::chrono::steady_clock::now()).count();
    pollfd wanted{child.output, POLLIN, 0};
    if (left <= 0 || poll(&wanted, 1, static_cast<int>(left)) == 0) return false;
    char chunk[4096];
    const ssize_t got = read(child.output, chunk, sizeof chunk);
    if (got <= 0) return true;
    text.append(chunk, static_cast<std::size_t>(got));
  }
}

std::string last_line(const std::string& text) {
  std::istringstream stream(text);
  std::string line, last;
  while (std::getline(stream, line))
    if (!line.empty()) last = line;
  return last.substr(0, 60);
}

}  // namespace

Measured measure_once(const std::filesystem::path& program, const std::string& workload, int tasks, int budget_ms,
                      bool hooks, int limit_s) {
  std::vector<std::string> words = {program.string(), workload, std::to_string(tasks), std::to_string(budget_ms)};
  if (hooks) words.push_back("hooks");
  const Child child = start(words);
  std::string text;
  const bool in_time = read_output(child, limit_s, text);
  if (!in_time) kill(child.id, SIGKILL);
  int status = 0;
  waitpid(child.id, &status, 0);
  close(child.output);

  Measured measured;
  if (!in_time) {
    measured.why = fmt::format("not done in {} s", limit_s);
  } else if (WIFSIGNALED(status)) {
    measured.why = fmt::format("died: {}", strsignal(WTERMSIG(status)));
  } else if (WEXITSTATUS(status) == declined) {
    measured.end = Measured::End::declined;
  } else if (WEXITSTATUS(status) != 0) {
    measured.why = fmt::format("failed: {}", last_line(text));
  } else {
    measured.end = Measured::End::answered;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) {
      const std::size_t space = line.find(' ');
      if (space == std::string::npos) continue;
      const std::string name = line.substr(0, space), value = line.substr(space + 1);
      if (std::isdigit(static_cast<unsigned char>(value[0])) || value[0] == '-')
        measured.values[name] = std::stod(value);
      else
        measured.words[name] = value;
    }
  }
  return measured;
}

void keep_best(Measured& best, const Measured& other) {
  if (other.end != Measured::End::answered || best.end != Measured::End::answered) {
    if (best.end != Measured::End::answered) best = other;
    return;
  }
  for (const auto& [name, value] : other.values) {
    const auto [at, is_new] = best.values.try_emplace(name, value);
    if (!is_new) at->second = name == "ns" ? std::min(at->second, value) : std::max(at->second, value);
  }
}

}  // namespace waitpoint::bench
