// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/in_process/program_copy.hpp"

#include <dlfcn.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <new>

#include "core/error.hpp"
#include "fibers/posix/base/high_descriptor.hpp"
#include "fibers/posix/base/interposed.hpp"
#include "fibers/posix/in_process/added_segment.hpp"
#include "fibers/posix/in_process/linked_libraries.hpp"
#include "fibers/posix/in_process/object_changes.hpp"

namespace waitpoint::posix {
namespace {

// Of the same length in every run: the dynamic linker allocates it on the program's heap.
CopyPath path_of(int descriptor) {
  constexpr int digits_max = 7;  // of a process id
  char number[16];
  const int digits = std::snprintf(number, sizeof number, "%d", static_cast<int>(getpid()));
  WAITPOINT_CHECK(digits > 0 && digits <= digits_max, "a process id has more digits than a copy's name has room for");
  CopyPath path;
  std::snprintf(path.text, sizeof path.text, "/proc%.*s%s/fd/%d", digits < digits_max ? 1 + digits_max - digits : 1,
                "////////", number, descriptor);
  return path;
}

// The copies of many programs may be more than a process has descriptors by default.
bool raise_limit() {
  rlimit limit{};
  if (WAITPOINT_NEXT(getrlimit)(RLIMIT_NOFILE, &limit) != 0 || limit.rlim_cur == limit.rlim_max) return false;
  limit.rlim_cur = limit.rlim_max;
  return setrlimit(RLIMIT_NOFILE, &limit) == 0;
}

int make_file(const char* name) {
  const char* const slash = std::strrchr(name, '/');
  const int file = move_up(memfd_create(slash != nullptr ? slash + 1 : name, MFD_CLOEXEC));
  return file < 0 && (errno == EMFILE || errno == EINVAL) && raise_limit() ? make_file(name) : file;
}

bool write_all(int descriptor, const char* bytes, std::size_t size, std::uint64_t at) {
  for (std::size_t done = 0; done < size;) {
    const ssize_t count = WAITPOINT_NEXT(pwrite)(descriptor, bytes + done, size - done, static_cast<off_t>(at + done));
    if (count <= 0) return false;
    done += static_cast<std::size_t>(count);
  }
  return true;
}

/// What a copy is.
enum class Kind : std::uint8_t { program, library, opened };

/// Makes the copies of one program, or of a library that it opens.
class Copying {
 public:
  Copying(const char* file, ObjectCopy* last, const ObjectCopy* program, LoadError& error)
      : program_(program), error_(error), libraries_(file), last_(last) {}

  /// Copies a file, to which others are linked by `name`; null with the reason.
  ObjectCopy* copy(const char* file, const char* name, Kind kind);
  /// The copies made.
  ObjectCopy* last() const { return last_; }

 private:
  /// A copy whose libraries are being copied: they may need it.
  struct Unfinished {
    ObjectCopy* copy;
    const Unfinished* outer;
  };

  bool refuse(const char* file, const char* reason) {
    std::snprintf(error_, sizeof error_, "%s %s", file, reason);
    return false;
  }
  ObjectCopy* make(const char* file, const char* name);
  bool fill(ObjectCopy& copy, Kind kind);
  bool check(ObjectFile& object, const char* file, bool is_program);
  bool link_to_copies(ObjectFile& object, AddedSegment& added);
  ObjectCopy* known(const char* name, const char* file) const;

  const ObjectCopy* program_;  // that exists already
  LoadError& error_;
  LinkedLibraries libraries_;
  const Unfinished* unfinished_ = nullptr;
  ObjectCopy* last_;
};

void forget(ObjectCopy* copy) {
  if (copy->descriptor >= 0) WAITPOINT_NEXT(close)(copy->descriptor);
  std::free(copy->file);
  std::free(copy->name);
  std::free(copy);
}

ObjectCopy* Copying::make(const char* file, const char* name) {
  auto* const memory = std::malloc(sizeof(ObjectCopy));
  if (memory == nullptr) return nullptr;
  auto* const copy = new (memory) ObjectCopy();
  copy->file = strdup(file);
  copy->name = strdup(name);
  copy->descriptor = make_file(file);
  copy->path = path_of(copy->descriptor);
  if (copy->file != nullptr && copy->name != nullptr && copy->descriptor >= 0) return copy;
  forget(copy);
  return nullptr;
}

ObjectCopy* Copying::copy(const char* file, const char* name, Kind kind) {
  ObjectCopy* const made = make(file, name);
  if (made == nullptr) {
    std::snprintf(error_, sizeof error_, "%s cannot be copied: %s", file, std::strerror(errno));
    return nullptr;
  }
  const Unfinished here{made, unfinished_};
  unfinished_ = &here;
  const bool is_filled = fill(*made, kind);
  unfinished_ = here.outer;
  if (!is_filled) {
    forget(made);
    return nullptr;
  }
  made->before = last_;
  return last_ = made;
}

ObjectCopy* Copying::known(const char* name, const char* file) const {
  const auto is_it = [&](const ObjectCopy& copy) {
    return std::strcmp(copy.name, name) == 0 || (file != nullptr && std::strcmp(copy.file, file) == 0);
  };
  for (ObjectCopy* each = last_; each != nullptr; each = each->before)
    if (is_it(*each)) return each;
  for (const Unfinished* each = unfinished_; each != nullptr; each = each->outer)
    if (is_it(*each->copy)) return each->copy;
  return nullptr;
}

bool Copying::check(ObjectFile& object, const char* file, bool is_program) {
  constexpr char advice[] = "build it with -shared -fPIC";
  if (!object.is_elf()) return refuse(file, "is no shared object for x86-64");
  if (!object.is_position_independent() || !object.find_dynamic()) {
    std::snprintf(error_, sizeof error_, "%s is linked to one address, or statically: %s", file, advice);
    return false;
  }
  if (is_program && object.is_executable()) {
    std::snprintf(error_, sizeof error_, "%s is an executable: %s", file, advice);
    return false;
  }
  return true;
}

// Libraries that programs share are loaded for all, and searched behind the program's own. A library that is not found
// is left to the dynamic linker, which reports it.
bool Copying::link_to_copies(ObjectFile& object, AddedSegment& added) {
  for (Elf64_Dyn& entry : object.dynamic()) {
    const char* const name = entry.d_tag == DT_NEEDED ? object.text(entry.d_un.d_val) : nullptr;
    if (name == nullptr) continue;
    LinkedLibraries::Path file;
    ObjectCopy* copied = known(name, nullptr);
    if (copied == nullptr) {
      const bool is_shared = is_shared_by_programs(name);
      const bool is_found = !is_shared && libraries_.find(name, file);
      if (is_shared || (is_found && is_allocator(file))) {
        if (dlopen(is_shared ? name : file, RTLD_NOW | RTLD_GLOBAL) != nullptr) entry.d_tag = ObjectFile::no_tag;
        continue;
      }
      if (!is_found) continue;
      copied = known(name, file);
    }
    if (copied == nullptr) copied = copy(file, name, Kind::library);
    if (copied == nullptr) return false;
    const std::uint64_t offset = added.add(copied->path.text);
    rename_in_versions(object, name, offset);
    entry.d_un.d_val = offset;
  }
  return true;
}

bool Copying::fill(ObjectCopy& copy, Kind kind) {
  const bool is_program = kind == Kind::program;
  const FileBytes bytes(copy.file, error_);
  if (!bytes.read()) return false;
  ObjectFile object(bytes);
  if (!check(object, copy.file, is_program)) return false;
  take_parts(object, copy.parts);
  if (is_program && copy.parts.main == 0) return refuse(copy.file, "has no main() that others see");
  AddedSegment added(object, bytes, object.dynamic().size() * sizeof(CopyPath));
  if (!added.is_made()) return refuse(copy.file, "cannot be copied: there is no memory for it");
  if (!link_to_copies(object, added)) return false;
  hide_versions(object);
  if (kind == Kind::opened) add_need(object, added.add(program_->path.text));
  added.finish();
  if (write_all(copy.descriptor, bytes.begin(), bytes.size(), 0) &&
      write_all(copy.descriptor, added.begin(), added.size(), added.offset()))
    return true;
  std::snprintf(error_, sizeof error_, "%s cannot be copied: %s", copy.file, std::strerror(errno));
  return false;
}

}  // namespace

ObjectCopy* make_copies(const char* file, LoadError& error) {
  Copying copying(file, nullptr, nullptr, error);
  ObjectCopy* const program = copying.copy(file, file, Kind::program);
  if (program == nullptr) forget_copies(copying.last());
  return program;
}

ObjectCopy* add_copies(ObjectCopy* last, const ObjectCopy& program, const char* file, const char* name,
                       LoadError& error) {
  Copying copying(file, last, &program, error);
  ObjectCopy* const opened = copying.copy(file, name, Kind::opened);
  if (opened == nullptr) forget_copies(copying.last(), last);
  return opened;
}

void forget_copies(ObjectCopy* last, const ObjectCopy* end) {
  while (last != end) {
    ObjectCopy* const copy = last;
    last = copy->before;
    forget(copy);
  }
}

}  // namespace waitpoint::posix
