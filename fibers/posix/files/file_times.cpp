// SPDX-License-Identifier: BSD-3-Clause
//
// Calls that set the times of a file: it shows those given, and the virtual date for the present time.
#include <fcntl.h>
#include <sys/stat.h>
#include <sys/time.h>
#include <utime.h>

#include <cstdint>

#include "fibers/posix/base/argument_memory.hpp"
#include "fibers/posix/base/interposed.hpp"
#include "fibers/posix/files/file_records.hpp"
#include "fibers/posix/files/process_paths.hpp"
#include "fibers/posix/program/file_places.hpp"
#include "fibers/posix/program/program.hpp"

namespace waitpoint::posix {
namespace {

struct At {
  int folder;
  const char* path;
  int flags;
};

// Sets the times of the last access and of the last change by `call`; `times` null: to the present time.
template <class Call>
int set_times(const At& file, const timespec* times, Call call) {
  before_call<"utimensat">(
      [&] { return changing_file(file.folder, file.path, (file.flags & AT_SYMLINK_NOFOLLOW) == 0); });
  struct statx before {
  }, after{};
  if (!is_simulated() || ask_system(file.folder, file.path, file.flags, before) != 0) return call();
  replace_with_own(before);
  if (const int result = call(); result != 0) return result;
  if (ask_system(file.folder, file.path, file.flags, after) != 0) return 0;
  FileRecord* const record_of = look_at(after);
  if (record_of == nullptr) return 0;
  const auto date = [&](int which, const statx_timestamp& last) {
    if (times == nullptr || times[which].tv_nsec == UTIME_NOW) return record_of->changed_ns;
    if (times[which].tv_nsec == UTIME_OMIT) return ns_of(last);
    return times[which].tv_sec * std::int64_t{1'000'000'000} + times[which].tv_nsec;
  };
  record_of->accessed_ns = date(0, before.stx_atime);
  record_of->modified_ns = date(1, before.stx_mtime);
  return 0;
}

/// Times in microseconds, as the newer calls take them.
struct AsTimespecs {
  explicit AsTimespecs(const timeval* from) : is_there(from != nullptr && can_be_read(from)) {
    for (int i = 0; i < 2 && is_there; ++i) times[i] = {from[i].tv_sec, from[i].tv_usec * 1000};
  }
  const timespec* get() const { return is_there ? times : nullptr; }
  bool is_there;
  timespec times[2];
};

}  // namespace
}  // namespace waitpoint::posix

using namespace waitpoint::posix;

WAITPOINT_INTERPOSED int utimensat(int folder, const char* path, const timespec times[2], int flags) noexcept {
  const PathInSystem in_system(path);
  return set_times({folder, in_system.get(), flags}, times,
                   [&] { return WAITPOINT_NEXT(utimensat)(folder, in_system.get(), times, flags); });
}
WAITPOINT_INTERPOSED int futimens(int descriptor, const timespec times[2]) noexcept {
  return set_times({descriptor, "", AT_EMPTY_PATH}, times, [&] { return WAITPOINT_NEXT(futimens)(descriptor, times); });
}
WAITPOINT_INTERPOSED int utimes(const char* path, const timeval times[2]) noexcept {
  return set_times({AT_FDCWD, path, 0}, AsTimespecs(times).get(), [&] { return WAITPOINT_NEXT(utimes)(path, times); });
}
WAITPOINT_INTERPOSED int lutimes(const char* path, const timeval times[2]) noexcept {
  return set_times({AT_FDCWD, path, AT_SYMLINK_NOFOLLOW}, AsTimespecs(times).get(),
                   [&] { return WAITPOINT_NEXT(lutimes)(path, times); });
}
WAITPOINT_INTERPOSED int futimes(int descriptor, const timeval times[2]) noexcept {
  return set_times({descriptor, "", AT_EMPTY_PATH}, AsTimespecs(times).get(),
                   [&] { return WAITPOINT_NEXT(futimes)(descriptor, times); });
}
WAITPOINT_INTERPOSED int futimesat(int folder, const char* path, const timeval times[2]) noexcept {
  return set_times({folder, path, 0}, AsTimespecs(times).get(),
                   [&] { return WAITPOINT_NEXT(futimesat)(folder, path, times); });
}
WAITPOINT_INTERPOSED int utime(const char* path, const utimbuf* times) noexcept {
  timespec given[2] = {};
  if (times != nullptr && can_be_read(times)) given[0].tv_sec = times->actime, given[1].tv_sec = times->modtime;
  return set_times({AT_FDCWD, path, 0}, times != nullptr ? given : nullptr,
                   [&] { return WAITPOINT_NEXT(utime)(path, times); });
}
