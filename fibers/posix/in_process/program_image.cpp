// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/in_process/program_image.hpp"

#include <dlfcn.h>
#include <link.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdio>
#include <cstring>

#include "core/error.hpp"
#include "fibers/posix/base/interposed.hpp"
#include "fibers/posix/in_process/linked_libraries.hpp"

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

void initialise(const ObjectCopy& copy, const ObjectCopy* end, int argc, char** argv, char** const& variables) {
  if (copy.before != end) initialise(*copy.before, end, argc, argv, variables);
  const ProgramParts& parts = copy.parts;
  if (parts.initialise != 0) at<Constructor>(copy, parts.initialise)(argc, argv, variables);
  auto* const constructors = at<Constructor*>(copy, parts.constructors);
  for (std::size_t i = 0; i < parts.constructors_bytes / sizeof(Constructor); ++i)
    constructors[i](argc, argv, variables);
}

void finish(const ObjectCopy& copy) {
  const ProgramParts& parts = copy.parts;
  auto* const destructors = at<Destructor*>(copy, parts.destructors);
  for (std::size_t i = parts.destructors_bytes / sizeof(Destructor); i > 0; --i) destructors[i - 1]();
  if (parts.finish != 0) at<Destructor>(copy, parts.finish)();
}

// Loads the copies up to the one before `end`, of which the last one leads to the others.
bool load_copies(ProgramImage& image, ObjectCopy& last, const ObjectCopy* end, int mode) {
  last.handle = dlopen(last.path.text, mode | RTLD_NOW | RTLD_DEEPBIND);
  if (last.handle != nullptr) last.opens = 1;
  const link_map* map = nullptr;
  if (last.handle == nullptr || dlinfo(last.handle, RTLD_DI_LINKMAP, &map) != 0) return false;
  // Its libraries follow it in the dynamic linker's list.
  for (; map != nullptr; map = map->l_next)
    for (ObjectCopy* copy = &last; copy != end; copy = copy->before)
      if (std::strcmp(copy->path.text, map->l_name) == 0) copy->base = reinterpret_cast<char*>(map->l_addr);
  for (const ObjectCopy* copy = &last; copy != end; copy = copy->before)
    WAITPOINT_CHECK(copy->base != nullptr, "a library of a program is not loaded with it");
  for (const ObjectCopy* copy = &last; copy != end; copy = copy->before)
    redirect_environ(copy->base, copy->parts, &image.environment.variables);
  return true;
}

// One that stays loaded keeps its descriptor: its path must not become another's.
void close_for_ever(ObjectCopy& copy) {
  for (; copy.opens > 0; --copy.opens) dlclose(copy.handle);
  void* const handle = dlopen(copy.path.text, RTLD_LAZY | RTLD_NOLOAD);
  if (handle == nullptr) return;
  dlclose(handle);
  copy.descriptor = -1;
}

bool are_one_file(const char* one, const char* other) {
  struct stat first {
  }, second{};
  return WAITPOINT_NEXT(stat)(one, &first) == 0 && WAITPOINT_NEXT(stat)(other, &second) == 0 &&
         first.st_dev == second.st_dev && first.st_ino == second.st_ino;
}

}  // namespace

bool load(ProgramImage& image, const char* file, LoadError& error) {
  image.program = image.last = make_copies(file, error);
  if (image.program == nullptr) return false;
  if (!image.environment.begin(environ)) {
    std::snprintf(error, sizeof error, "there is no memory for it");
    unload(image);
    return false;
  }
  if (!load_copies(image, *image.program, nullptr, RTLD_LOCAL)) {
    explain(*image.program, error);
    unload(image);
    return false;
  }
  WAITPOINT_CHECK(image.program->parts.main != 0, "a copy was made of a program without a beginning");
  return true;
}

void unload(ProgramImage& image) {
  for (ObjectCopy* copy = image.last; copy != nullptr; copy = copy->before) close_for_ever(*copy);
  forget_copies(image.last);
  image.environment.forget();
  image = {};
}

int call_main(const ProgramImage& image, int argc, char** argv) {
  WAITPOINT_CHECK(image.program != nullptr, "a program is called that is not loaded");
  call_constructors(image, nullptr, argc, argv);
  // An earlier program may have used getopt(): 0 makes it start again, see getopt(3) on several vectors.
  optind = 0;
  return at<Main>(*image.program, image.program->parts.main)(argc, argv, image.environment.variables);
}

ObjectCopy* find_copy(const ProgramImage& image, const char* name) {
  if (name == nullptr) return image.program;
  const bool is_path = std::strchr(name, '/') != nullptr;
  for (ObjectCopy* copy = image.last; copy != nullptr; copy = copy->before)
    if (std::strcmp(copy->name, name) == 0 || (is_path && are_one_file(copy->file, name))) return copy;
  return nullptr;
}

ObjectCopy* open_library(ProgramImage& image, const char* name, int mode) {
  LinkedLibraries::Path file;
  if (is_shared_by_programs(name)) return nullptr;
  if (std::strchr(name, '/') == nullptr && !LinkedLibraries(image.program->file, name).find(name, file)) return nullptr;
  LoadError ignored;
  ObjectCopy* const before = image.last;
  ObjectCopy* const opened =
      add_copies(before, *image.program, std::strchr(name, '/') == nullptr ? file : name, name, ignored);
  if (opened == nullptr) return nullptr;
  if (load_copies(image, *opened, before, mode & ~RTLD_NODELETE)) return image.last = opened;
  forget_copies(opened, before);
  return nullptr;
}

void* open_copy(ObjectCopy& copy, int mode) {
  // One reference more than the program's.
  if (copy.opens == 0) {
    copy.handle = dlopen(copy.path.text, RTLD_LAZY);
    if (copy.handle == nullptr) return nullptr;
    copy.opens = 1;
  }
  void* const handle = dlopen(copy.path.text, mode & ~RTLD_NODELETE);
  if (handle != nullptr) ++copy.opens;
  return handle;
}

bool close_copy(const ProgramImage& image, void* handle) {
  ObjectCopy* copy = image.last;
  while (copy != nullptr && (copy->opens == 0 || copy->handle != handle)) copy = copy->before;
  if (copy == nullptr) return false;
  if (copy->opens > 1 && dlclose(handle) == 0) --copy->opens;
  return true;
}

void call_constructors(const ProgramImage& image, const ObjectCopy* before, int argc, char** argv) {
  if (image.last != before) initialise(*image.last, before, argc, argv, image.environment.variables);
}

void call_destructors(const ProgramImage& image) {
  for (const ObjectCopy* copy = image.last; copy != nullptr; copy = copy->before) finish(*copy);
}

const ObjectCopy* copy_with(const ProgramImage& image, const void* address) {
  Dl_info known{};
  void* map = nullptr;
  if (WAITPOINT_NEXT(dladdr1)(address, &known, &map, RTLD_DL_LINKMAP) == 0 || map == nullptr) return nullptr;
  for (const ObjectCopy* copy = image.last; copy != nullptr; copy = copy->before)
    if (reinterpret_cast<char*>(static_cast<link_map*>(map)->l_addr) == copy->base) return copy;
  return nullptr;
}

}  // namespace waitpoint::posix
