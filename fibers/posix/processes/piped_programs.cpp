// SPDX-License-Identifier: BSD-3-Clause
//
// Streams to other processes: popen() and pclose(), whose counterparts in the C library start and wait without a call
// that could be simulated.
#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "fibers/posix/base/error_number.hpp"
#include "fibers/posix/base/interposed.hpp"
#include "fibers/posix/descriptors/inside_files.hpp"
#include "fibers/posix/family/order.hpp"
#include "fibers/posix/files/random_devices.hpp"
#include "fibers/posix/program/program.hpp"
#include "fibers/posix/traps/library_calls.hpp"

namespace waitpoint::posix {
namespace {

struct Piped {
  FILE* stream;
  pid_t shell;
  Piped* next;
};
Piped* first = nullptr;

/// "r" or "w", with "e" for close-on-exec.
struct Mode {
  bool is_valid = true, reads = false, writes = false, closes = false;

  explicit Mode(const char* type) {
    for (; *type != '\0'; ++type) {
      if (*type == 'r')
        reads = true;
      else if (*type == 'w')
        writes = true;
      else if (*type == 'e')
        closes = true;
      else
        is_valid = false;
    }
    is_valid = is_valid && reads != writes;
  }
};

// The shell has the other end as its standard input or output, and none of the earlier streams. Returns an error
// number.
int start_shell(const char* command, int own_end, int other_end, int standard, pid_t& shell) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  for (const Piped* each = first; each != nullptr; each = each->next)
    posix_spawn_file_actions_addclose(&actions, fileno(each->stream));
  posix_spawn_file_actions_addclose(&actions, own_end);
  posix_spawn_file_actions_adddup2(&actions, other_end, standard);
  if (other_end != standard) posix_spawn_file_actions_addclose(&actions, other_end);
  char* const words[] = {const_cast<char*>("sh"), const_cast<char*>("-c"), const_cast<char*>(command), nullptr};
  const int error = posix_spawn(&shell, "/bin/sh", &actions, nullptr, words, environ);
  posix_spawn_file_actions_destroy(&actions);
  return error;
}

}  // namespace
}  // namespace waitpoint::posix

using namespace waitpoint::posix;

WAITPOINT_INTERPOSED FILE* popen(const char* command, const char* type) {
  if (!is_simulated()) return WAITPOINT_NEXT(popen)(command, type);
  const Mode mode(type);
  if (!mode.is_valid) {
    errno = EINVAL;
    return nullptr;
  }
  int ends[2] = {-1, -1};
  auto* const piped = static_cast<Piped*>(std::malloc(sizeof(Piped)));
  if (piped == nullptr || pipe2(ends, mode.closes ? O_CLOEXEC : 0) != 0) {
    std::free(piped);
    return nullptr;
  }
  const int own_end = ends[mode.reads ? 0 : 1], other_end = ends[mode.reads ? 1 : 0];
  FILE* const stream = fdopen(own_end, mode.reads ? "r" : "w");
  pid_t shell = 0;
  const int error = stream == nullptr
                        ? errno
                        : start_shell(command, own_end, other_end, mode.reads ? STDOUT_FILENO : STDIN_FILENO, shell);
  close(other_end);
  if (error != 0) {
    stream != nullptr ? fclose(stream) : close(own_end);
    std::free(piped);
    errno = error;
    return nullptr;
  }
  trap_stream(own_end);
  *piped = {stream, shell, first};
  first = piped;
  return stream;
}

WAITPOINT_INTERPOSED int pclose(FILE* stream) {
  Piped** link = &first;
  while (*link != nullptr && (*link)->stream != stream) link = &(*link)->next;
  if (*link == nullptr) return WAITPOINT_NEXT(pclose)(stream);
  Piped* const piped = *link;
  *link = piped->next;
  const pid_t shell = piped->shell;
  std::free(piped);
  fclose(stream);
  int status = -1;
  while (waitpid(shell, &status, 0) < 0)
    if (errno != EINTR) return -1;
  return status;
}

// Its calls within the C library are to be noticed.
WAITPOINT_INTERPOSED FILE* fdopen(int descriptor, const char* mode) noexcept {
  FILE* const stream = WAITPOINT_NEXT(fdopen)(descriptor, mode);
  if (stream == nullptr || !is_simulated()) return stream;
  family::has_others() ? trap_stream(descriptor) : note_stream(descriptor);
  return with_own_bytes(stream, mode);
}
