// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/reruns/snapshot.hpp"

#include <sched.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <ctime>

#include "fibers/explore/schedules/explorer.hpp"
#include "fibers/posix/base/direct_call.hpp"
#include "fibers/posix/base/stack_switch.hpp"
#include "fibers/posix/family/processes.hpp"
#include "fibers/posix/program/program.hpp"
#include "fibers/posix/reruns/fork_server.hpp"
#include "fibers/posix/reruns/rerun_control.hpp"
#include "fibers/posix/traps/followed_descriptors.hpp"
#include "fibers/posix/traps/raw_calls.hpp"

namespace waitpoint::posix {
namespace {

// A snapshot costs less than a millisecond.
constexpr std::int64_t worth_ns = 5'000'000;

// An address that no program uses.
constexpr std::uintptr_t snapshot_address = 0x2800'0000'0000;
constexpr std::size_t shared_max = std::size_t{1} << 28, output_max = std::size_t{1} << 20;

struct Part {
  void* begin;
  std::size_t bytes;
};

// In the snapshot, what the run's process shares with others.
struct OfSnapshot {
  Part parts[3];
  std::size_t output_bytes;
  long input_offset;
  int socket;
  kernel::Task* running;
  alignas(16) char stack[1 << 16];
  char output[output_max];
  alignas(4096) char shared[shared_max];
};
OfSnapshot& of_snapshot() { return *reinterpret_cast<OfSnapshot*>(snapshot_address); }

std::int64_t processor_ns() {
  timespec used{};
  call_directly(SYS_clock_gettime, CLOCK_PROCESS_CPUTIME_ID, reinterpret_cast<long>(&used));
  return used.tv_sec * std::int64_t{1'000'000'000} + used.tv_nsec;
}

bool makes_snapshots = false;
void (*begin_again)() = nullptr;
std::int64_t last_ns = 0;  // processor time at the last one

void stop_making() {
  makes_snapshots = false;
  trap_raw_calls_of_child();
}

void copy_bytes(void* to, const void* from, std::size_t bytes) {
  asm volatile("rep movsb" : "+D"(to), "+S"(from), "+c"(bytes) : : "memory");
}

bool keep_shared_memory() {
  const auto part = [](void* begin, const void* end) {
    return Part{begin, static_cast<std::size_t>(static_cast<const char*>(end) - static_cast<char*>(begin))};
  };
  family::Family& family = *family::family;
  const Part parts[] = {part(record, record->arena.top()), part(&family, family.processes + family.entries),
                        part(&family + 1, family.arena.top())};
  char* to = of_snapshot().shared;
  for (std::size_t i = 0; i < std::size(parts); ++i) {
    if (parts[i].bytes > static_cast<std::size_t>(of_snapshot().shared + shared_max - to)) return false;
    copy_bytes(to, parts[i].begin, parts[i].bytes);
    of_snapshot().parts[i] = parts[i];
    to += parts[i].bytes;
  }
  return true;
}

// False if there is more output than is kept.
bool keep_streams() {
  of_snapshot().input_offset = call_directly(SYS_lseek, STDIN_FILENO, 0, SEEK_CUR);
  const long bytes = call_directly(SYS_lseek, STDOUT_FILENO, 0, SEEK_CUR);
  if (bytes < 0 || static_cast<std::size_t>(bytes) > output_max) return false;
  of_snapshot().output_bytes = static_cast<std::size_t>(bytes);
  return call_directly(SYS_pread64, STDOUT_FILENO, reinterpret_cast<long>(of_snapshot().output), bytes, 0) == bytes;
}

bool keep() {
  const long memory = call_directly(SYS_mmap, snapshot_address, sizeof(OfSnapshot), PROT_READ | PROT_WRITE,
                                    MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE | MAP_FIXED_NOREPLACE, -1, 0);
  return memory == static_cast<long>(snapshot_address) && keep_shared_memory() && keep_streams();
}
void release() { call_directly(SYS_munmap, snapshot_address, sizeof(OfSnapshot)); }

void restore_shared_memory() {
  const char* from = of_snapshot().shared;
  for (const Part& part : of_snapshot().parts) {
    copy_bytes(part.begin, from, part.bytes);
    from += part.bytes;
  }
}

void restore_streams() {
  call_directly(SYS_lseek, STDIN_FILENO, of_snapshot().input_offset, SEEK_SET);
  const auto output = reinterpret_cast<long>(of_snapshot().output);
  call_directly(SYS_write, STDOUT_FILENO, output, static_cast<long>(of_snapshot().output_bytes));
}

// The connection; the process ends if there is nobody to connect to.
int connected() {
  const RerunControl& control = rerun_control();
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  std::memcpy(address.sun_path, control.listener, control.listener_bytes);
  const long socket = call_directly(SYS_socket, AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0);
  const long size = static_cast<long>(offsetof(sockaddr_un, sun_path) + control.listener_bytes);
  if (call_directly(SYS_connect, socket, reinterpret_cast<long>(&address), size) != 0) call_directly(SYS_exit_group, 0);
  return static_cast<int>(socket);
}

// On the kept stack, in the snapshot; returns in each run.
void serve(void*) {
  const int socket = connected();
  const SnapshotMade made{static_cast<pid_t>(call_directly(SYS_getpid))};
  call_directly(SYS_sendto, socket, reinterpret_cast<long>(&made), sizeof made, MSG_NOSIGNAL);
  serve_runs_of_snapshot(socket, restore_shared_memory);
  restore_streams();
}

// Where the run may make no more: drops the one that saves least, if that is less than one would save that is made now.
// What it has saved, the next one does.
bool make_room(RerunControl& control, std::int64_t now_ns) {
  RerunControl::Snapshot* const end = control.snapshots + control.snapshots_made;
  RerunControl::Snapshot* const least =
      std::min_element(control.snapshots, end, [](const auto& a, const auto& b) { return a.cost_ns < b.cost_ns; });
  if (least == end || least->cost_ns >= now_ns - last_ns) return false;
  call_directly(SYS_kill, least->process, SIGKILL);
  if (least + 1 != end)
    least[1].cost_ns += least->cost_ns;
  else
    last_ns -= least->cost_ns;
  std::copy(least + 1, end, least);
  --control.snapshots_made;
  return true;
}

void begin_again_here() {
  family::own->real_id = static_cast<pid_t>(call_directly(SYS_getpid));
  release();
  begin_again();
  last_ns = 0;
  trap_raw_calls_of_child();
  begin_snapshots(begin_again);
}

}  // namespace

void begin_snapshots(void (*begin)()) {
  begin_again = begin;
  makes_snapshots = rerun_control().room > 0;
  if (makes_snapshots) makes_snapshots = follow_calls_for_snapshots();
}

void offer_snapshot(exploration::Explorer& explorer) {
  if (!makes_snapshots) return;
  RerunControl& control = rerun_control();
  const std::size_t decision = explorer.schedule().decisions.size();
  if (control.at_first_only && (decision > 0 || explorer.has_spun())) return stop_making();
  const std::int64_t now_ns = processor_ns();
  if (now_ns - last_ns < worth_ns) return;
  if (!are_calls_undoable() || family::family->made > 1) return stop_making();
  if (has_open_descriptors_of_run()) return;
  if (control.snapshots_made >= std::min(control.room, RerunControl::snapshots_max) && !make_room(control, now_ns))
    return;
  if (!keep()) {
    release();
    return stop_making();
  }
  const long child = call_directly(SYS_clone, CLONE_PARENT | SIGCHLD);
  if (child == 0) {
    of_snapshot().running = kernel::running;
    kernel::running = nullptr;
    call_on(of_snapshot().stack, sizeof of_snapshot().stack, serve, nullptr);
    kernel::running = of_snapshot().running;
    return begin_again_here();
  }
  release();
  if (child < 0) return stop_making();
  call_directly(SYS_setpgid, child, child);  // it outlives the run, whose group is killed
  control.snapshots[control.snapshots_made++] = {static_cast<int>(child), static_cast<std::uint32_t>(decision),
                                                 now_ns - last_ns};
  last_ns = now_ns;
}

}  // namespace waitpoint::posix
