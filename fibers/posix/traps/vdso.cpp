// SPDX-License-Identifier: BSD-3-Clause
//
// The code is replaced by a copy at the same address, whose functions jump to ours.
#include "fibers/posix/traps/vdso.hpp"

#include <elf.h>
#include <sys/auxv.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <sys/time.h>

#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "core/error.hpp"
#include "fibers/posix/base/direct_call.hpp"
#include "fibers/posix/base/error_number.hpp"
#include "fibers/posix/base/interposed.hpp"
#include "fibers/posix/program/program.hpp"
#include "fibers/posix/program/waiting.hpp"
#include "fibers/posix/time/clocks.hpp"
#include "fibers/posix/traps/library_range.hpp"

namespace waitpoint::posix {
namespace {

LibraryRange code_of_c_library;

// The C library may hold locks of its own where it reads a clock: no other thread gets a turn then.
Time now_for(const void* caller) {
  if (kernel::running == nullptr || !is_thread(*kernel::running)) return Time();
  if (!is_simulated()) return kernel::local_time(*kernel::running);
  if (!code_of_c_library.contains(reinterpret_cast<std::uintptr_t>(caller))) return read_clock();
  spend(record->settings.call_cost);
  return kernel::local_time(*kernel::running);
}

// As the system's functions: errors are negative.

long read_any_clock(clockid_t clock, timespec* time) {
  const ErrorNumberKept kept;
  if (!is_clock(clock)) return -EINVAL;
  *time = to_timespec(reading_ns(clock, now_for(__builtin_return_address(0))));
  return 0;
}

long read_date(timeval* time, struct timezone* zone) {
  const timespec read = to_timespec(reading_ns(CLOCK_REALTIME, now_for(__builtin_return_address(0))));
  if (time != nullptr) *time = {read.tv_sec, read.tv_nsec / 1000};
  if (zone != nullptr) *zone = {};
  return 0;
}

time_t read_seconds(time_t* seconds) {
  const time_t read = to_timespec(reading_ns(CLOCK_REALTIME, now_for(__builtin_return_address(0)))).tv_sec;
  if (seconds != nullptr) *seconds = read;
  return read;
}

long resolution_of(clockid_t clock, timespec* resolution) {
  const ErrorNumberKept kept;
  if (!is_clock(clock)) return -EINVAL;
  if (resolution != nullptr) *resolution = {0, 1};
  return 0;
}

long first_processor(unsigned* processor, unsigned* node) {
  if (processor != nullptr) *processor = 0;
  if (node != nullptr) *node = 0;
  return 0;
}

// The caller then makes the system call.
long no_function() { return -ENOSYS; }

const void* replacement_of(const char* name) {
  const struct {
    const char* name;
    const void* function;
  } all[] = {
      {"__vdso_clock_gettime", reinterpret_cast<const void*>(read_any_clock)},
      {"__vdso_gettimeofday", reinterpret_cast<const void*>(read_date)},
      {"__vdso_time", reinterpret_cast<const void*>(read_seconds)},
      {"__vdso_clock_getres", reinterpret_cast<const void*>(resolution_of)},
      {"__vdso_getcpu", reinterpret_cast<const void*>(first_processor)},
      {"__vdso_getrandom", reinterpret_cast<const void*>(no_function)},
  };
  for (const auto& each : all)
    if (std::strcmp(each.name, name) == 0) return each.function;
  return nullptr;
}

/// endbr64; movabs $to, %rax; jmp *%rax
struct JumpCode {
  unsigned char code[16] = {0xF3, 0x0F, 0x1E, 0xFA, 0x48, 0xB8, 0, 0, 0, 0, 0, 0, 0, 0, 0xFF, 0xE0};
  explicit JumpCode(const void* to) { std::memcpy(code + 6, &to, sizeof to); }
};
static_assert(sizeof(JumpCode) == 16, "the functions are aligned to as many bytes");

// In a copy of the whole image.
void replace_functions(char* image, std::size_t size) {
  const auto& header = *reinterpret_cast<const Elf64_Ehdr*>(image);
  const auto* const sections = reinterpret_cast<const Elf64_Shdr*>(image + header.e_shoff);
  for (int i = 0; i < header.e_shnum; ++i) {
    const Elf64_Shdr& section = sections[i];
    if (section.sh_type != SHT_DYNSYM || section.sh_link >= header.e_shnum) continue;
    const auto* const symbols = reinterpret_cast<const Elf64_Sym*>(image + section.sh_offset);
    const char* const names = image + sections[section.sh_link].sh_offset;
    for (std::size_t k = 0; k < section.sh_size / sizeof *symbols; ++k) {
      const void* const to = replacement_of(names + symbols[k].st_name);
      if (to == nullptr || symbols[k].st_value + sizeof(JumpCode) > size) continue;
      const JumpCode jump(to);
      std::memcpy(image + symbols[k].st_value, jump.code, sizeof jump.code);
    }
  }
}

// The image as a file: it is mapped from its first byte to its section headers, which are its end.
std::size_t size_of(const Elf64_Ehdr& header) {
  constexpr std::size_t page = 4096;
  const std::size_t end = header.e_shoff + std::size_t{header.e_shnum} * header.e_shentsize;
  return (end + page - 1) / page * page;
}

}  // namespace

void replace_vdso() {
  const auto* const header = reinterpret_cast<const Elf64_Ehdr*>(getauxval(AT_SYSINFO_EHDR));
  if (header == nullptr || std::memcmp(header->e_ident, ELFMAG, SELFMAG) != 0 || header->e_shoff == 0) return;
  code_of_c_library = range_of_library_with(reinterpret_cast<const void*>(WAITPOINT_NEXT(abort)));
  const std::size_t size = size_of(*header);
  void* const copy = mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (copy == MAP_FAILED) return;
  std::memcpy(copy, header, size);
  replace_functions(static_cast<char*>(copy), size);
  void* const place = const_cast<Elf64_Ehdr*>(header);
  if (call_directly(SYS_mprotect, reinterpret_cast<long>(copy), static_cast<long>(size), PROT_READ | PROT_EXEC) != 0 ||
      mremap(copy, size, size, MREMAP_MAYMOVE | MREMAP_FIXED, place) == MAP_FAILED)
    munmap(copy, size);
}

}  // namespace waitpoint::posix
