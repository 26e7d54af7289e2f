// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/explore/supervisor.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <cstdio>

namespace waitpoint::exploration {

struct Supervisor::Shared {
  std::atomic<std::uint64_t> number;
  std::atomic<bool> under_way;
  std::atomic<bool> done;
};

Supervisor::Supervisor(const Token& token, const std::string& replay, const std::string& after) {
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

Supervisor::~Supervisor() {
  if (shared_ != nullptr) shared_->done = true;
  // Not the end of the pipe alone: processes that a debugger or the body forked may have it open still.
  if (pipe_ >= 0) {
    (void)!write(pipe_, "", 1);
    close(pipe_);
  }
  if (process_ > 0) waitpid(process_, nullptr, 0);
  if (shared_ != nullptr) munmap(shared_, sizeof(Shared));
}

void Supervisor::begin(std::uint64_t number) {
  if (shared_ == nullptr) return;
  shared_->number.store(number, std::memory_order_relaxed);
  shared_->under_way.store(true, std::memory_order_relaxed);
}

void Supervisor::pause() {
  if (shared_ != nullptr) shared_->under_way.store(false, std::memory_order_relaxed);
}

// In the supervisor: it is told, or the pipe's other end is closed when the explored process is gone, however it went.
void Supervisor::wait_for_the_end(int pipe, const Token& token, const std::string& replay, const std::string& after) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT}) std::signal(signal, SIG_IGN);
  char byte = 0;
  (void)!read(pipe, &byte, 1);
  if (!shared_->done && shared_->under_way) {
    Token failed = token;
    failed.number = shared_->number;
    std::string text = "waitpoint: the process ended within schedule " + std::to_string(failed.number) + "\n" + replay;
    text += to_text(failed) + after + "\n";
    (void)!write(STDERR_FILENO, text.data(), text.size());
  }
  _exit(0);
}

}  // namespace waitpoint::exploration
