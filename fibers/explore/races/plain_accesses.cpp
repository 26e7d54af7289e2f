// SPDX-License-Identifier: BSD-3-Clause
// The functions that g++ and clang++ call before plain accesses to memory and around functions under -fsanitize=thread:
// the access part of the runtime's interface (tsan_interface.h).
#include <cstddef>
#include <cstdint>

#include "fibers/explore/races/detector.hpp"

namespace {

using waitpoint::kernel::Operation;
using waitpoint::races::Detector;
namespace kind = waitpoint::races::kind;

Operation operation_of(std::uint8_t kind) { return (kind & kind::write) != 0 ? Operation::store : Operation::load; }

// The size is a power of two; `address` need not be aligned.
inline void access(const volatile void* at, std::uint32_t size, std::uint8_t kind, const void* place) {
  Detector& detector = Detector::the();
  if (__builtin_expect(!detector.watching(), 0)) return detector.unwatched(1);
  const auto address = reinterpret_cast<std::uint64_t>(at);
  if (__builtin_expect(address % 8 + size > 8, 0))
    detector.access_range(address, size, kind, place, operation_of(kind));
  else
    detector.access_word(address, size, kind, place, operation_of(kind));
}

inline void access_range(const volatile void* at, std::size_t size, std::uint8_t kind, const void* place) {
  Detector& detector = Detector::the();
  if (!detector.watching()) return detector.unwatched(1);
  detector.access_range(reinterpret_cast<std::uint64_t>(at), size, kind, place, operation_of(kind));
}

}  // namespace

#define WAITPOINT_PLACE __builtin_return_address(0)
#define WAITPOINT_ACCESSES_OF(SIZE, PREFIX)                                                           \
  void __tsan_##PREFIX##read##SIZE(const void* at) { access(at, SIZE, kind::read, WAITPOINT_PLACE); } \
  void __tsan_##PREFIX##write##SIZE(void* at) { access(at, SIZE, kind::write, WAITPOINT_PLACE); }
#define WAITPOINT_READ_WRITES_OF(SIZE, PREFIX) \
  void __tsan_##PREFIX##read_write##SIZE(void* at) { access(at, SIZE, kind::write, WAITPOINT_PLACE); }
#define WAITPOINT_ALL_SIZES(DEFINE, PREFIX) \
  DEFINE(1, PREFIX) DEFINE(2, PREFIX) DEFINE(4, PREFIX) DEFINE(8, PREFIX) DEFINE(16, PREFIX)

extern "C" {

void __tsan_func_entry(void* return_address);
void __tsan_func_exit();
void __tsan_init();
void __tsan_vptr_update(void** at, void* value);
void __tsan_vptr_read(void** at);
void __tsan_read_range(const void* at, std::size_t size);
void __tsan_write_range(void* at, std::size_t size);
void* __tsan_memcpy(void* to, const void* from, std::size_t size);
void* __tsan_memmove(void* to, const void* from, std::size_t size);
void* __tsan_memset(void* to, int byte, std::size_t size);
void* __real_memcpy(void* to, const void* from, std::size_t size);
void* __real_memmove(void* to, const void* from, std::size_t size);
void* __real_memset(void* to, int byte, std::size_t size);
void* __wrap_memcpy(void* to, const void* from, std::size_t size);
void* __wrap_memmove(void* to, const void* from, std::size_t size);
void* __wrap_memset(void* to, int byte, std::size_t size);
void __tsan_ignore_thread_begin();
void __tsan_ignore_thread_end();

WAITPOINT_ALL_SIZES(WAITPOINT_ACCESSES_OF, )
WAITPOINT_ALL_SIZES(WAITPOINT_ACCESSES_OF, unaligned_)
WAITPOINT_ALL_SIZES(WAITPOINT_ACCESSES_OF, volatile_)
WAITPOINT_ALL_SIZES(WAITPOINT_ACCESSES_OF, unaligned_volatile_)
WAITPOINT_ALL_SIZES(WAITPOINT_READ_WRITES_OF, )
WAITPOINT_ALL_SIZES(WAITPOINT_READ_WRITES_OF, unaligned_)

void __tsan_func_entry(void* return_address) {
  Detector& detector = Detector::the();
  if (detector.has_current()) detector.current().calls.enter(reinterpret_cast<std::uint64_t>(return_address));
}
void __tsan_func_exit() {
  Detector& detector = Detector::the();
  if (detector.has_current()) detector.current().calls.leave();
}

// Constructors repeatedly write the same pointer.
void __tsan_vptr_update(void** at, void* value) {
  if (*at != value) access(at, 8, kind::write, WAITPOINT_PLACE);
}
void __tsan_vptr_read(void** at) { access(at, 8, kind::read, WAITPOINT_PLACE); }

void __tsan_read_range(const void* at, std::size_t size) { access_range(at, size, kind::read, WAITPOINT_PLACE); }
void __tsan_write_range(void* at, std::size_t size) { access_range(at, size, kind::write, WAITPOINT_PLACE); }

// Later compilers call the first of each pair; g++ 12 and clang++ 14 call the function itself, which the linker
// redirects here (--wrap).
#define WAITPOINT_COPY(NAME) void* NAME(void* to, const void* from, std::size_t size)
#define WAITPOINT_TELL_COPY                              \
  access_range(from, size, kind::read, WAITPOINT_PLACE); \
  access_range(to, size, kind::write, WAITPOINT_PLACE);
WAITPOINT_COPY(__tsan_memcpy) { WAITPOINT_TELL_COPY return __real_memcpy(to, from, size); }
WAITPOINT_COPY(__wrap_memcpy) { WAITPOINT_TELL_COPY return __real_memcpy(to, from, size); }
WAITPOINT_COPY(__tsan_memmove) { WAITPOINT_TELL_COPY return __real_memmove(to, from, size); }
WAITPOINT_COPY(__wrap_memmove) { WAITPOINT_TELL_COPY return __real_memmove(to, from, size); }
void* __tsan_memset(void* to, int byte, std::size_t size) {
  access_range(to, size, kind::write, WAITPOINT_PLACE);
  return __real_memset(to, byte, size);
}
void* __wrap_memset(void* to, int byte, std::size_t size) {
  access_range(to, size, kind::write, WAITPOINT_PLACE);
  return __real_memset(to, byte, size);
}

void __tsan_ignore_thread_begin() { Detector::the().ignore(true); }
void __tsan_ignore_thread_end() { Detector::the().ignore(false); }

}  // extern "C"
