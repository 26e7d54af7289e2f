// SPDX-License-Identifier: BSD-3-Clause
//
// System random numbers: a stream that follows from the seed, the same in every run.
#include "fibers/posix/program/randomness.hpp"

#include <sys/auxv.h>
#include <sys/random.h>

#include <cerrno>
#include <cstdint>
#include <cstring>

#include "core/digest.hpp"
#include "fibers/kernel/run.hpp"
#include "fibers/posix/base/argument_memory.hpp"
#include "fibers/posix/base/error_number.hpp"
#include "fibers/posix/base/interposed.hpp"
#include "fibers/posix/program/program.hpp"
#include "fibers/posix/program/state_calls.hpp"
#include "fibers/posix/program/thread.hpp"

namespace waitpoint::posix {
namespace {

constexpr auto streams = static_cast<std::size_t>(Numbers::count);
static_assert(sizeof(Program::numbers_drawn) == streams * sizeof(std::uint64_t), "each stream is counted");
std::uint64_t drawn_before_main[streams] = {};

}  // namespace

// Each program has its own stream.
std::uint64_t draw_random(Numbers numbers) {
  constexpr std::uint64_t names[streams] = {0x67657472616E646F, 0x66696C656E616D65,
                                            0x6461746167726D73};  // "getrando", "filename", "datagrms"
  const auto index = static_cast<std::size_t>(numbers);
  std::uint64_t stream = names[index];
  std::uint64_t* drawn = &drawn_before_main[index];
  if (is_simulated()) {
    Program& program = this_program();
    stream ^= program.robot->id ^ kernel::chooser(*kernel::running->scheduler).seed();
    drawn = &program.numbers_drawn[index];
  } else if (record != nullptr) {
    stream ^= record->settings.seed;
  }
  return Digest::mix(stream + ++*drawn * 0x9E3779B97F4A7C15u);
}

void fill_with_random(void* buffer, std::size_t size) {
  for (std::size_t at = 0; at < size; at += sizeof(std::uint64_t)) {
    const std::uint64_t word = draw_random();
    std::memcpy(static_cast<char*>(buffer) + at, &word, size - at < sizeof word ? size - at : sizeof word);
  }
}

void draw_random_bytes_of_the_process() {
  constexpr std::size_t bytes = 16;
  if (auto* const at = reinterpret_cast<void*>(getauxval(AT_RANDOM)); at != nullptr) fill_with_random(at, bytes);
}

}  // namespace waitpoint::posix

using namespace waitpoint::posix;

// The order of draws is an outcome.
WAITPOINT_INTERPOSED ssize_t getrandom(void* buffer, std::size_t size, unsigned flags) {
  constexpr unsigned of_either = GRND_RANDOM | GRND_INSECURE;
  if ((flags & ~(GRND_NONBLOCK | of_either)) != 0 || (flags & of_either) == of_either) return fail(EINVAL);
  if (size > 0 && !can_be_written(buffer, size)) return fail(EFAULT);
  before_call<"getrandom">(changing(place::random));
  fill_with_random(buffer, size);
  return static_cast<ssize_t>(size);
}

WAITPOINT_INTERPOSED int getentropy(void* buffer, std::size_t size) {
  if (size > 256) return fail(EIO);
  if (size > 0 && !can_be_written(buffer, size)) return fail(EFAULT);
  before_call<"getentropy">(changing(place::random));
  fill_with_random(buffer, size);
  return 0;
}

WAITPOINT_INTERPOSED std::uint32_t arc4random() noexcept {
  before_call<"arc4random">(changing(place::random));
  return static_cast<std::uint32_t>(draw_random() >> 32);
}
WAITPOINT_INTERPOSED void arc4random_buf(void* buffer, std::size_t size) noexcept {
  before_call<"arc4random_buf">(changing(place::random));
  fill_with_random(buffer, size);
}
WAITPOINT_INTERPOSED std::uint32_t arc4random_uniform(std::uint32_t bound) noexcept {
  before_call<"arc4random_uniform">(changing(place::random));
  return static_cast<std::uint32_t>((draw_random() >> 32) * bound >> 32);
}

// libstdc++'s std::random_device, which reads the processor's generator: unsigned random_device::_M_getval().
WAITPOINT_INTERPOSED unsigned _ZNSt13random_device9_M_getvalEv(void*) {
  before_call<"random_device">(changing(place::random));
  return static_cast<unsigned>(draw_random() >> 32);
}

// Our static C++ runtime refers to it from the code of strings, and would link its own definition of the above.
extern "C" [[gnu::visibility("hidden")]] void _ZNSt13random_device7_M_initEPKcm(void*, const char*, std::size_t) {}
