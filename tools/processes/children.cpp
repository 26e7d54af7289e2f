// SPDX-License-Identifier: BSD-3-Clause
#include "tools/processes/children.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <system_error>

#include "fibers/explore/process_ticks.hpp"
#include "tools/command/signal_words.hpp"
#include "tools/output/progress.hpp"

namespace waitpoint::tools {
namespace {

constexpr std::size_t errors_max = 4096;
constexpr double between_looks_s = 0.5;

[[noreturn]] void fail(const char* what) { throw std::system_error(errno, std::generic_category(), what); }

// A message is its size and its bytes, in one piece as far as it fits: there may be thousands a second.
std::string message_of(const std::string& bytes) {
  const std::size_t size = bytes.size();
  std::string message(sizeof size + size, '\0');
  std::memcpy(message.data(), &size, sizeof size);
  std::memcpy(message.data() + sizeof size, bytes.data(), size);
  return message;
}
// True if these are a whole message.
bool is_message(const std::string& so_far) {
  std::size_t size = 0;
  if (so_far.size() < sizeof size) return false;
  std::memcpy(&size, so_far.data(), sizeof size);
  return so_far.size() == sizeof size + size;
}

// Both return false if the other end is gone.
bool send_message(int socket, const std::string& bytes) {
  const std::string message = message_of(bytes);
  for (std::size_t at = 0; at < message.size();) {
    const ssize_t sent = send(socket, message.data() + at, message.size() - at, MSG_NOSIGNAL);
    if (sent < 0 && errno != EINTR) return false;
    if (sent > 0) at += static_cast<std::size_t>(sent);
  }
  return true;
}
// The next one is sent only after the answer to this one.
bool receive_message(int socket, std::string& bytes) {
  char part[4096];
  for (bytes.clear(); !is_message(bytes);) {
    const ssize_t got = recv(socket, part, sizeof part, 0);
    if (got == 0 || (got < 0 && errno != EINTR)) return false;
    if (got > 0) bytes.append(part, static_cast<std::size_t>(got));
  }
  bytes.erase(0, sizeof(std::size_t));
  return true;
}

void make_sockets(int (&ends)[2]) {
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) fail("cannot create a socket");
}

}  // namespace

Children::~Children() {
  running_.insert(running_.end(), free_.begin(), free_.end());
  kill_from(0);
}

// In the child: skips the cleanup of the parent's objects.
void Children::carry_out(int jobs, int errors) const {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  setpgid(0, 0);  // a signal to the parent's group, as by timeout(1), is the parent's only: it decides when to stop
  const int nowhere = open("/dev/null", O_RDWR | O_CLOEXEC);
  dup2(nowhere, STDIN_FILENO);
  dup2(nowhere, STDOUT_FILENO);
  dup2(errors, STDERR_FILENO);
  std::signal(SIGINT, SIG_IGN);
  std::signal(SIGTERM, SIG_DFL);
  try {
    for (std::string job; receive_message(jobs, job);)
      if (!send_message(jobs, work_(job)) || !limits_.is_reused) break;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    std::fflush(stderr);
    _exit(1);
  }
  _exit(0);
}

Children::Running Children::make() const {
  int jobs[2], errors[2];
  make_sockets(jobs);
  make_sockets(errors);
  std::fflush(nullptr);  // a child would write buffered output a second time
  const pid_t process = fork();
  if (process < 0) fail("cannot create a process");
  if (process == 0) {
    for (const auto* others : {&running_, &free_})
      for (const Running& other : *others) close(other.jobs);
    close(jobs[0]);
    carry_out(jobs[1], errors[1]);
  }
  close(jobs[1]);
  close(errors[1]);
  return {process, jobs[0], errors[0]};
}

void Children::start(std::uint64_t number, const std::string& job) {
  if (free_.empty()) free_.push_back(make());
  Running& child = running_.emplace_back(std::move(free_.back()));
  free_.pop_back();
  child.so_far = {number, 0, "", ""};
  child.started_s = child.looked_s = wall_clock_s();
  (void)send_message(child.jobs, job);  // a missing receiver is noticed when no bytes come
}

void Children::drain(int socket, std::string& to, std::size_t most, bool& at_end) {
  char part[65536];
  for (;;) {
    const ssize_t got = recv(socket, part, sizeof part, MSG_DONTWAIT);
    if (got < 0 && errno == EINTR) continue;
    at_end = got == 0;
    if (got <= 0) return;
    to.append(part, std::min(static_cast<std::size_t>(got), most - std::min(most, to.size())));
    if (static_cast<std::size_t>(got) < sizeof part) return;
  }
}

Children::Ended Children::reap(std::size_t index) {
  Running running = std::move(running_[index]);
  running_.erase(running_.begin() + static_cast<std::ptrdiff_t>(index));
  while (waitpid(running.process, &running.so_far.status, 0) < 0 && errno == EINTR) {
  }
  bool at_end = false;
  drain(running.errors, running.so_far.errors, errors_max, at_end);
  close(running.jobs);
  close(running.errors);
  return std::move(running.so_far);
}

// The result of a child that has done its job.
Children::Ended Children::take(std::size_t index) {
  Ended ended = limits_.is_reused ? running_[index].so_far : reap(index);
  if (limits_.is_reused) {
    free_.push_back(std::move(running_[index]));
    running_.erase(running_.begin() + static_cast<std::ptrdiff_t>(index));
  }
  ended.bytes.erase(0, sizeof(std::size_t));
  return ended;
}

std::optional<Children::Ended> Children::wait(int timeout_ms) {
  std::vector<pollfd> sockets;
  for (const Running& running : running_) {
    sockets.push_back({running.jobs, POLLIN, 0});
    sockets.push_back({running.errors, POLLIN, 0});
  }
  const int ready = poll(sockets.data(), sockets.size(), timeout_ms);
  end_those_beyond_limits();
  if (ready <= 0) return std::nullopt;
  for (std::size_t i = 0; i < running_.size(); ++i) {
    bool at_end = false, errors_end = false;
    if (sockets[2 * i + 1].revents != 0) drain(running_[i].errors, running_[i].so_far.errors, errors_max, errors_end);
    if (sockets[2 * i].revents != 0) drain(running_[i].jobs, running_[i].so_far.bytes, std::string::npos, at_end);
    // Its earlier standard error is there, too.
    if (is_message(running_[i].so_far.bytes)) return take(i);
    if (at_end) return reap(i);
  }
  return std::nullopt;
}

// Called at intervals: there may be hundreds of short children a second. The next wait() returns the killed ones.
void Children::end_those_beyond_limits() {
  const double now_s = wall_clock_s();
  if (now_s < next_look_s_) return;
  next_look_s_ = now_s + between_looks_s;
  for (Running& running : running_) {
    if (!running.so_far.killed_for.empty()) continue;
    const std::optional<std::uint64_t> ticks = exploration::ticks_of(running.process);
    if (!limits_.computes || !ticks || *ticks != running.ticks) running.looked_s = now_s;
    running.ticks = ticks.value_or(running.ticks);
    if (now_s - running.looked_s >= exploration::idle_s_max)
      running.so_far.killed_for = "blocked for " + std::to_string(exploration::idle_s_max) +
                                  " s outside the simulation (a real lock or input); process killed";
    else if (limits_.wall_s > 0 && now_s - running.started_s >= limits_.wall_s)
      running.so_far.killed_for = "exceeded " + std::to_string(static_cast<long>(limits_.wall_s)) +
                                  " s of wall clock time (--schedule-limit); process killed";
    if (!running.so_far.killed_for.empty()) kill(running.process, SIGKILL);
  }
}

std::optional<Children::Ended> Children::stop_longest(double patience_s) {
  constexpr double long_s = 1;
  const auto longest = std::ranges::min_element(running_, {}, &Running::started_s);
  const double now_s = wall_clock_s();
  if (longest == running_.end() || now_s - longest->started_s < long_s) return std::nullopt;
  const std::uint64_t number = longest->so_far.number;
  kill(longest->process, SIGTERM);
  while (!running_.empty() && wall_clock_s() - now_s < patience_s)
    if (std::optional<Ended> ended = wait(100); ended && ended->number == number) return ended;
  return std::nullopt;
}

void Children::kill_from(std::uint64_t number) {
  for (std::size_t i = running_.size(); i-- > 0;) {
    if (running_[i].so_far.number < number) continue;
    kill(running_[i].process, SIGKILL);
    (void)reap(i);
  }
}

std::string death_of(const Children::Ended& ended) {
  std::string text = ended.killed_for;
  if (!text.empty()) return text;
  if (WIFSIGNALED(ended.status))
    text = "the process was killed by " + signal_in_words(WTERMSIG(ended.status));
  else if (WEXITSTATUS(ended.status) != 0 || ended.bytes.empty())
    text = "the process ended with status " + std::to_string(WEXITSTATUS(ended.status));
  if (!text.empty() && !ended.errors.empty()) text += ", with standard error:\n" + ended.errors;
  while (!text.empty() && text.back() == '\n') text.pop_back();
  return text;
}

}  // namespace waitpoint::tools
