// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/family/family.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>

#include "core/error.hpp"
#include "fibers/posix/base/arena.hpp"
#include "fibers/posix/base/error_number.hpp"
#include "fibers/posix/base/interposed.hpp"
#include "fibers/posix/program/program.hpp"
#include "fibers/posix/program/record.hpp"
#include "fibers/posix/signals/signals.hpp"

namespace waitpoint::posix::family {
namespace {

constexpr int processes_max = 1024;
constexpr std::uintptr_t address = record_address + record_bytes;
constexpr std::size_t bytes_max = std::size_t{1} << 34;  // allocated on first use
constexpr std::size_t page = 4096;
static_assert(address % page == 0 && bytes_max % page == 0, "the family's memory is mapped in whole pages");
static_assert(std::atomic<pid_t>::is_always_lock_free && std::atomic<bool>::is_always_lock_free,
              "locks of this process would not protect memory shared with others");
static_assert(sizeof(siginfo_t) == 128, "the system's call copies a siginfo_t as the kernel defines it");

constexpr pid_t expected = -1;  // of a child about to be made

struct Process {
  std::atomic<pid_t> id;  ///< 0: the entry is free
  std::atomic<bool> waits;
  std::atomic<pid_t> waits_for;  ///< the holder of a file lock; 0: none
};

struct Family {
  std::atomic<pid_t> within;  ///< the process in a Section; 0: none
  Process processes[processes_max];
  void* parts[static_cast<int>(Part::count)];
  Arena arena;
};
static_assert(sizeof(Family) % Arena::alignment == 0, "the arena begins behind the family's record");

Family* family = nullptr;
Process* own = nullptr;
Process* child = nullptr;
pid_t own_id = 0;

Family& joined() {
  if (family == nullptr) begin();
  return *family;
}

// Entries of processes that were killed are reused.
Process* free_place() {
  for (Process& process : joined().processes) {
    pid_t id = process.id.load();
    if (id == expected || (id != 0 && lives(id))) continue;
    if (process.id.compare_exchange_strong(id, expected)) {
      process.waits = false;
      process.waits_for = 0;
      return &process;
    }
  }
  return nullptr;
}

void join() {
  if (own == nullptr) own = free_place();
  if (own != nullptr) own->id = this_process();
}

}  // namespace

void begin() {
  void* const memory = mmap(reinterpret_cast<void*>(address), bytes_max, PROT_READ | PROT_WRITE,
                            MAP_SHARED | MAP_ANONYMOUS | MAP_NORESERVE | MAP_FIXED, -1, 0);
  if (memory == MAP_FAILED) refuse("there is no address space for the memory shared by processes");
  WAITPOINT_CHECK(memory == reinterpret_cast<void*>(address), "the family's memory is at another address than agreed");
  family = new (memory) Family();
  family->arena.start(family + 1, static_cast<char*>(memory) + bytes_max);
  own = child = nullptr;
  own_id = 0;
}

void expect_child() {
  join();
  install_bell();
  child = free_place();
}

void note_child(pid_t id) {
  if (child != nullptr) child->id = id > 0 ? id : 0;
  child = nullptr;
}

void begin_as_child() {
  own = child;
  child = nullptr;
  own_id = 0;
  join();
}

pid_t this_process() {
  if (own_id == 0) own_id = getpid();
  return own_id;
}

bool lives(pid_t process) {
  const ErrorNumberKept kept;
  char text[512];
  std::snprintf(text, sizeof text, "/proc/%d/stat", process);
  const int file = WAITPOINT_NEXT(open)(text, O_RDONLY | O_CLOEXEC);
  if (file < 0) return errno != ENOENT && WAITPOINT_NEXT(kill)(process, 0) == 0;
  const ssize_t size = WAITPOINT_NEXT(read)(file, text, sizeof text - 1);
  WAITPOINT_NEXT(close)(file);
  text[size > 0 ? size : 0] = '\0';
  // The state follows the name, which may contain any character.
  const char* const behind = std::strrchr(text, ')');
  return behind != nullptr && behind[1] == ' ' && behind[2] != 'Z' && behind[2] != 'X';
}

bool has_others() {
  if (family == nullptr || own == nullptr) return false;
  for (Process& process : family->processes) {
    pid_t id = process.id.load();
    if (id == 0 || &process == own) continue;
    if (id == expected || lives(id)) return true;
    process.id.compare_exchange_strong(id, 0);
  }
  return false;
}

bool had_others() { return own != nullptr; }

void* take(std::size_t bytes) {
  void* const memory = joined().arena.take(bytes);
  if (memory != nullptr) std::memset(memory, 0, bytes);
  return memory;
}

void* common(Part part, std::size_t bytes) {
  WAITPOINT_CHECK(part < Part::count, "a part of the layer has no place in the family's memory");
  void*& memory = joined().parts[static_cast<int>(part)];
  if (memory == nullptr && bytes > 0) memory = take(bytes);
  return memory;
}

void give(void* memory) {
  WAITPOINT_CHECK(family != nullptr, "memory is given back to a family that has not begun");
  WAITPOINT_CHECK(memory == nullptr || (memory > family && memory < family->arena.top()),
                  "memory given back is not the family's");
  family->arena.give(memory);
}

// The word in front of the first page holds the address of the arena's piece.
void* take_pages(std::size_t bytes) {
  if (bytes > bytes_max) return nullptr;
  auto* const piece = static_cast<char*>(joined().arena.take(bytes + 2 * page));
  if (piece == nullptr) return nullptr;
  char* const pages = reinterpret_cast<char*>((reinterpret_cast<std::uintptr_t>(piece) / page + 2) * page);
  reinterpret_cast<void**>(pages)[-1] = piece;
  madvise(pages, bytes, MADV_REMOVE);
  return pages;
}

void give_pages(void* pages, std::size_t bytes) {
  WAITPOINT_CHECK(reinterpret_cast<std::uintptr_t>(pages) % page == 0, "memory given back begins no page");
  void* const piece = static_cast<void**>(pages)[-1];
  WAITPOINT_CHECK(piece < pages && piece >= static_cast<char*>(pages) - 2 * page,
                  "the word in front of pages given back is no longer the address of their piece");
  madvise(pages, bytes, MADV_REMOVE);
  give(piece);
}

Section::Section(bool needed) : entered_(needed) {
  if (!entered_) return;
  // Sections are short: a process in one for a second was killed there.
  constexpr int patience = 1'000'000;
  for (int tried = 0;; ++tried) {
    pid_t nobody = 0;
    if (joined().within.compare_exchange_weak(nobody, this_process(), std::memory_order_acquire)) return;
    if (tried < 100) continue;
    const ErrorNumberKept kept;
    timespec microsecond{0, 1000};
    WAITPOINT_NEXT(syscall)(SYS_nanosleep, &microsecond, nullptr);
    if (tried % 1000 == 0 && nobody != 0 && (tried > patience || !lives(nobody)))
      family->within.compare_exchange_strong(nobody, 0);
  }
}

Section::~Section() {
  if (entered_) family->within.store(0, std::memory_order_release);
}

void note_waiting(bool waiting) {
  if (own != nullptr) own->waits = waiting;
}

bool note_waiting_for(pid_t holder) {
  if (own == nullptr) return true;
  own->waits_for = holder;
  for (int steps = 0; holder != 0 && steps < processes_max; ++steps) {
    pid_t next = 0;
    for (Process& process : family->processes)
      if (process.id.load() == holder) next = process.waits_for.load();
    if (next == this_process()) {
      own->waits_for = 0;
      return false;
    }
    holder = next;
  }
  return true;
}

void ring() {
  if (own == nullptr) return;
  std::atomic_thread_fence(std::memory_order_seq_cst);
  const ErrorNumberKept kept;
  for (Process& process : family->processes) {
    const pid_t id = process.id.load();
    if (id <= 0 || &process == own || !process.waits.load()) continue;
    siginfo_t information{};
    information.si_signo = bell;
    information.si_code = SI_QUEUE;
    information.si_pid = this_process();
    information.si_value.sival_ptr = family;
    WAITPOINT_NEXT(syscall)(SYS_rt_sigqueueinfo, id, bell, &information);
  }
}

bool is_ring(const siginfo_t& information) {
  return family != nullptr && information.si_code == SI_QUEUE && information.si_value.sival_ptr == family;
}

}  // namespace waitpoint::posix::family
