// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/files/text_file.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <cstdarg>
#include <cstdio>

#include "core/error.hpp"
#include "fibers/posix/base/error_number.hpp"
#include "fibers/posix/base/interposed.hpp"

namespace waitpoint::posix {

TextFile::TextFile() : descriptor_(memfd_create("text", MFD_CLOEXEC)) {}

void TextFile::add(const char* format, ...) {
  char line[512];
  va_list more;
  va_start(more, format);
  const int size = std::vsnprintf(line, sizeof line, format, more);
  va_end(more);
  WAITPOINT_CHECK(size >= 0 && static_cast<std::size_t>(size) < sizeof line, "a line of a generated file is too long");
  if (descriptor_ >= 0) (void)WAITPOINT_NEXT(write)(descriptor_, line, static_cast<std::size_t>(size));
}

int TextFile::finish(bool close_on_exec) {
  if (descriptor_ < 0) return -1;
  WAITPOINT_NEXT(lseek)(descriptor_, 0, SEEK_SET);
  if (!close_on_exec) WAITPOINT_NEXT(fcntl)(descriptor_, F_SETFD, 0);
  return descriptor_;
}

bool read_system_file(const char* path, char* text, std::size_t size) {
  const ErrorNumberKept kept;
  const int file = WAITPOINT_NEXT(open)(path, O_RDONLY | O_CLOEXEC);
  if (file < 0) return false;
  std::size_t filled = 0;
  ssize_t more = 0;
  while (filled < size - 1 && (more = WAITPOINT_NEXT(read)(file, text + filled, size - 1 - filled)) > 0)
    filled += static_cast<std::size_t>(more);
  WAITPOINT_NEXT(close)(file);
  text[filled] = '\0';
  return filled > 0;
}

}  // namespace waitpoint::posix
