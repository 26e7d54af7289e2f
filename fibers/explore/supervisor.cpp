// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/explore/supervisor.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fstream>

namespace waitpoint::exploration {

namespace {

enum class Doing : std::uint8_t { nothing, default_schedule, schedule, minimizing };

// After so many seconds a schedule is told to go on for long.
constexpr int long_s = 10;

bool is_traced() {
  std::ifstream status("/proc/self/status");
  std::string word;
  while (status >> word)
    if (word == "TracerPid:") return status >> word && word != "0";
  return false;
}

}  // namespace

struct Supervisor::Shared {
  std::atomic<std::uint64_t> number;
  std::atomic<Doing> doing;
  std::atomic<bool> done;
  char failure[400];
};

Supervisor* Supervisor::latest_ = nullptr;

Supervisor::Supervisor(const Token& token, const std::string& replay, const std::string& after) {
  if (is_traced()) return;
  static const int registered = std::atexit(refuse_exit);
  (void)registered;
  explored_ = getpid();
  outer_ = latest_;
  latest_ = this;
  void* memory = mmap(nullptr, sizeof(Shared), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) return;
  shared_ = static_cast<Shared*>(memory);
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) return;
  std::fflush(nullptr);  // or what is buffered would be written twice
  process_ = fork();
  if (process_ == 0) {
    close(ends[1]);
    wait_for_the_end(ends[0], token, replay, after);
  }
  close(ends[0]);
  pipe_ = ends[1];
}

// A test program that ends within a schedule has not passed, whatever status the body would have it leave with.
void Supervisor::refuse_exit() {
  if (latest_ == nullptr || latest_->shared_ == nullptr || latest_->shared_->doing == Doing::nothing) return;
  if (latest_->explored_ != getpid()) return;  // a process that the body forked
  std::fflush(nullptr);
  _exit(1);
}

Supervisor::~Supervisor() {
  if (latest_ == this) latest_ = outer_;
  if (shared_ != nullptr) shared_->done = true;
  // Not the end of the pipe alone: processes that a debugger or the body forked may have it open still.
  if (pipe_ >= 0) {
    (void)!write(pipe_, "", 1);
    close(pipe_);
  }
  if (process_ > 0) waitpid(process_, nullptr, 0);
  if (shared_ != nullptr) munmap(shared_, sizeof(Shared));
}

void Supervisor::begin_default() {
  if (shared_ != nullptr) shared_->doing.store(Doing::default_schedule, std::memory_order_relaxed);
}

void Supervisor::begin(std::uint64_t number) {
  if (shared_ == nullptr) return;
  shared_->number.store(number, std::memory_order_relaxed);
  shared_->doing.store(Doing::schedule, std::memory_order_relaxed);
}

void Supervisor::begin_minimizing(std::uint64_t number, const std::string& failure) {
  if (shared_ == nullptr) return;
  shared_->number.store(number, std::memory_order_relaxed);
  std::snprintf(shared_->failure, sizeof shared_->failure, "%s", failure.c_str());
  shared_->doing.store(Doing::minimizing, std::memory_order_relaxed);
}

void Supervisor::pause() {
  if (shared_ != nullptr) shared_->doing.store(Doing::nothing, std::memory_order_relaxed);
}

// Until it is told that it is over, or the explored process is gone.
void Supervisor::tell_of_long_schedules(int pipe, const Token& token, const std::string& replay,
                                        const std::string& after) {
  pollfd end{pipe, POLLIN, 0};
  std::uint64_t number = 0;
  Doing doing = Doing::nothing;
  for (int seconds = 0; poll(&end, 1, 1000) == 0; ++seconds) {
    if (doing == Doing::nothing || shared_->doing != doing || shared_->number != number) seconds = 0;
    doing = shared_->doing;
    number = shared_->number;
    if (seconds != long_s || doing == Doing::minimizing) continue;
    Token going = token;
    going.number = number;
    if (doing == Doing::default_schedule) going.strategy.clear();
    const std::string text =
        "waitpoint: " + (going.strategy.empty() ? "the default schedule" : "schedule " + std::to_string(number)) +
        " has gone on for " + std::to_string(long_s) +
        " s; where a task loops without any simulated primitive, or waits for a real one, it will for ever\n" + replay +
        to_text(going) + after + "\n";
    (void)!write(STDERR_FILENO, text.data(), text.size());
  }
}

// In the supervisor: it is told, or the pipe's other end is closed when the explored process is gone, however it went.
void Supervisor::wait_for_the_end(int pipe, const Token& token, const std::string& replay, const std::string& after) {
  setsid();
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT}) std::signal(signal, SIG_IGN);
  tell_of_long_schedules(pipe, token, replay, after);
  const Doing doing = shared_->doing;
  if (!shared_->done && doing != Doing::nothing) {
    Token failed = token;
    failed.number = shared_->number;
    std::string text = "waitpoint: the process ended ";
    if (doing == Doing::default_schedule) {
      text += "within the default schedule";
      failed.strategy.clear();
    } else if (doing == Doing::schedule) {
      text += "within schedule " + std::to_string(failed.number);
    } else {
      text += "while the failure of schedule " + std::to_string(failed.number) +
              " was cut down, by a run of it with fewer switches. It had failed: " + shared_->failure;
    }
    text += "\n" + replay + to_text(failed) + after + "\n";
    (void)!write(STDERR_FILENO, text.data(), text.size());
  }
  _exit(0);
}

}  // namespace waitpoint::exploration
