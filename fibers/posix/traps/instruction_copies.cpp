// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/traps/instruction_copies.hpp"

#include <sys/mman.h>
#include <sys/syscall.h>

#include <cstring>

#include "fibers/posix/base/direct_call.hpp"

namespace waitpoint::posix {
namespace {

constexpr std::uint64_t page_bytes = 4096;

// Below the program, above it behind the heap's usual growth.
std::uint64_t memory_near(std::uint64_t program, std::uint64_t bytes, int access) {
  constexpr std::uint64_t step = std::uint64_t{1} << 24, reach = std::uint64_t{3} << 29;
  const auto map = [&](std::uint64_t at) {
    return call_directly(SYS_mmap, static_cast<long>(at), static_cast<long>(bytes), access,
                         MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE | MAP_FIXED_NOREPLACE, -1,
                         0) == static_cast<long>(at);
  };
  for (std::uint64_t away = bytes; away < reach && away + page_bytes < program; away += step)
    if (map(program - away)) return program - away;
  for (std::uint64_t away = reach; away > 0; away -= step)
    if (map(program + away)) return program + away;
  return 0;
}

void put(std::uint64_t at, const void* bytes, std::size_t count) {
  std::memcpy(reinterpret_cast<void*>(at), bytes, count);
}

// The operand's distance from the end of the instruction that has these 32 bits.
void put_distance(std::uint64_t at, std::uint64_t from, std::uint64_t to) {
  const auto distance = static_cast<std::int32_t>(static_cast<std::int64_t>(to - from));
  put(at, &distance, sizeof distance);
}

LibraryRange reserved{};

// Of the program itself, which is the first that is loaded.
std::uint64_t begin_of_program() {
  std::uintptr_t begin = 0;
  dl_iterate_phdr(
      [](dl_phdr_info* program, std::size_t, void* to) {
        *static_cast<std::uintptr_t*>(to) = range_of_loaded(*program).begin;
        return 1;
      },
      &begin);
  return begin & ~(page_bytes - 1);
}

}  // namespace

LibraryRange reserve_for_copies() {
  constexpr std::uint64_t bytes = std::uint64_t{1} << 24;
  const std::uint64_t begin = memory_near(begin_of_program(), bytes, PROT_READ | PROT_WRITE | PROT_EXEC);
  return reserved = {begin, begin != 0 ? begin + bytes : 0};
}

LibraryRange reserved_for_copies() { return reserved; }

bool InstructionCopies::make(std::span<const AccessInstruction> instructions, std::uint64_t loaded_at) {
  constexpr std::uint8_t jump = 0xE9;
  constexpr std::size_t jump_bytes = 5;
  static_assert(AccessInstruction::length_max + jump_bytes <= copy_bytes);
  const std::uint64_t bytes = (instructions.size() * copy_bytes + page_bytes - 1) / page_bytes * page_bytes;
  instructions_ = instructions;
  loaded_at_ = loaded_at;
  const bool is_of_program = instructions.front().module() == 0;
  const bool is_kept = is_of_program && bytes <= reserved.end - reserved.begin;
  begin_ = is_kept ? reserved.begin
                   : memory_near((loaded_at + instructions.front().offset()) & ~(page_bytes - 1), bytes,
                                 PROT_READ | PROT_WRITE);
  end_ = begin_ + bytes;
  if (begin_ == 0) return false;
  for (std::size_t i = 0; i < instructions.size(); ++i) {
    const AccessInstruction& one = instructions[i];
    const std::uint64_t copy = of(i), behind = copy + one.length;
    put(copy, one.code, one.length);
    if (one.is_absolute)
      put_distance(copy + one.displacement_at, behind, loaded_at + static_cast<std::uint64_t>(one.displacement));
    put(behind, &jump, sizeof jump);
    put_distance(behind + sizeof jump, behind + jump_bytes, loaded_at + one.offset() + one.length);
  }
  return is_kept ||
         call_directly(SYS_mprotect, static_cast<long>(begin_), static_cast<long>(bytes), PROT_READ | PROT_EXEC) == 0;
}

void InstructionCopies::remove() {
  if (begin_ != 0 && begin_ != reserved.begin)
    call_directly(SYS_munmap, static_cast<long>(begin_), static_cast<long>(end_ - begin_));
  begin_ = end_ = 0;
}

std::uint64_t InstructionCopies::original_of(std::uint64_t place) const {
  if (place < begin_ || place >= end_) return place;
  const std::uint64_t i = (place - begin_) / copy_bytes;
  if (i >= instructions_.size()) return place;
  const AccessInstruction& one = instructions_[i];
  return loaded_at_ + one.offset() + (place == of(i) ? 0 : one.length);
}

}  // namespace waitpoint::posix
