// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/files/machine.hpp"

#include <sys/statfs.h>
#include <sys/statvfs.h>
#include <sys/sysinfo.h>
#include <unistd.h>

#include "fibers/posix/base/argument_memory.hpp"
#include "fibers/posix/base/error_number.hpp"
#include "fibers/posix/base/interposed.hpp"
#include "fibers/posix/family/family.hpp"
#include "fibers/posix/program/program.hpp"
#include "fibers/posix/time/clocks.hpp"

namespace waitpoint::posix {
namespace {

// Of struct statfs and statvfs: what is in use differs from run to run.
template <class State>
int with_half_free(int result, State* state) {
  if (result != 0 || !is_simulated()) return result;
  state->f_bfree = state->f_bavail = state->f_blocks / 2;
  state->f_ffree = state->f_files / 2;
  return 0;
}
int with_half_free(int result, struct statvfs64* state) {
  if (with_half_free<struct statvfs64>(result, state) == 0 && is_simulated()) state->f_favail = state->f_ffree;
  return result;
}

}  // namespace

MachineState::MachineState() {
  struct sysinfo real {};
  WAITPOINT_NEXT(sysinfo)(&real);
  memory_bytes = std::uint64_t{real.totalram} * real.mem_unit;
  uptime_ns = reading_ns(CLOCK_MONOTONIC, read_clock());
  processes = 1;
  if (family::family == nullptr) return;
  processes = 0;
  for (const family::Process& each : family::entries())
    processes += each.state == family::Process::State::alive || each.state == family::Process::State::stopped;
}

}  // namespace waitpoint::posix

using namespace waitpoint::posix;

WAITPOINT_INTERPOSED int sysinfo(struct sysinfo* information) noexcept {
  if (!is_simulated()) return WAITPOINT_NEXT(sysinfo)(information);
  if (!can_be_written(information, sizeof *information)) return fail(EFAULT);
  const MachineState machine;
  *information = {};
  information->uptime = machine.uptime_ns / 1'000'000'000;
  information->totalram = machine.memory_bytes;
  information->freeram = machine.memory_bytes / 2;
  information->procs = static_cast<unsigned short>(machine.processes);
  information->mem_unit = 1;
  return 0;
}

WAITPOINT_INTERPOSED long get_avphys_pages() noexcept {
  if (!is_simulated()) return WAITPOINT_NEXT(get_avphys_pages)();
  return static_cast<long>(MachineState().memory_bytes / 2 / 4096);
}
WAITPOINT_INTERPOSED long sysconf(int name) noexcept {
  return is_simulated() && name == _SC_AVPHYS_PAGES ? get_avphys_pages() : WAITPOINT_NEXT(sysconf)(name);
}
WAITPOINT_INTERPOSED int getloadavg(double* loads, int count) noexcept {
  if (!is_simulated()) return WAITPOINT_NEXT(getloadavg)(loads, count);
  const int told = count < 3 ? count : 3;
  for (int i = 0; i < told; ++i) loads[i] = 0;
  return told < 0 ? 0 : told;
}

// Under the C library's names: its headers redirect those without a size to the others.
#define WAITPOINT_SAME_AS(name) extern "C" [[gnu::visibility("default"), gnu::alias(#name)]]

WAITPOINT_INTERPOSED int statfs64(const char* path, struct statfs64* state) noexcept {
  return with_half_free(WAITPOINT_NEXT(statfs64)(path, state), state);
}
WAITPOINT_SAME_AS(statfs64)
[[gnu::nonnull(1, 2)]] int waitpoint_statfs(const char*, struct statfs64*) noexcept __asm__("statfs");
WAITPOINT_INTERPOSED int fstatfs64(int descriptor, struct statfs64* state) noexcept {
  return with_half_free(WAITPOINT_NEXT(fstatfs64)(descriptor, state), state);
}
WAITPOINT_SAME_AS(fstatfs64)
[[gnu::nonnull(2)]] int waitpoint_fstatfs(int, struct statfs64*) noexcept __asm__("fstatfs");
WAITPOINT_INTERPOSED int statvfs64(const char* __restrict path, struct statvfs64* __restrict state) noexcept {
  return with_half_free(WAITPOINT_NEXT(statvfs64)(path, state), state);
}
WAITPOINT_SAME_AS(statvfs64)
[[gnu::nonnull(1, 2)]] int waitpoint_statvfs(const char*, struct statvfs64*) noexcept __asm__("statvfs");
WAITPOINT_INTERPOSED int fstatvfs64(int descriptor, struct statvfs64* state) noexcept {
  return with_half_free(WAITPOINT_NEXT(fstatvfs64)(descriptor, state), state);
}
WAITPOINT_SAME_AS(fstatvfs64)
[[gnu::nonnull(2)]] int waitpoint_fstatvfs(int, struct statvfs64*) noexcept __asm__("fstatvfs");
