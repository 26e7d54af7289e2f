// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/explore/supervisor.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fstream>

namespace waitpoint::exploration {

namespace {

// The process may be blocked anywhere: nothing else is safe.
void end_with_status_1(int signal, siginfo_t* from, void*) {
  if (from->si_code == SI_USER) _exit(1);
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

bool is_traced() {
  std::ifstream status("/proc/self/status");
  std::string word;
  while (status >> word)
    if (word == "TracerPid:") return status >> word && word != "0";
  return false;
}

}  // namespace

Supervisor* Supervisor::latest_ = nullptr;

Supervisor::Supervisor(Supervision supervision) {
  if (is_traced()) return;
  static const int registered = std::atexit(refuse_exit);
  (void)registered;
  explored_ = getpid();
  outer_ = latest_;
  latest_ = this;
  void* memory = mmap(nullptr, sizeof(Supervised), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) return;
  shared_ = static_cast<Supervised*>(memory);
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) return;
  std::fflush(nullptr);  // or buffered output would be written twice
  process_ = fork();
  if (process_ == 0) {
    close(ends[1]);
    supervision.explored = explored_;
    supervise(ends[0], *shared_, supervision);
  }
  close(ends[0]);
  pipe_ = ends[1];
  struct sigaction ending {};
  ending.sa_sigaction = end_with_status_1;
  ending.sa_flags = SA_SIGINFO | SA_ONSTACK;
  if (process_ > 0) sigaction(end_signal, &ending, &before_);
}

// A test program that exits within a schedule has not passed, whatever exit status the body gives.
void Supervisor::refuse_exit() {
  if (latest_ == nullptr || latest_->shared_ == nullptr || latest_->shared_->doing == Stage::nothing) return;
  if (latest_->explored_ != getpid()) return;  // a process that the body forked
  std::fflush(nullptr);
  _exit(1);
}

Supervisor::~Supervisor() {
  if (latest_ == this) latest_ = outer_;
  if (shared_ != nullptr) shared_->done = true;
  // The pipe's end of file is not enough: processes forked by a debugger or the body may keep it open.
  if (pipe_ >= 0) {
    (void)!write(pipe_, &done_message, 1);
    close(pipe_);
  }
  if (process_ > 0) {
    waitpid(process_, nullptr, 0);
    sigaction(end_signal, &before_, nullptr);
  }
  if (shared_ != nullptr) munmap(shared_, sizeof(Supervised));
}

void Supervisor::begin(Stage doing) {
  if (shared_ == nullptr) return;
  shared_->turn.store(shared_->turn.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
  shared_->doing.store(doing, std::memory_order_relaxed);
}

void Supervisor::begin_default() { begin(Stage::default_schedule); }

void Supervisor::begin_replay() { begin(Stage::replay); }

void Supervisor::begin(std::uint64_t number, const char* strategy) {
  if (shared_ == nullptr) return;
  shared_->strategy.store(strategy, std::memory_order_relaxed);
  shared_->number.store(number, std::memory_order_relaxed);
  begin(Stage::schedule);
}

void Supervisor::begin_minimizing(std::uint64_t number, const char* strategy, const std::string& failure) {
  if (shared_ == nullptr) return;
  shared_->strategy.store(strategy, std::memory_order_relaxed);
  shared_->number.store(number, std::memory_order_relaxed);
  std::snprintf(shared_->failure, sizeof shared_->failure, "%s", failure.c_str());
  begin(Stage::minimizing);
}

std::optional<std::uint64_t> Supervisor::outcome_when_fresh(const Token& token) {
  if (process_ <= 0) return std::nullopt;
  shared_->fresh = Fresh::asked;
  const std::string text = asks_for_fresh + to_text(token) + '\n';
  for (std::size_t at = 0; at < text.size();) {
    const ssize_t written = write(pipe_, text.data() + at, text.size() - at);
    if (written <= 0) return std::nullopt;
    at += static_cast<std::size_t>(written);
  }
  while (shared_->fresh == Fresh::asked)
    if (usleep(100); waitpid(process_, nullptr, WNOHANG) != 0) return std::nullopt;  // the supervisor has ended
  return shared_->fresh == Fresh::known ? std::optional(shared_->fresh_outcome.load()) : std::nullopt;
}

void Supervisor::pause() {
  if (shared_ != nullptr) shared_->doing.store(Stage::nothing, std::memory_order_relaxed);
}

}  // namespace waitpoint::exploration
