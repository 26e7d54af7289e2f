// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/processes/executable.hpp"

#include <elf.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "fibers/posix/base/elf_file.hpp"
#include "fibers/posix/base/error_number.hpp"
#include "fibers/posix/base/interposed.hpp"

namespace waitpoint::posix {
namespace {

constexpr int interpreters_max = 5;  // a script's interpreter may be a script

/// A file open for reading.
class File {
 public:
  explicit File(const char* path) : descriptor_(WAITPOINT_NEXT(open)(path, O_RDONLY | O_CLOEXEC)) {}
  ~File() {
    if (is_open()) WAITPOINT_NEXT(close)(descriptor_);
  }
  File(const File&) = delete;
  File& operator=(const File&) = delete;

  bool is_open() const { return descriptor_ >= 0; }
  ssize_t read(void* to, std::size_t size, off_t from) const {
    return WAITPOINT_NEXT(pread)(descriptor_, to, size, from);
  }
  bool gains_privileges() const {
    struct stat status {};
    if (WAITPOINT_NEXT(fstat)(descriptor_, &status) != 0) return false;
    return ((status.st_mode & S_ISUID) != 0 && status.st_uid != geteuid()) ||
           ((status.st_mode & S_ISGID) != 0 && status.st_gid != getegid());
  }

 private:
  int descriptor_;
};

ProgramKind kind_of_elf(const File& file) {
  const auto read = [&file](void* to, std::size_t size, std::uint64_t from) {
    return file.read(to, size, static_cast<off_t>(from)) == static_cast<ssize_t>(size);
  };
  const ElfFile elf(read);
  if (!elf.has_part(PT_INTERP)) return ProgramKind::native;
  return is_instrumented(elf) ? ProgramKind::instrumented : ProgramKind::ordinary;
}

bool is_script(const char* text) { return text[0] == '#' && text[1] == '!'; }

}  // namespace

FoundProgram::FoundProgram(const char* name) : path_(name) {
  if (name == nullptr || *name == '\0' || std::strchr(name, '/') != nullptr) return;
  const char* const known = std::getenv("PATH");
  const char* list = known != nullptr ? known : "/bin:/usr/bin";
  for (;;) {
    const char* const end = strchrnul(list, ':');
    const auto length = static_cast<int>(end - list);
    const int size = std::snprintf(found_, sizeof found_, "%.*s%s%s", length, list, length > 0 ? "/" : "", name);
    const ErrorNumberKept kept;
    if (size < static_cast<int>(sizeof found_) && access(found_, X_OK) == 0) {
      path_ = found_;
      return;
    }
    if (*end == '\0') return;
    list = end + 1;
  }
}

ProgramKind kind_of(const char* path) {
  const ErrorNumberKept kept;
  char name[PATH_MAX];
  if (path == nullptr || std::strlen(path) >= sizeof name) return ProgramKind::ordinary;
  std::strcpy(name, path);
  for (int i = 0; i < interpreters_max; ++i) {
    const File file(name);
    if (!file.is_open()) {  // a program that may be executed, but not read
      return access(name, X_OK) != 0 ? ProgramKind::ordinary : ProgramKind::native;
    }
    if (file.gains_privileges()) return ProgramKind::native;
    char text[PATH_MAX] = {};
    const ssize_t size = file.read(text, sizeof text - 1, 0);
    if (size >= static_cast<ssize_t>(sizeof(Elf64_Ehdr)) && std::memcmp(text, ELFMAG, SELFMAG) == 0)
      return kind_of_elf(file);
    if (size < 3 || !is_script(text)) return ProgramKind::ordinary;  // executed by a shell, or not at all
    const char* const begin = text + 2 + std::strspn(text + 2, " \t");
    const std::size_t length = std::strcspn(begin, " \t\n");
    if (length == 0 || length >= sizeof name) return ProgramKind::ordinary;
    std::memcpy(name, begin, length);
    name[length] = '\0';
  }
  return ProgramKind::ordinary;
}

}  // namespace waitpoint::posix
