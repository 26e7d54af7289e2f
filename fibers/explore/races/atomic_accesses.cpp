// SPDX-License-Identifier: BSD-3-Clause
// The functions that g++ and clang++ call for atomic operations and fences under -fsanitize=thread
// (tsan_interface_atomic.h).
//
// The operation itself is always sequentially consistent: all tasks run in one OS thread. Its happens-before edges
// follow the requested order. In weak memory a load may return an older value than that in memory, but not one of more
// than 8 bytes.
#include <cstddef>
#include <cstdint>

#include "fibers/explore/races/detector.hpp"
#include "fibers/kernel/access.hpp"

namespace {

using waitpoint::kernel::Operation;
using waitpoint::races::Detector;
namespace kind = waitpoint::races::kind;

// Before an atomic operation: its switch point and its access. False while accesses are not watched.
inline bool access(const volatile void* at, std::uint32_t size, bool writes, const void* place, Operation operation) {
  Detector& detector = Detector::the();
  if (!detector.watching()) {
    detector.unwatched(waitpoint::races::atomic_weight);
    return false;
  }
  const std::uint8_t how = writes ? kind::atomic | kind::write : kind::atomic;
  const auto address = reinterpret_cast<std::uint64_t>(at);
  if (address % 8 + size <= 8)
    detector.access_word(address, size, how, place, operation);
  else
    detector.access_range(address, size, how, place, operation);
  return detector.watching();
}

inline const void* plain(const volatile void* at) { return const_cast<const void*>(at); }

// Higher bits request hardware lock elision.
inline int order_of(int asked) { return asked & 0x7FFF; }

// The operations themselves. For 16 bytes g++ would call a library; the old builtin compiles to the instruction.
template <class T>
inline T value_of(const volatile T* at) {
  if constexpr (sizeof(T) == 16)
    return __sync_val_compare_and_swap(const_cast<volatile T*>(at), T{0}, T{0});
  else
    return __atomic_load_n(at, __ATOMIC_SEQ_CST);
}

// Returns the previous value; stores `desired` if that was `expected`.
template <class T>
inline T swap_if(volatile T* at, T expected, T desired) {
  return __sync_val_compare_and_swap(at, expected, desired);
}

template <class T, class Function>
inline T replace(volatile T* at, Function function) {
  for (T before = value_of(at);;) {
    const T found = swap_if(at, before, static_cast<T>(function(before)));
    if (found == before) return before;
    before = found;
  }
}

inline std::uint64_t number(const volatile void* at) { return reinterpret_cast<std::uint64_t>(at); }

// True if weak memory keeps the stores to this location. Otherwise, if `writes`, those to parts of it are forgotten.
template <class T>
inline bool keeps_stores(const volatile T* at, bool writes) {
  Detector& detector = Detector::the();
  if (__builtin_expect(!detector.is_weak(), 1)) return false;
  if (sizeof(T) <= 8 && number(at) % sizeof(T) == 0) return true;
  if (writes) detector.weak_overwrite(number(at), sizeof(T));
  return false;
}

template <class T>
inline T load(const volatile T* at, int order, const void* place) {
  if (!access(at, sizeof(T), false, place, Operation::load)) return value_of(at);
  if (keeps_stores(at, false))
    return static_cast<T>(Detector::the().weak_load(number(at), sizeof(T), static_cast<std::uint64_t>(value_of(at)),
                                                    order_of(order), place));
  Detector::the().atomic_load(plain(at), order_of(order));
  return value_of(at);
}

template <class T, class Function>
inline T modify(volatile T* at, int order, const void* place, Operation operation, Function function) {
  if (!access(at, sizeof(T), true, place, operation)) return replace(at, function);
  if (keeps_stores(at, true)) {
    const T before = replace(at, function);
    Detector::the().weak_modify(number(at), sizeof(T), static_cast<std::uint64_t>(before),
                                static_cast<std::uint64_t>(static_cast<T>(function(before))), order_of(order), place);
    return before;
  }
  Detector::the().atomic_modify(plain(at), order_of(order));
  return replace(at, function);
}

template <class T>
inline void store(volatile T* at, T value, int order, const void* place) {
  const bool watched = access(at, sizeof(T), true, place, Operation::store);
  const bool keeps = watched && keeps_stores(at, true);
  if (watched && !keeps) Detector::the().atomic_store(plain(at), order_of(order));
  const T before = replace(at, [&](T) { return value; });
  if (keeps)
    Detector::the().weak_store(number(at), sizeof(T), static_cast<std::uint64_t>(before),
                               static_cast<std::uint64_t>(value), order_of(order), place);
}

template <class T>
inline bool compare_exchange(volatile T* at, T* expected, T desired, int success, int failure, const void* place) {
  const bool watched = access(at, sizeof(T), true, place, Operation::compare_exchange);
  const T found = swap_if(at, *expected, desired);
  const bool done = found == *expected;
  *expected = found;
  if (!watched) return done;
  Detector& detector = Detector::the();
  if (!keeps_stores(at, done)) {
    done ? detector.atomic_modify(plain(at), order_of(success)) : detector.atomic_load(plain(at), order_of(failure));
  } else if (done) {
    detector.weak_modify(number(at), sizeof(T), static_cast<std::uint64_t>(found), static_cast<std::uint64_t>(desired),
                         order_of(success), place);
  } else {
    detector.weak_compare(number(at), sizeof(T), static_cast<std::uint64_t>(found), order_of(failure), place);
  }
  return done;
}

}  // namespace

#define WAITPOINT_PLACE __builtin_return_address(0)
#define WAITPOINT_MODIFY(BITS, T, NAME, OPERATION, AFTER)                                                              \
  T __tsan_atomic##BITS##_##NAME(volatile T* at, T value, int order);                                                  \
  T __tsan_atomic##BITS##_##NAME(volatile T* at, T value, int order) {                                                 \
    return modify(at, order, WAITPOINT_PLACE, Operation::OPERATION, [&]([[maybe_unused]] T before) { return AFTER; }); \
  }
#define WAITPOINT_COMPARE_EXCHANGE(BITS, T, NAME)                                                      \
  int __tsan_atomic##BITS##_##NAME(volatile T* at, T* expected, T desired, int success, int failure);  \
  int __tsan_atomic##BITS##_##NAME(volatile T* at, T* expected, T desired, int success, int failure) { \
    return compare_exchange(at, expected, desired, success, failure, WAITPOINT_PLACE);                 \
  }
#define WAITPOINT_ATOMICS(BITS, T)                                                                                   \
  T __tsan_atomic##BITS##_load(const volatile T* at, int order);                                                     \
  T __tsan_atomic##BITS##_load(const volatile T* at, int order) { return load(at, order, WAITPOINT_PLACE); }         \
  void __tsan_atomic##BITS##_store(volatile T* at, T value, int order);                                              \
  void __tsan_atomic##BITS##_store(volatile T* at, T value, int order) { store(at, value, order, WAITPOINT_PLACE); } \
  WAITPOINT_MODIFY(BITS, T, exchange, exchange, value)                                                               \
  WAITPOINT_MODIFY(BITS, T, fetch_add, modify, before + value)                                                       \
  WAITPOINT_MODIFY(BITS, T, fetch_sub, modify, before - value)                                                       \
  WAITPOINT_MODIFY(BITS, T, fetch_and, modify, before& value)                                                        \
  WAITPOINT_MODIFY(BITS, T, fetch_or, modify, before | value)                                                        \
  WAITPOINT_MODIFY(BITS, T, fetch_xor, modify, before ^ value)                                                       \
  WAITPOINT_MODIFY(BITS, T, fetch_nand, modify, ~(before & value))                                                   \
  WAITPOINT_COMPARE_EXCHANGE(BITS, T, compare_exchange_strong)                                                       \
  WAITPOINT_COMPARE_EXCHANGE(BITS, T, compare_exchange_weak)                                                         \
  T __tsan_atomic##BITS##_compare_exchange_val(volatile T* at, T expected, T desired, int success, int failure);     \
  T __tsan_atomic##BITS##_compare_exchange_val(volatile T* at, T expected, T desired, int success, int failure) {    \
    (void)compare_exchange(at, &expected, desired, success, failure, WAITPOINT_PLACE);                               \
    return expected;                                                                                                 \
  }

extern "C" {

WAITPOINT_ATOMICS(8, std::uint8_t)
WAITPOINT_ATOMICS(16, std::uint16_t)
WAITPOINT_ATOMICS(32, std::uint32_t)
WAITPOINT_ATOMICS(64, std::uint64_t)
#ifdef __SIZEOF_INT128__
__extension__ using Wide = unsigned __int128;
WAITPOINT_ATOMICS(128, Wide)
#endif

void __tsan_atomic_thread_fence(int order);
void __tsan_atomic_thread_fence(int order) {
  __atomic_thread_fence(__ATOMIC_SEQ_CST);
  Detector& detector = Detector::the();
  if (!detector.watching()) return;
  waitpoint::kernel::access(Operation::fence, nullptr);
  detector.fence(order_of(order));
}

// Signals are delivered at waitpoints only, so no fence is needed.
void __tsan_atomic_signal_fence(int order);
void __tsan_atomic_signal_fence(int) {}

}  // extern "C"
