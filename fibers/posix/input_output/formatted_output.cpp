// SPDX-License-Identifier: BSD-3-Clause
//
// dprintf(): the C library would write without a call that could be simulated.
#include <unistd.h>

#include <cerrno>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>

#include "fibers/posix/base/interposed.hpp"

WAITPOINT_INTERPOSED int vdprintf(int descriptor, const char* __restrict format, va_list words) {
  char* text = nullptr;
  const int size = vasprintf(&text, format, words);
  if (size < 0) return -1;
  int written = 0;
  while (written < size) {
    const ssize_t count = write(descriptor, text + written, static_cast<std::size_t>(size - written));
    if (count < 0) break;
    written += static_cast<int>(count);
  }
  const int error = errno;
  std::free(text);
  errno = error;
  return written == size ? size : -1;
}
WAITPOINT_INTERPOSED int __vdprintf_chk(int descriptor, int, const char* format, va_list words) {
  return vdprintf(descriptor, format, words);
}
WAITPOINT_INTERPOSED int dprintf(int descriptor, const char* __restrict format, ...) {
  va_list words;
  va_start(words, format);
  const int size = vdprintf(descriptor, format, words);
  va_end(words);
  return size;
}
WAITPOINT_INTERPOSED int __dprintf_chk(int descriptor, int, const char* format, ...) {
  va_list words;
  va_start(words, format);
  const int size = vdprintf(descriptor, format, words);
  va_end(words);
  return size;
}
