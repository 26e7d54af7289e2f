// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/members/program_image.hpp"

#include <dlfcn.h>
#include <link.h>
#include <unistd.h>

#include <cstdio>
#include <cstring>

#include "core/error.hpp"

namespace waitpoint::posix {
namespace {

// The dynamic linker's message, with the files' names in place of their copies', and without the program's in front.
void explain(const ObjectCopy& program, LoadError& error) {
  const char* reason = dlerror();
  const int length = std::snprintf(error, sizeof error, "%s cannot be loaded: ", program.file);
  if (length < 0 || length >= static_cast<int>(sizeof error)) return;
  char *to = error + length, *const end = error + sizeof error - 1;
  const auto add = [&](const char* text) {
    while (*text != '\0' && to < end) *to++ = *text++;
  };
  if (reason == nullptr) reason = "no reason is known";
  const std::size_t own = std::strlen(program.path.text);
  if (std::strncmp(reason, program.path.text, own) == 0 && std::strncmp(reason + own, ": ", 2) == 0) reason += own + 2;
  while (*reason != '\0' && to < end) {
    const ObjectCopy* copy = &program;
    while (copy != nullptr && std::strncmp(reason, copy->path.text, std::strlen(copy->path.text)) != 0)
      copy = copy->before;
    if (copy != nullptr) {
      add(copy->file);
      reason += std::strlen(copy->path.text);
    } else {
      *to++ = *reason++;
    }
  }
  *to = '\0';
}

using Constructor = void (*)(int, char**, char**);
using Destructor = void (*)();

template <class Function>
Function at(const ObjectCopy& copy, std::uint64_t address) {
  return reinterpret_cast<Function>(copy.base + address);
}

void initialise(const ObjectCopy& copy, int argc, char** argv) {
  if (copy.before != nullptr) initialise(*copy.before, argc, argv);
  const ProgramParts& parts = copy.parts;
  if (parts.initialise != 0) at<Constructor>(copy, parts.initialise)(argc, argv, environ);
  auto* const constructors = at<Constructor*>(copy, parts.constructors);
  for (std::size_t i = 0; i < parts.constructors_bytes / sizeof(Constructor); ++i) constructors[i](argc, argv, environ);
}

void finish(const ObjectCopy& copy) {
  const ProgramParts& parts = copy.parts;
  auto* const destructors = at<Destructor*>(copy, parts.destructors);
  for (std::size_t i = parts.destructors_bytes / sizeof(Destructor); i > 0; --i) destructors[i - 1]();
  if (parts.finish != 0) at<Destructor>(copy, parts.finish)();
}

}  // namespace

bool load(ProgramImage& image, const char* file, LoadError& error) {
  image.program = make_copies(file, error);
  if (image.program == nullptr) return false;
  image.handle = dlopen(image.program->path.text, RTLD_NOW | RTLD_LOCAL | RTLD_DEEPBIND);
  const link_map* map = nullptr;
  if (image.handle == nullptr || dlinfo(image.handle, RTLD_DI_LINKMAP, &map) != 0) {
    explain(*image.program, error);
    unload(image);
    return false;
  }
  // Its libraries follow it in the dynamic linker's list.
  for (; map != nullptr; map = map->l_next)
    for (ObjectCopy* copy = image.program; copy != nullptr; copy = copy->before)
      if (std::strcmp(copy->path.text, map->l_name) == 0) copy->base = reinterpret_cast<char*>(map->l_addr);
  for (const ObjectCopy* copy = image.program; copy != nullptr; copy = copy->before)
    WAITPOINT_CHECK(copy->base != nullptr, "a library of a program is not loaded with it");
  WAITPOINT_CHECK(image.program->parts.main != 0, "a copy was made of a program without a beginning");
  return true;
}

void unload(ProgramImage& image) {
  if (image.handle != nullptr) dlclose(image.handle);
  forget_copies(image.program);
  image = {};
}

int call_main(const ProgramImage& image, int argc, char** argv) {
  WAITPOINT_CHECK(image.handle != nullptr, "a program is called that is not loaded");
  initialise(*image.program, argc, argv);
  // An earlier program may have used getopt(): 0 makes it start again, see getopt(3) on several vectors.
  optind = 0;
  return at<Main>(*image.program, image.program->parts.main)(argc, argv, environ);
}

void call_destructors(const ProgramImage& image) {
  for (const ObjectCopy* copy = image.program; copy != nullptr; copy = copy->before) finish(*copy);
}

bool contains(const ProgramImage& image, const void* address) {
  Dl_info known{};
  void* map = nullptr;
  if (dladdr1(address, &known, &map, RTLD_DL_LINKMAP) == 0 || map == nullptr) return false;
  for (const ObjectCopy* copy = image.program; copy != nullptr; copy = copy->before)
    if (reinterpret_cast<char*>(static_cast<link_map*>(map)->l_addr) == copy->base) return true;
  return false;
}

}  // namespace waitpoint::posix
