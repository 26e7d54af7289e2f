// SPDX-License-Identifier: BSD-3-Clause
// The kernel's notifications of tasks and happens-before edges, by ThreadSanitizer's interface (switch/sanitizer.hpp),
// and its calls to this runtime alone.
#include <atomic>

#include "core/error.hpp"
#include "fibers/explore/races/detector.hpp"

namespace {

using waitpoint::races::Context;
using waitpoint::races::Detector;

std::uint32_t open_runs = 0;
std::atomic<const void*> thread_of_runs = nullptr;

Context& context(void* fiber) { return *static_cast<Context*>(fiber); }

void note_access(std::uint64_t address, std::uint32_t size, bool writes, bool is_atomic, std::uint64_t place) {
  namespace kind = waitpoint::races::kind;
  using waitpoint::kernel::Operation;
  Detector& detector = Detector::the();
  if (!detector.watching()) return detector.unwatched(1);
  const auto how = static_cast<std::uint8_t>((writes ? kind::write : kind::read) | (is_atomic ? kind::atomic : 0));
  const Operation operation = is_atomic ? Operation::modify : writes ? Operation::store : Operation::load;
  const void* const at = reinterpret_cast<const void*>(place);
  if (address % 8 + size > 8)
    detector.access_range(address, size, how, at, operation);
  else
    detector.access_word(address, size, how, at, operation);
  if (is_atomic && detector.watching())
    detector.atomic_modify(reinterpret_cast<const void*>(address), __ATOMIC_SEQ_CST);
}

const waitpoint::races::Runtime runtime = {
    [] { Detector::the().begin_run(); },
    [](const waitpoint::races::FoundRace*& races) { return Detector::the().found(races); },
    [](bool on) { Detector::the().learn(on); },
    [] { Detector::the().forget_learned(); },
    [](std::uint64_t place) { Detector::the().know(place); },
    [](const waitpoint::races::Listener& listener) { Detector::the().tell(listener); },
    [] { Detector::the().set_outside_apart(); },
    [] { Detector::the().order_by_outside(); },
    [](bool on) { Detector::the().note_unlearned(on); },
    note_access,
    [] { return Detector::the().noted_unlearned(); },
    [](bool on) { Detector::the().set_weak(on); },
    [](std::uint32_t newer) { return Detector::the().readable_store(newer); },
    [] { return Detector::the().left_out_values(); },
    [] { Detector::the().forget_left_out_values(); },
    [](void* zeroed, std::size_t bytes) {
      char* const begin = static_cast<char*>(zeroed);
      waitpoint::races::pages_ahead = {begin, begin, begin + bytes};
    },
};

}  // namespace

constinit waitpoint::races::PagesAhead waitpoint::races::pages_ahead{};

const waitpoint::races::Runtime* waitpoint_races_runtime() { return &runtime; }

extern "C" {

void* __tsan_get_current_fiber();
void* __tsan_create_fiber(unsigned flags);
void __tsan_destroy_fiber(void* fiber);
void __tsan_switch_to_fiber(void* fiber, unsigned flags);
void __tsan_set_fiber_name(void* fiber, const char* name);
void __tsan_acquire(void* address);
void __tsan_release(void* address);
void waitpoint_races_open_run();
void waitpoint_races_close_run();
void waitpoint_races_forget(const void* low, std::size_t size);
void waitpoint_races_use(const void* object);
void waitpoint_races_read(const void* word, std::size_t size);
void waitpoint_races_barrier();

void* __tsan_get_current_fiber() { return &Detector::the().current(); }
void* __tsan_create_fiber(unsigned) { return &Detector::the().make(); }
void __tsan_destroy_fiber(void* fiber) { Detector::the().end(context(fiber)); }
void __tsan_switch_to_fiber(void* fiber, unsigned) { Detector::the().switch_to(context(fiber)); }
void __tsan_set_fiber_name(void* fiber, const char* name) { Detector::the().name(context(fiber), name); }
void __tsan_acquire(void* address) {
  if (Detector::the().has_current()) Detector::the().acquire(address);
}
void __tsan_release(void* address) {
  if (Detector::the().has_current()) Detector::the().release(address);
}

// Runs may overlap (several simulations in turn); the state is only reset between them. It is the process's.
void waitpoint_races_open_run() {
  const void* thread = nullptr;
  const void* const self = __builtin_thread_pointer();
  WAITPOINT_REQUIRE(thread_of_runs.compare_exchange_strong(thread, self) || thread == self,
                    "with the runtime for -fsanitize=thread, simulations of two threads overlap");
  if (open_runs++ == 0) Detector::the().begin_run();
}
void waitpoint_races_close_run() {
  if (--open_runs == 0) thread_of_runs = nullptr;
}
void waitpoint_races_use(const void* object) {
  if (Detector::the().has_current()) Detector::the().use(object);
}
void waitpoint_races_read(const void* word, std::size_t size) {
  if (Detector::the().is_weak() && Detector::the().watching()) Detector::the().weak_read(word, size);
}
void waitpoint_races_barrier() {
  if (Detector::the().is_weak() && Detector::the().watching()) Detector::the().weak_barrier();
}
void waitpoint_races_forget(const void* low, std::size_t size) { Detector::the().forget(low, size); }

}  // extern "C"
