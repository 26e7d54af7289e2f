// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/members/program_image.hpp"

#include <alloca.h>
#include <dlfcn.h>
#include <link.h>
#include <unistd.h>

#include <cstdio>
#include <cstring>

#include "core/error.hpp"
#include "fibers/posix/base/interposed.hpp"
#include "fibers/posix/members/program_copy.hpp"

namespace waitpoint::posix {
namespace {

// The copy's name, of the same length in every run: the dynamic linker allocates it on the program's heap.
struct CopyName {
  explicit CopyName(int file) {
    constexpr int digits_max = 7;  // of a process id
    char number[16];
    const int digits = std::snprintf(number, sizeof number, "%d", static_cast<int>(getpid()));
    WAITPOINT_CHECK(digits > 0 && digits <= digits_max, "a process id has more digits than a copy's name has room for");
    std::snprintf(text, sizeof text, "/proc%.*s%s/fd/%d", digits < digits_max ? 1 + digits_max - digits : 1, "////////",
                  number, file);
  }
  char text[64];
};

// The dynamic linker's message, without the copy's name in front.
void explain(const char* file, const CopyName& copy, LoadError& error) {
  const char* reason = dlerror();
  const std::size_t length = std::strlen(copy.text);
  if (reason != nullptr && std::strncmp(reason, copy.text, length) == 0 && std::strncmp(reason + length, ": ", 2) == 0)
    reason += length + 2;
  std::snprintf(error, sizeof error, "%s cannot be loaded: %s", file,
                reason != nullptr ? reason : "no reason is known");
}

// Enters a program as the system does, with its arguments on the stack. It never returns.
[[noreturn]] void enter(void* entry, int argc, char** argv) {
  WAITPOINT_CHECK(argc >= 0 && argv != nullptr, "a program is entered without arguments");
  const auto words = static_cast<std::size_t>(argc) + 3;
  auto** const block = static_cast<void**>(alloca((words + 2) * sizeof(void*)));
  auto** const top = reinterpret_cast<void**>((reinterpret_cast<std::uintptr_t>(block) + 15) & ~std::uintptr_t{15});
  top[0] = reinterpret_cast<void*>(static_cast<std::intptr_t>(argc));
  for (int i = 0; i < argc; ++i) top[1 + i] = argv[i];
  top[1 + argc] = nullptr;
  top[2 + argc] = nullptr;  // no environment: the C library has it already
  asm volatile("movq %0, %%rsp\n\txorl %%edx, %%edx\n\tjmp *%1" : : "r"(top), "r"(entry) : "rdx", "memory");
  __builtin_unreachable();
}

using Constructor = void (*)(int, char**, char**);
using Destructor = void (*)();

}  // namespace

bool load(ProgramImage& image, const char* file, LoadError& error) {
  ProgramParts parts;
  image.file = make_copy(file, parts, error);
  if (image.file < 0) return false;
  const CopyName copy(image.file);
  image.handle = dlopen(copy.text, RTLD_NOW | RTLD_LOCAL);
  link_map* map = nullptr;
  if (image.handle == nullptr || dlinfo(image.handle, RTLD_DI_LINKMAP, &map) != 0) {
    explain(file, copy, error);
    unload(image);
    return false;
  }
  WAITPOINT_CHECK(parts.entry != 0 || parts.main != 0, "a copy was made of a program without a beginning");
  image.base = reinterpret_cast<char*>(map->l_addr);
  const auto at = [base = image.base](std::uint64_t address) { return address != 0 ? base + address : nullptr; };
  if (parts.entry == 0) image.main = reinterpret_cast<Main>(at(parts.main));
  image.entry = at(parts.entry);
  image.initialise = reinterpret_cast<void (*)()>(at(parts.initialise));
  image.finish = reinterpret_cast<void (*)()>(at(parts.finish));
  image.constructors = {reinterpret_cast<char**>(at(parts.constructors)), parts.constructors_bytes / sizeof(char*)};
  image.destructors = {reinterpret_cast<char**>(at(parts.destructors)), parts.destructors_bytes / sizeof(char*)};
  return true;
}

void unload(ProgramImage& image) {
  if (image.handle != nullptr) dlclose(image.handle);
  if (image.file >= 0) WAITPOINT_NEXT(close)(image.file);
  image = {};
}

int call_main(const ProgramImage& image, int argc, char** argv) {
  if (image.entry != nullptr) enter(image.entry, argc, argv);
  WAITPOINT_CHECK(image.main != nullptr, "a program is called that is not loaded");
  return call_main(image, image.main, argc, argv);
}

int call_main(const ProgramImage& image, Main main, int argc, char** argv) {
  if (image.initialise != nullptr) image.initialise();
  for (std::size_t i = 0; i < image.constructors.count; ++i)
    reinterpret_cast<Constructor>(image.constructors.first[i])(argc, argv, environ);
  // An earlier program may have used getopt(): 0 makes it start again, see getopt(3) on several vectors.
  optind = 0;
  return main(argc, argv, environ);
}

void call_destructors(const ProgramImage& image) {
  for (std::size_t i = image.destructors.count; i > 0; --i)
    reinterpret_cast<Destructor>(image.destructors.first[i - 1])();
  if (image.finish != nullptr) image.finish();
}

bool contains(const ProgramImage& image, const void* address) {
  Dl_info known{};
  return dladdr(address, &known) != 0 && known.dli_fbase == image.base;
}

}  // namespace waitpoint::posix
