// SPDX-License-Identifier: BSD-3-Clause
//
// fopen(): the C library would open files by calls that the layer does not see.
#include <fcntl.h>

#include <cstdio>
#include <cstring>

#include "fibers/posix/base/interposed.hpp"
#include "fibers/posix/files/file_records.hpp"
#include "fibers/posix/files/process_paths.hpp"
#include "fibers/posix/files/random_devices.hpp"
#include "fibers/posix/files/system_files.hpp"
#include "fibers/posix/input_output/fifos.hpp"
#include "fibers/posix/program/file_places.hpp"
#include "fibers/posix/program/program.hpp"

using namespace waitpoint::posix;

namespace {

int flags_of(const char* mode) {
  const int closes = std::strchr(mode, 'e') != nullptr ? O_CLOEXEC : 0;
  if (std::strchr(mode, '+') != nullptr) return O_RDWR | closes;
  return (mode[0] == 'r' ? O_RDONLY : O_WRONLY) | closes;
}

int flags_to_open(const char* mode) {
  return flags_of(mode) | (mode[0] == 'w' ? O_CREAT | O_TRUNC : mode[0] == 'a' ? O_CREAT : 0);
}

}  // namespace

WAITPOINT_INTERPOSED FILE* fopen64(const char* __restrict path, const char* __restrict mode) {
  if (!is_simulated()) {
    FILE* const stream = WAITPOINT_NEXT(fopen64)(path, mode);
    return has_host ? stream : with_own_bytes(stream, mode);  // of the program, before main()
  }
  before_call<"fopen">([&] { return opening(AT_FDCWD, path, flags_to_open(mode)); });
  note_use_of(path);
  const bool only_reads = mode[0] == 'r' && std::strchr(mode, '+') == nullptr;
  const int generated = only_reads && is_in_proc(path)
                            ? open_generated(path, std::strchr(mode, 'e') != nullptr ? O_CLOEXEC : 0)
                            : not_generated;
  if (generated != not_generated) return generated < 0 ? nullptr : WAITPOINT_NEXT(fdopen)(generated, mode);
  const PathInSystem in_system(path);
  if (const int flags = flags_of(mode); is_fifo_to_wait_for(AT_FDCWD, in_system.get(), flags)) {
    const int opened = open_fifo(AT_FDCWD, in_system.get(), flags);
    return opened < 0 ? nullptr : fdopen(opened, mode);
  }
  FILE* const stream = WAITPOINT_NEXT(fopen64)(in_system.get(), mode);
  if (stream != nullptr && !only_reads) note_opened(fileno(stream));
  return with_own_bytes(stream, mode);
}
// Under the C library's name: its header redirects it to the other.
extern "C" [[gnu::visibility("default"), gnu::alias("fopen64"), gnu::malloc]] FILE* waitpoint_fopen(
    const char*, const char*) __asm__("fopen");
