// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/in_process/linked_libraries.hpp"

#include <dlfcn.h>
#include <fcntl.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string_view>

#include "core/error.hpp"
#include "fibers/posix/base/interposed.hpp"

extern "C" void* _dl_allocate_tls(void*);  // of the dynamic linker

namespace waitpoint::posix {
namespace {

constexpr std::string_view shared[] = {
    "ld-linux-x86-64.so.",
    "libc.so.",
    "libm.so.",
    "libmvec.so.",
    "libdl.so.",
    "libpthread.so.",
    "librt.so.",
    "libutil.so.",
    "libanl.so.",
    "libnsl.so.",
    "libresolv.so.",
    "libstdc++.so.",
    "libgcc_s.so.",
    "libgomp.so.",
    "libtsan.so.",
    "libasan.so.",
    "libubsan.so.",
    "liblsan.so.",
    "libwaitpoint.so",
    "libwaitpoint-exec",
    "libthread_db.so.",
    "libwaitpoint-in-process",
};

/// This process's environment, with one variable in front.
class EnvironmentWith {
 public:
  explicit EnvironmentWith(const char* variable) {
    std::size_t count = 0;
    while (environ[count] != nullptr) ++count;
    all_ = static_cast<const char**>(std::malloc((count + 2) * sizeof(char*)));
    if (all_ == nullptr) return;
    all_[0] = variable;
    std::memcpy(all_ + 1, environ, (count + 1) * sizeof(char*));
  }
  ~EnvironmentWith() { std::free(all_); }
  EnvironmentWith(const EnvironmentWith&) = delete;
  EnvironmentWith& operator=(const EnvironmentWith&) = delete;
  const char* const* all() const { return all_; }

 private:
  const char** all_ = nullptr;
};

// The dynamic linker in use lists the libraries of a program, those that it does not find, too, into a file: see
// ld.so(8). False if it cannot be run.
bool list_libraries(const char* program, const char* asked, int output) {
  Dl_info linker{};
  posix_spawn_file_actions_t actions;
  const EnvironmentWith environment("LD_TRACE_LOADED_OBJECTS=1");
  if (environment.all() == nullptr || dladdr(reinterpret_cast<const void*>(&_dl_allocate_tls), &linker) == 0 ||
      posix_spawn_file_actions_init(&actions) != 0)
    return false;
  posix_spawn_file_actions_adddup2(&actions, output, STDOUT_FILENO);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  // Without a slash it would be looked for among the libraries.
  LinkedLibraries::Path path;
  std::snprintf(path, sizeof path, "%s%s", std::strchr(program, '/') == nullptr ? "./" : "", program);
  const char* const of_program[] = {linker.dli_fname, path, nullptr};
  const char* const with_asked[] = {linker.dli_fname, "--preload", asked, path, nullptr};
  const char* const* const words = asked == nullptr ? of_program : with_asked;
  pid_t process = 0;
  const int error = WAITPOINT_NEXT(posix_spawn)(&process, words[0], &actions, nullptr, const_cast<char* const*>(words),
                                                const_cast<char* const*>(environment.all()));
  posix_spawn_file_actions_destroy(&actions);
  int status = 0;
  return error == 0 && WAITPOINT_NEXT(waitpid)(process, &status, 0) == process && WIFEXITED(status);
}

// The path in a line: "\tNAME => PATH (ADDRESS)", or "\tPATH (ADDRESS)" if the name is a path. Empty without one.
std::string_view path_in(std::string_view line, std::string_view name) {
  const std::size_t address = line.rfind(" (0x");
  if (address == std::string_view::npos || !line.starts_with('\t')) return {};
  line.remove_suffix(line.size() - address);
  line.remove_prefix(1);
  if (line == name) return line;
  constexpr std::string_view arrow = " => ";
  if (!line.starts_with(name)) return {};
  line.remove_prefix(name.size());
  if (!line.starts_with(arrow)) return {};
  line.remove_prefix(arrow.size());
  return line;
}

}  // namespace

LinkedLibraries::~LinkedLibraries() {
  if (list_ != nullptr) munmap(list_, size_);
}

void LinkedLibraries::list() {
  is_listed_ = true;
  const int file = memfd_create("libraries", MFD_CLOEXEC);
  if (file < 0) return;
  struct stat of {};
  if (list_libraries(program_, asked_, file) && WAITPOINT_NEXT(fstat)(file, &of) == 0 && of.st_size > 0) {
    size_ = static_cast<std::size_t>(of.st_size);
    void* const memory = mmap(nullptr, size_, PROT_READ, MAP_PRIVATE, file, 0);
    if (memory != MAP_FAILED) list_ = static_cast<char*>(memory);
  }
  WAITPOINT_NEXT(close)(file);
}

bool LinkedLibraries::find(const char* name, Path& path) {
  if (!is_listed_) list();
  for (std::string_view rest(list_ != nullptr ? list_ : "", list_ != nullptr ? size_ : 0); !rest.empty();) {
    const std::size_t end = rest.find('\n');
    const std::size_t length = end == std::string_view::npos ? rest.size() : end;
    const std::string_view found = path_in({rest.data(), length}, name);
    if (!found.empty() && found.size() < sizeof path) {
      std::memcpy(path, found.data(), found.size());
      path[found.size()] = '\0';
      return true;
    }
    rest.remove_prefix(length == rest.size() ? length : length + 1);
  }
  return false;
}

bool is_shared_by_programs(const char* name) {
  const char* const slash = std::strrchr(name, '/');
  const std::string_view file = slash != nullptr ? slash + 1 : name;
  for (const std::string_view beginning : shared)
    if (file.starts_with(beginning)) return true;
  return false;
}

}  // namespace waitpoint::posix
