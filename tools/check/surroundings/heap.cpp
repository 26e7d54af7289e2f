// SPDX-License-Identifier: BSD-3-Clause
// A heap that shuffles small blocks and fills them with nonzero bytes.
//
// Every size class has a pool of blocks: an allocation takes a random one and replaces it by a fresh block (Berger and
// Curtsinger's shuffling layer: STABILIZER, ASPLOS 2013). So the relative position of two blocks depends neither on the
// order of their allocation nor on earlier releases. All blocks come from the next heap, which gets every freed block.
#include <malloc.h>

#include <cstddef>
#include <cstdint>
#include <cstring>

#include "tools/check/surroundings/next.hpp"

namespace waitpoint::surroundings {
namespace {

constexpr unsigned char fill = 0xB7;
constexpr std::size_t granule = 16;
constexpr std::size_t shuffled_max = 1024;  // bytes: larger blocks are rare, and their order follows the small ones
constexpr std::size_t pool_size = 32;

constinit Next<void*(std::size_t)> next_malloc("malloc");
constinit Next<void*(void*, std::size_t)> next_realloc("realloc");
constinit Next<void*(std::size_t, std::size_t)> next_calloc("calloc");

struct Pool {
  void* blocks[pool_size] = {};
  bool full = false;
};

constinit Pool pools[shuffled_max / granule + 1];
constinit std::uint64_t draws = 0x5EED;
constinit std::atomic_flag taken;
// Looking up the next function may allocate memory itself.
constinit thread_local bool within = false;

// Marsaglia's xorshift64: an arbitrary order, the same in every self-check.
std::size_t drawn() {
  draws ^= draws << 13;
  draws ^= draws >> 7;
  draws ^= draws << 17;
  return draws % pool_size;
}

void* shuffled(std::size_t size) {
  const std::size_t granules = (size + granule - 1) / granule;
  const Holding lock(taken);
  Pool& pool = pools[granules];
  if (!pool.full) {
    for (void*& block : pool.blocks) block = next_malloc(granules * granule);
    pool.full = true;
  }
  void*& place = pool.blocks[drawn()];
  void* const block = place;
  place = next_malloc(granules * granule);
  return block;
}

// Shuffles small blocks, except those that a next heap allocates for itself.
void* allocate(std::size_t size) {
  if (within || size > shuffled_max) return next_malloc(size);
  within = true;
  void* const block = shuffled(size);
  within = false;
  return block;
}

}  // namespace
}  // namespace waitpoint::surroundings

extern "C" {

void* malloc(std::size_t size) noexcept {
  void* const block = waitpoint::surroundings::allocate(size);
  if (block != nullptr) std::memset(block, waitpoint::surroundings::fill, size);
  return block;
}

void* calloc(std::size_t count, std::size_t size) noexcept {
  std::size_t bytes = 0;
  if (__builtin_mul_overflow(count, size, &bytes) || bytes > waitpoint::surroundings::shuffled_max)
    return waitpoint::surroundings::next_calloc(count, size);
  void* const block = waitpoint::surroundings::allocate(bytes);
  if (block != nullptr) std::memset(block, 0, bytes);
  return block;
}

void* realloc(void* block, std::size_t size) noexcept {
  if (block == nullptr) return malloc(size);
  const std::size_t had = malloc_usable_size(block);
  void* const moved = waitpoint::surroundings::next_realloc(block, size);
  if (moved != nullptr && size > had)
    std::memset(static_cast<char*>(moved) + had, waitpoint::surroundings::fill, size - had);
  return moved;
}
}
