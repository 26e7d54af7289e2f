// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/reruns/rerun.hpp"

#include <linux/futex.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include "core/error.hpp"
#include "fibers/kernel/scheduler.hpp"
#include "fibers/posix/base/direct_call.hpp"
#include "fibers/posix/base/stack_switch.hpp"
#include "fibers/posix/family/processes.hpp"
#include "fibers/posix/program/program.hpp"
#include "fibers/posix/program/waitable.hpp"
#include "fibers/posix/reports/race_log.hpp"
#include "fibers/posix/reruns/memory_image.hpp"
#include "fibers/posix/reruns/rerun_control.hpp"
#include "fibers/posix/traps/access_breakpoints.hpp"
#include "fibers/posix/traps/followed_calls.hpp"
#include "fibers/posix/traps/instruction_copies.hpp"
#include "fibers/posix/traps/library_calls.hpp"
#include "fibers/posix/traps/raw_calls.hpp"
#include "fibers/switch/reserved_pages.hpp"
#include "fibers/switch/thread_pointer.hpp"

namespace waitpoint::posix {
namespace {

// An address that no program uses.
constexpr std::uintptr_t kept_address = 0x2900'0000'0000;
constexpr std::size_t room_bytes = std::size_t{1} << 27;

// Reserved address space, of which few pages are used: they are zero at the beginning of each run.
class Zeroed {
 public:
  static constexpr std::size_t most = 16;

  void find();
  /// Zeroes the pages that are used.
  void zero(const PageMap& map);
  /// The same after a run that has used no other pages than the runs before.
  void zero_again() const;
  std::span<const Pages> all() const { return {all_, count_}; }

 private:
  void add(Pages pages);

  static constexpr std::size_t used_most = 1024;  // 64 ranges of each
  Pages all_[most];
  Pages used_[used_most];
  std::size_t count_, used_count_;
};

// All that is not put back.
struct Kept {
  MemoryImage image;
  Zeroed zeroed;
  long faults;     // at the beginning of the run
  void* point[5];  // as of __builtin_setjmp()
  void* thread_pointer;
  unsigned control_of_vectors;
  unsigned short control_of_floats;
  std::uint32_t asked;
  alignas(16) char stack[1 << 16];
  alignas(4096) char room[room_bytes];
};
Kept& kept() { return *reinterpret_cast<Kept*>(kept_address); }

bool makes_reruns = false;

void Zeroed::find() {
  count_ = used_count_ = 0;
  for (const kernel::ReservedPages& each : kernel::kept_pages()) {
    const auto begin = reinterpret_cast<std::uintptr_t>(each.memory);
    add({begin, begin + (each.bytes + page_bytes - 1) / page_bytes * page_bytes});
  }
  const auto [begin, end] = reserved_for_waitables();
  if (begin != end) add({begin, end});
  if (const LibraryRange copies = reserved_for_copies(); copies.begin != copies.end) add({copies.begin, copies.end});
}

void Zeroed::add(Pages pages) {
  WAITPOINT_CHECK(count_ < most, "more pages are reserved than can be discarded");
  all_[count_++] = pages;
}

void Zeroed::zero(const PageMap& map) {
  used_count_ = 0;
  for (const Pages& pages : all()) map.find_used(pages, [this](const Pages& used) { used_[used_count_++] = used; });
  zero_again();
}

// Pages that stay need not be allocated again.
void Zeroed::zero_again() const {
  for (const Pages* each = used_; each != used_ + used_count_; ++each) {
    std::uintptr_t at = each->begin;
    std::size_t words = (each->end - each->begin) / sizeof(std::uint64_t);
    asm volatile("rep stosq" : "+D"(at), "+c"(words) : "a"(0) : "memory");
  }
}

bool take_image() {
  const long memory = call_directly(SYS_mmap, kept_address, sizeof(Kept), PROT_READ | PROT_WRITE,
                                    MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE | MAP_FIXED_NOREPLACE, -1, 0);
  if (memory != static_cast<long>(kept_address)) return false;
  kept().zeroed.find();
  Pages excluded[Zeroed::most + 1];
  std::size_t count = 0;
  for (const Pages& each : kept().zeroed.all()) excluded[count++] = each;
  excluded[count++] = {kept_address, kept_address + sizeof(Kept)};
  kept().faults = -1;
  kept().thread_pointer = kernel::thread_pointer();
  asm volatile("stmxcsr %0\n\tfnstcw %1" : "=m"(kept().control_of_vectors), "=m"(kept().control_of_floats));
  const auto room = reinterpret_cast<std::uintptr_t>(kept().room);
  return kept().image.take({excluded, count}, {room, room + room_bytes});
}

bool can_map_again(LibraryRange range) { return kept().image.has_anonymous({range.begin, range.end}); }

long futex(std::atomic<std::uint32_t>& word, int operation, std::uint32_t value) {
  return call_directly(SYS_futex, reinterpret_cast<long>(&word), operation, value);
}

// Of reserved pages that were used, and of memory. False if the system does not tell which pages were written.
bool restore_memory(bool is_as_before) {
  if (is_as_before) {
    kept().image.restore_again();
    kept().zeroed.zero_again();
    return true;
  }
  const PageMap map;
  if (!kept().image.restore(map)) return false;
  kept().zeroed.zero(map);
  return true;
}

// On the kept stack.
void put_back(void*) {
  RerunControl& control = rerun_control();
  const bool is_as_before = page_faults() == kept().faults && !have_calls_discarded();
  restore_code();
  undo_calls();
  kernel::set_thread_pointer(kept().thread_pointer);
  asm volatile("ldmxcsr %0\n\tfldcw %1" : : "m"(kept().control_of_vectors), "m"(kept().control_of_floats));
  const bool is_restored = restore_memory(is_as_before);
  kept().faults = page_faults();
  kept().asked = control.asked.load();
  control.ended.store(is_restored ? RerunControl::in_place : RerunControl::not_yet);
  if (!is_restored) call_directly(SYS_exit_group, WEXITSTATUS(control.status));
  futex(control.ended, FUTEX_WAKE, 1);
  while (control.asked.load() == kept().asked) futex(control.asked, FUTEX_WAIT, kept().asked);
  if (control.is_to_leave) call_directly(SYS_exit_group, 0);
  __builtin_longjmp(kept().point, 1);
}

}  // namespace

namespace {

// Null without address space.
void* reserve_kept_pages(std::size_t bytes) {
  {
    const kernel::PagesKept kept;
    if (void* const memory = kernel::reserve_pages(bytes); memory != nullptr) kernel::release_pages(memory, bytes);
  }
  return kernel::reserve_pages(bytes);
}

}  // namespace

void prepare_reruns() {
  reserve_waitables();
  constexpr std::size_t for_races = std::size_t{1} << 32;
  if (has_race_runtime() && kernel::Scheduler::has_address_space()) {
    if (void* const memory = reserve_kept_pages(for_races); memory != nullptr) use_pages_for_races(memory, for_races);
    if (void* const memory = reserve_kept_pages(for_breakpoints); memory != nullptr)
      keep_memory_for_breakpoints(memory, for_breakpoints);
    (void)reserve_for_copies();
  }
  kernel::Scheduler::reserve_ahead();
}

[[gnu::noinline]] void begin_reruns() {
  if (!record->settings.makes_reruns || !are_raw_calls_trapped() || are_library_calls_trapped()) return;
  makes_reruns = true;
  follow_all_calls(can_map_again);
  if (take_image()) {
    (void)__builtin_setjmp(kept().point);
    return;
  }
  makes_reruns = false;
  trap_raw_calls_of_child();
}

void rerun_instead_of_ending(int status) {
  if (!makes_reruns || !are_calls_undoable() || family::family->made > 1) return;
  rerun_control().status = W_EXITCODE(status & 0xFF, 0);
  call_on(kept().stack, sizeof kept().stack, put_back, nullptr);
}

}  // namespace waitpoint::posix
