// SPDX-License-Identifier: BSD-3-Clause
#include "tools/ranks/rank_processes.hpp"

#include <poll.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <system_error>

#include "modules/run/ranks/archive.hpp"

namespace waitpoint::tools {
namespace {

struct Process {
  std::string numbered_by;  ///< the kernel and its name space in which the number is valid
  pid_t number = 0;
  friend void carry(auto& archive, Process& process) { archive(process.numbered_by, process.number); }
};

Process own_process() {
  std::string kernel;
  std::getline(std::ifstream("/proc/sys/kernel/random/boot_id"), kernel);
  std::error_code error;
  const std::string space = std::filesystem::read_symlink("/proc/self/ns/pid", error).string();
  return {kernel + " " + space, getpid()};
}

}  // namespace

RankProcesses::RankProcesses(run::Transport& transport) {
  const Process own = own_process();
  run::Packing packing;
  packing(own);
  for (const std::string_view bytes : transport.gather(packing.bytes(), [](double) {})) {
    Process other;
    run::Unpacking unpacking(bytes);
    unpacking(other);
    const bool is_watched = other.numbered_by == own.numbered_by && other.number != own.number;
    processes_.push_back({other.number, is_watched ? static_cast<int>(syscall(SYS_pidfd_open, other.number, 0)) : -1});
  }
}

RankProcesses::~RankProcesses() {
  for (const Watched& process : processes_)
    if (process.descriptor >= 0) close(process.descriptor);
}

bool RankProcesses::has_ended(int rank) const {
  pollfd process{.fd = processes_[static_cast<std::size_t>(rank)].descriptor, .events = POLLIN, .revents = 0};
  return process.fd >= 0 && poll(&process, 1, 0) == 1;
}

bool RankProcesses::is_stopped(int rank) const {
  const Watched& process = processes_[static_cast<std::size_t>(rank)];
  if (process.descriptor < 0) return false;
  std::string text;
  std::getline(std::ifstream("/proc/" + std::to_string(process.number) + "/stat"), text);
  const std::size_t state = text.rfind(") ");  // after the program's name
  return state + 2 < text.size() && (text[state + 2] == 'T' || text[state + 2] == 't');
}

std::string RankProcesses::ended() const {
  std::string names;
  for (int rank = 0; rank < static_cast<int>(processes_.size()); ++rank)
    if (has_ended(rank)) names += (names.empty() ? "rank " : ", rank ") + std::to_string(rank);
  return names;
}

}  // namespace waitpoint::tools
