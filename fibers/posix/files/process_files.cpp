// SPDX-License-Identifier: BSD-3-Clause
//
// The system's text, with other values where its own differ from run to run.
#include "fibers/posix/files/process_files.hpp"

#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "fibers/posix/base/interposed.hpp"
#include "fibers/posix/files/machine.hpp"
#include "fibers/posix/program/program.hpp"
#include "fibers/posix/signals/signals.hpp"
#include "fibers/posix/time/clocks.hpp"

namespace waitpoint::posix {
namespace {

using family::Process;

constexpr std::uint64_t page = 4096, kibibyte = 1024;
constexpr std::int64_t tick_ns = 10'000'000;

int threads_of(const Process& process) {
  if (&process != family::own) return 1;
  int count = 0;
  for (const kernel::Task* task = first_task(); task != nullptr; task = task->next) count += is_thread(*task);
  return count;
}

char state_of(const Process& process) {
  switch (process.state) {
    case Process::State::stopped: return 'T';
    case Process::State::ended: return 'Z';
    default: return &process == family::own ? 'R' : 'S';
  }
}

// The fields behind the name, from the third on, as proc(5) numbers them.
void write_stat(const Process& process, char* system, TextFile& text) {
  char* const behind = std::strrchr(system, ')');
  const char* const name = std::strchr(system, '(');
  if (behind == nullptr || name == nullptr || behind[1] == '\0') return;
  behind[1] = '\0';
  text.add("%d %s %c", static_cast<int>(process.id), name, state_of(process));
  const std::int64_t used = &process == family::own ? reading_ns(CLOCK_PROCESS_CPUTIME_ID, Time()) / tick_ns : 0;
  char* rest = nullptr;
  int field = 3;
  for (const char* word = strtok_r(behind + 2, " \n", &rest); word != nullptr;
       word = strtok_r(nullptr, " \n", &rest), ++field) {
    const auto number = [&]() -> long long {
      switch (field) {
        case 4: return process.parent;
        case 5: return process.group;
        case 6: return process.session;
        case 14: return used;
        case 20: return threads_of(process);
        case 22: return first_uptime_s * 1'000'000'000 / tick_ns;
        case 23: return process_memory_bytes;
        case 24: return process_memory_bytes / page;
        // Flags, page faults, times, the present address, signals, the processor, delays.
        case 9:
        case 10:
        case 11:
        case 12:
        case 13:
        case 15:
        case 16:
        case 17:
        case 21:
        case 29:
        case 30:
        case 31:
        case 32:
        case 33:
        case 34:
        case 35:
        case 39:
        case 42:
        case 43:
        case 44: return 0;
        default: return -1;
      }
    }();
    if (field == 8) {  // the terminal's group
      text.add(" %s", word);
    } else if (field > 3) {
      number >= 0 ? text.add(" %lld", number) : text.add(" %s", word);
    }
  }
  text.add("\n");
}

SignalSet actions_with(bool (*is_meant)(const struct sigaction&)) {
  SignalSet set = 0;
  for (int signal = 1; signal < signals_end; ++signal)
    if (is_meant(program_now().signals.actions[signal])) set |= only(signal);
  return set;
}

/// A line of the file "status": "Name:\tvalue".
void write_status_line(const Process& process, const char* name, const char* value, TextFile& text) {
  const bool is_own = &process == family::own;
  const auto is = [name](const char* other) { return std::strcmp(name, other) == 0; };
  const auto add_set = [&](SignalSet set) { text.add("%s:\t%016llx\n", name, static_cast<unsigned long long>(set)); };
  if (is("Pid") || is("Tgid") || is("NSpid") || is("NStgid")) return text.add("%s:\t%d\n", name, process.id);
  if (is("PPid")) return text.add("%s:\t%d\n", name, process.parent);
  if (is("NSpgid")) return text.add("%s:\t%d\n", name, process.group);
  if (is("NSsid")) return text.add("%s:\t%d\n", name, process.session);
  if (is("Threads")) return text.add("%s:\t%d\n", name, threads_of(process));
  if (is("TracerPid") || is("Seccomp") || is("Seccomp_filters") || is("NoNewPrivs")) return text.add("%s:\t0\n", name);
  if (is("voluntary_ctxt_switches") || is("nonvoluntary_ctxt_switches")) return text.add("%s:\t0\n", name);
  if (is("State")) {
    const char state = state_of(process);
    const char* const word = state == 'R' ? "running" : state == 'S' ? "sleeping" : state == 'T' ? "stopped" : "zombie";
    return text.add("State:\t%c (%s)\n", state, word);
  }
  if (is("VmSwap") || is("VmLck") || is("VmPin") || is("RssShmem")) return text.add("%s:\t%8d kB\n", name, 0);
  if (std::strncmp(name, "Vm", 2) == 0 || std::strncmp(name, "Rss", 3) == 0)
    return text.add("%s:\t%8llu kB\n", name, static_cast<unsigned long long>(process_memory_bytes / kibibyte));
  if (is("SigQ")) return text.add("SigQ:\t0%s\n", std::strchr(value, '/') != nullptr ? std::strchr(value, '/') : "");
  if (is("SigBlk")) return add_set(is_own ? this_thread().blocked : 0);
  if (is("SigPnd")) return add_set(is_own ? this_thread().pending.set() : 0);
  if (is("ShdPnd")) return add_set(is_own ? program_now().signals.pending.set() : 0);
  const auto is_ignored = [](const struct sigaction& action) { return action.sa_handler == SIG_IGN; };
  const auto is_caught = [](const struct sigaction& action) {
    return action.sa_handler != SIG_IGN && action.sa_handler != SIG_DFL;
  };
  if (is("SigIgn")) return add_set(is_own ? actions_with(is_ignored) : 0);
  if (is("SigCgt")) return add_set(is_own ? actions_with(is_caught) : 0);
  text.add("%s:%s\n", name, value);
}

void write_status(const Process& process, char* system, TextFile& text) {
  char* rest = nullptr;
  for (char* line = strtok_r(system, "\n", &rest); line != nullptr; line = strtok_r(nullptr, "\n", &rest)) {
    char* const colon = std::strchr(line, ':');
    if (colon == nullptr) continue;
    *colon = '\0';
    write_status_line(process, line, colon + 1, text);
  }
}

// Without the memory of the layer's run; inodes are those of files that the program did not make.
void write_maps(char* system, TextFile& text) {
  char* rest = nullptr;
  for (char* line = strtok_r(system, "\n", &rest); line != nullptr; line = strtok_r(nullptr, "\n", &rest)) {
    const unsigned long long begin = std::strtoull(line, nullptr, 16);
    if (begin >= record_address && begin < record_address + run_bytes) continue;
    if (std::strstr(line, "waitpoint-exec (deleted)") == nullptr) text.add("%.500s\n", line);
  }
}

}  // namespace

bool write_process_file(const ProcessPath& path, TextFile& text) {
  const Process& process = *path.process;
  const auto is = [&](const char* name) { return std::strcmp(path.rest, name) == 0; };
  const unsigned long long pages = process_memory_bytes / page;
  if (is("/statm")) return text.add("%llu %llu %llu 1 0 %llu 0\n", pages, pages, pages / 2, pages / 2), true;
  if (is("/schedstat")) return text.add("0 0 0\n"), true;
  if (is("/wchan")) return text.add("0"), true;
  if (is("/io"))
    return text.add(
               "rchar: 0\nwchar: 0\nsyscr: 0\nsyscw: 0\nread_bytes: 0\nwrite_bytes: 0\ncancelled_write_bytes: 0\n"),
           true;
  const bool is_stat = is("/stat"), is_status = is("/status"), is_maps = is("/maps");
  if (!is_stat && !is_status && !is_maps) return false;
  constexpr std::size_t size = 1 << 18;
  auto* const system = static_cast<char*>(std::malloc(size));
  if (system == nullptr) return false;
  char name[64];
  std::snprintf(name, sizeof name, "/proc/%d%s", static_cast<int>(process.real_id.load()), path.rest);
  const bool was_read = read_system_file(name, system, size);
  if (was_read && is_stat) write_stat(process, system, text);
  if (was_read && is_status) write_status(process, system, text);
  if (was_read && is_maps) write_maps(system, text);
  std::free(system);
  return was_read;
}

}  // namespace waitpoint::posix
