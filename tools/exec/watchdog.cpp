// SPDX-License-Identifier: BSD-3-Clause
#include "tools/exec/watchdog.hpp"

#include <fmt/format.h>
#include <sys/uio.h>

#include <cstddef>
#include <ctime>
#include <string>

namespace waitpoint::tools {
namespace {

constexpr double patience_s = 10;  // processor time

double processor_s(pid_t process) {
  clockid_t clock{};
  timespec used{};
  if (clock_getcpuclockid(process, &clock) != 0 || clock_gettime(clock, &used) != 0) return 0;
  return static_cast<double>(used.tv_sec) + 1e-9 * static_cast<double>(used.tv_nsec);
}

bool read(pid_t process, const void* from, void* to, std::size_t size) {
  const iovec here{to, size}, there{const_cast<void*>(from), size};
  return process_vm_readv(process, &here, 1, &there, 1, 0) == static_cast<ssize_t>(size);
}

// The name of the program's running thread; empty if unknown.
std::string running_thread(const posix::Record& record, pid_t process) {
  const char* task = nullptr;
  char name[kernel::name_size] = {};
  if (!read(process, record.running, &task, sizeof task) || task == nullptr) return "";
  if (!read(process, task + offsetof(kernel::Task, name), name, sizeof name)) return "";
  name[sizeof name - 1] = '\0';
  return name;
}

}  // namespace

std::string Watchdog::look() {
  if (!record_.began) return "";
  const double now_s = processor_s(program_);
  if (const std::uint64_t events = record_.scheduler.events(); events != events_ || since_s_ == 0) {
    events_ = events;
    since_s_ = now_s;
    told_ = false;
  }
  if (told_ || now_s - since_s_ < patience_s) return "";
  told_ = true;
  const std::string thread = running_thread(record_, program_);
  return fmt::format(
      "{} has computed for {:.0f} s, at {} s of virtual time, without a simulated call: if it spins until "
      "another\n"
      "           thread acts, it spins forever",
      thread.empty() ? "a thread" : "thread '" + thread + "'", now_s - since_s_,
      to_string(record_.scheduler.global_time()));
}

}  // namespace waitpoint::tools
