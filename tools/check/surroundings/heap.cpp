// SPDX-License-Identifier: BSD-3-Clause
// A heap whose small blocks come in an order of their own and are filled with what nobody set.
//
// For every size class some blocks wait in a pool; who asks gets one of them, drawn at random, and a fresh block takes
// its place (Berger and Curtsinger's shuffling layer: STABILIZER, ASPLOS 2013). So of two blocks neither the order in
// which they were asked for nor what was given back before says which lies lower. All blocks are the next heap's, which
// gets back whatever is freed.
#include <malloc.h>

#include <cstddef>
#include <cstdint>
#include <cstring>

#include "tools/check/surroundings/next.hpp"

namespace waitpoint::surroundings {
namespace {

constexpr unsigned char fill = 0xB7;
constexpr std::size_t granule = 16;
constexpr std::size_t shuffled_max = 1024;  // bytes: larger blocks are rare, and follow from the small ones
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
// Looking up the next function may ask for memory itself.
constinit thread_local bool within = false;

// Marsaglia's xorshift64: the order is arbitrary, and the same in every self-check.
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

// Small and not asked for by a next heap for itself.
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
