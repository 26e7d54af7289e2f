// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/base/import_binding.hpp"

#include <dlfcn.h>
#include <elf.h>
#include <link.h>
#include <sys/mman.h>
#include <sys/syscall.h>

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <span>

#include "fibers/posix/base/direct_call.hpp"
#include "fibers/posix/base/interposed.hpp"

namespace waitpoint::posix {
namespace {

#if defined __aarch64__
constexpr std::uint32_t call_of_function = R_AARCH64_JUMP_SLOT, address_of_symbol = R_AARCH64_GLOB_DAT;
#else
constexpr std::uint32_t call_of_function = R_X86_64_JUMP_SLOT, address_of_symbol = R_X86_64_GLOB_DAT;
#endif

// The dynamic section of a loaded library, whose addresses are absolute.
struct Dynamic {
  std::span<const Elf64_Rela> calls, others;
  const Elf64_Sym* symbols = nullptr;
  const char* names = nullptr;
};

Dynamic dynamic_of(const link_map& library) {
  Dynamic found;
  const Elf64_Rela *calls = nullptr, *others = nullptr;
  std::size_t calls_bytes = 0, others_bytes = 0;
  for (const Elf64_Dyn* entry = library.l_ld; entry->d_tag != DT_NULL; ++entry) {
    switch (entry->d_tag) {
      case DT_JMPREL: calls = reinterpret_cast<const Elf64_Rela*>(entry->d_un.d_ptr); break;
      case DT_PLTRELSZ: calls_bytes = entry->d_un.d_val; break;
      case DT_RELA: others = reinterpret_cast<const Elf64_Rela*>(entry->d_un.d_ptr); break;
      case DT_RELASZ: others_bytes = entry->d_un.d_val; break;
      case DT_SYMTAB: found.symbols = reinterpret_cast<const Elf64_Sym*>(entry->d_un.d_ptr); break;
      case DT_STRTAB: found.names = reinterpret_cast<const char*>(entry->d_un.d_ptr); break;
      default: break;
    }
  }
  found.calls = {calls, calls_bytes / sizeof *calls};
  found.others = {others, others_bytes / sizeof *others};
  return found;
}

// Character by character: a call could reach the program.
bool are_equal(const char* one, const char* other) {
  while (*one != 0 && *one == *other) ++one, ++other;
  return *one == *other;
}

bool allocates(const char* name) {
  constexpr const char* names[] = {"malloc",  "calloc",         "realloc",           "reallocarray",
                                   "free",    "posix_memalign", "memalign",          "valloc",
                                   "pvalloc", "aligned_alloc",  "malloc_usable_size"};
  return std::any_of(std::begin(names), std::end(names), [&](const char* each) { return are_equal(each, name); });
}

// The dynamic linker has made them read-only.
class Writable {
 public:
  explicit Writable(std::uintptr_t of) : page_(of & ~std::uintptr_t{page_bytes - 1}) {
    protect(PROT_READ | PROT_WRITE);
  }
  ~Writable() { protect(PROT_READ); }
  Writable(const Writable&) = delete;
  Writable& operator=(const Writable&) = delete;

 private:
  static constexpr std::size_t page_bytes = 4096;
  void protect(int access) const {
    call_directly(SYS_mprotect, static_cast<long>(page_), static_cast<long>(page_bytes), access);
  }
  std::uintptr_t page_;
};

}  // namespace

void bind_imports() {
  Dl_info self{};
  link_map* own = nullptr;
  void* const c_library = dlopen("libc.so.6", RTLD_LAZY | RTLD_NOLOAD);
  const auto here = reinterpret_cast<void*>(&bind_imports);
  if (c_library == nullptr || dladdr1(here, &self, reinterpret_cast<void**>(&own), RTLD_DL_LINKMAP) == 0) return;
  const auto look_up = reinterpret_cast<void* (*)(void*, const char*)>(waitpoint_own_dlsym());
  const Dynamic dynamic = dynamic_of(*own);
  const auto bind = [&](const Elf64_Rela& import, std::uint32_t kind) {
    const Elf64_Sym& symbol = dynamic.symbols[ELF64_R_SYM(import.r_info)];
    if (ELF64_R_TYPE(import.r_info) != kind || ELF64_ST_TYPE(symbol.st_info) != STT_FUNC) return;
    const char* const name = dynamic.names + symbol.st_name;
    if (allocates(name)) return;
    const bool is_own = symbol.st_shndx != SHN_UNDEF;
    void* const function = is_own ? reinterpret_cast<void*>(own->l_addr + symbol.st_value) : look_up(c_library, name);
    auto& bound = *reinterpret_cast<void**>(own->l_addr + import.r_offset);
    if (function == nullptr || function == bound) return;
    const Writable writable(own->l_addr + import.r_offset);
    bound = function;
  };
  for (const Elf64_Rela& import : dynamic.calls) bind(import, call_of_function);
  for (const Elf64_Rela& import : dynamic.others) bind(import, address_of_symbol);
}

}  // namespace waitpoint::posix
