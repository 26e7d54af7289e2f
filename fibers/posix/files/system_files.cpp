// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/files/system_files.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>

#include "core/digest.hpp"
#include "fibers/kernel/run.hpp"
#include "fibers/posix/base/argument_memory.hpp"
#include "fibers/posix/base/interposed.hpp"
#include "fibers/posix/family/family.hpp"
#include "fibers/posix/files/machine.hpp"
#include "fibers/posix/files/process_files.hpp"
#include "fibers/posix/files/text_file.hpp"
#include "fibers/posix/program/program.hpp"
#include "fibers/posix/program/randomness.hpp"
#include "fibers/posix/program/repeatability.hpp"
#include "fibers/posix/time/clocks.hpp"

namespace waitpoint::posix {
namespace {

using Count = unsigned long long;

void write_uptime(TextFile& text) {
  const Count hundredths = static_cast<Count>(MachineState().uptime_ns) / 10'000'000;
  text.add("%llu.%02llu %llu.%02llu\n", hundredths / 100, hundredths % 100, hundredths / 100, hundredths % 100);
}

void write_loads(TextFile& text) {
  const pid_t last = family::family != nullptr ? family::family->last_id : 1;
  text.add("0.00 0.00 0.00 1/%d %d\n", MachineState().processes, static_cast<int>(last));
}

void write_stat(TextFile& text) {
  const MachineState machine;
  const Count idle = static_cast<Count>(machine.uptime_ns) / 10'000'000;
  const long processors = sysconf(_SC_NPROCESSORS_ONLN);
  text.add("cpu  0 0 0 %llu 0 0 0 0 0 0\n", idle * static_cast<Count>(processors));
  for (long i = 0; i < processors; ++i) text.add("cpu%ld 0 0 0 %llu 0 0 0 0 0 0\n", i, idle);
  text.add("intr 0\nctxt 0\nbtime %lld\nprocesses %d\nprocs_running 1\nprocs_blocked 0\nsoftirq 0\n",
           static_cast<long long>(first_date_s - first_uptime_s), machine.processes);
}

void write_memory(TextFile& text) {
  const Count all = MachineState().memory_bytes / 1024;
  const auto line = [&text](const char* name, Count kib) { text.add("%-16s%8llu kB\n", name, kib); };
  line("MemTotal:", all);
  line("MemFree:", all / 2);
  line("MemAvailable:", all / 2);
  for (const char* const name :
       {"Buffers:", "Cached:", "SwapCached:", "Active:", "Inactive:", "SwapTotal:", "SwapFree:", "Dirty:", "Writeback:",
        "AnonPages:", "Mapped:", "Shmem:", "Slab:", "SReclaimable:", "SUnreclaim:", "Committed_AS:"})
    line(name, 0);
}

void write_uuid(TextFile& text, std::uint64_t high, std::uint64_t low) {
  text.add("%08llx-%04llx-4%03llx-%04llx-%012llx\n", Count{high >> 32}, Count{high >> 16 & 0xFFFF}, Count{high & 0xFFF},
           Count{(low >> 48 & 0x3FFF) | 0x8000}, Count{low & 0xFFFF'FFFF'FFFF});
}
void write_random_uuid(TextFile& text) {
  const std::uint64_t high = draw_random(), low = draw_random();
  write_uuid(text, high, low);
}
void write_boot_uuid(TextFile& text) {
  const std::uint64_t seed = kernel::chooser(*kernel::running->scheduler).seed();
  write_uuid(text, Digest::mix(seed), Digest::mix(seed + 1));
}
void write_entropy(TextFile& text) { text.add("256\n"); }

constexpr struct {
  const char* path;
  void (*write)(TextFile&);
} files_of_machine[] = {
    {"/proc/uptime", write_uptime},
    {"/proc/loadavg", write_loads},
    {"/proc/stat", write_stat},
    {"/proc/meminfo", write_memory},
    {"/proc/sys/kernel/random/uuid", write_random_uuid},
    {"/proc/sys/kernel/random/boot_id", write_boot_uuid},
    {"/proc/sys/kernel/random/entropy_avail", write_entropy},
};

// Files and folders that are the system's, and differ.
constexpr const char* unrepeatable[] = {
    "/proc/buddyinfo",
    "/proc/diskstats",
    "/proc/interrupts",
    "/proc/key-users",
    "/proc/keys",
    "/proc/kmsg",
    "/proc/locks",
    "/proc/net",
    "/proc/pagetypeinfo",
    "/proc/pressure",
    "/proc/schedstat",
    "/proc/slabinfo",
    "/proc/softirqs",
    "/proc/swaps",
    "/proc/sys/fs",
    "/proc/sys/kernel/ns_last_pid",
    "/proc/sys/kernel/pty",
    "/proc/sysvipc",
    "/proc/timer_list",
    "/proc/vmstat",
    "/proc/zoneinfo",
    "/sys/block",
    "/sys/class",
    "/sys/fs/cgroup",
    "/sys/kernel",
    "/dev/cpu",
    "/dev/hwrng",
    "/dev/input",
    "/dev/rtc",
};
constexpr const char* unrepeatable_of_process[] = {
    "/net", "/numa_maps", "/oom_score", "/pagemap", "/sched", "/smaps", "/smaps_rollup", "/stack", "/syscall",
};

// Of these, the ones that tell of nothing but the network of a run's own machine.
constexpr const char* of_own_network[] = {"/proc/net/dev", "/proc/net/if_inet6", "/proc/net/route",
                                          "/proc/net/wireless"};
bool is_of_own_network(const char* path) {
  const auto is_path = [path](const char* each) { return std::strcmp(each, path) == 0; };
  return record->settings.own_machine && std::ranges::any_of(of_own_network, is_path);
}

bool begins_path(const char* beginning, const char* path) {
  const std::size_t length = std::strlen(beginning);
  return std::strncmp(path, beginning, length) == 0 && (path[length] == '\0' || path[length] == '/');
}

}  // namespace

void note_use_of(const char* path) {
  if (!is_simulated() || !record->settings.strict || path == nullptr || !can_be_read(path)) return;
  for (const char* const each : unrepeatable)
    if (begins_path(each, path) && !is_of_own_network(path)) note_unrepeatable(path);
  const ProcessPath of_process(path);
  if (of_process.is_by_number && of_process.process == nullptr) note_unrepeatable(path);
  for (const char* const each : unrepeatable_of_process)
    if (of_process.process != nullptr && begins_path(each, of_process.rest)) note_unrepeatable(path);
}

int open_generated(const char* path, int flags) {
  if ((flags & O_ACCMODE) != O_RDONLY || (flags & (O_PATH | O_DIRECTORY)) != 0) return not_generated;
  const bool close_on_exec = (flags & O_CLOEXEC) != 0;
  for (const auto& file : files_of_machine) {
    if (std::strcmp(file.path, path) != 0) continue;
    TextFile text;
    file.write(text);
    return text.finish(close_on_exec);
  }
  const ProcessPath of_process(path);
  if (of_process.process == nullptr) return not_generated;
  TextFile text;
  if (write_process_file(of_process, text)) return text.finish(close_on_exec);
  WAITPOINT_NEXT(close)(text.finish(true));
  return not_generated;
}

}  // namespace waitpoint::posix
