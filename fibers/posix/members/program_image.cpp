// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/members/program_image.hpp"

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
  WAITPOINT_CHECK(parts.main != 0, "a copy was made of a program without a beginning");
  image.base = reinterpret_cast<char*>(map->l_addr);
  const auto at = [base = image.base](std::uint64_t address) { return address != 0 ? base + address : nullptr; };
  image.main = reinterpret_cast<Main>(at(parts.main));
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
  WAITPOINT_CHECK(image.main != nullptr, "a program is called that is not loaded");
  if (image.initialise != nullptr) image.initialise();
  for (std::size_t i = 0; i < image.constructors.count; ++i)
    reinterpret_cast<Constructor>(image.constructors.first[i])(argc, argv, environ);
  // An earlier program may have used getopt(): 0 makes it start again, see getopt(3) on several vectors.
  optind = 0;
  return image.main(argc, argv, environ);
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
