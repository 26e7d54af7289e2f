// SPDX-License-Identifier: BSD-3-Clause
//
// Names of temporary files: their letters are drawn from the seed, in a stream of their own. A name that is taken, as
// by an earlier run, is followed by the next one.
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <climits>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "fibers/posix/base/error_number.hpp"
#include "fibers/posix/base/interposed.hpp"
#include "fibers/posix/program/program.hpp"
#include "fibers/posix/program/randomness.hpp"

namespace waitpoint::posix {
namespace {

constexpr std::size_t letters = 6;
constexpr char marks[] = "XXXXXX";
static_assert(sizeof marks == letters + 1);

void draw_letters(char* at) {
  static constexpr char all[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789";
  std::uint64_t number = draw_random(Numbers::of_file_names) >> 8;
  for (std::size_t i = 0; i < letters; ++i, number /= sizeof all - 1) at[i] = all[number % (sizeof all - 1)];
}

// Calls `make` with names of this form until one is free; its result, or -1.
template <class Make>
int make_named(char* form, int suffix, Make make) {
  const std::size_t size = std::strlen(form);
  if (suffix < 0 || size < letters + static_cast<std::size_t>(suffix)) return fail(EINVAL);
  char* const at = form + size - static_cast<std::size_t>(suffix) - letters;
  if (std::strncmp(at, marks, letters) != 0) return fail(EINVAL);
  const int error = errno;
  for (int tries = 0; tries < TMP_MAX; ++tries) {
    draw_letters(at);
    errno = error;
    const int made = make(form);
    if (made >= 0 || errno != EEXIST) return made;
  }
  return fail(EEXIST);
}

int make_file(char* form, int suffix, int flags) {
  const int wanted = (flags & ~O_ACCMODE) | O_RDWR | O_CREAT | O_EXCL;
  return make_named(form, suffix, [&](const char* name) { return open(name, wanted, 0600); });
}

int find_free(const char* name) {
  struct stat of {};
  if (lstat(name, &of) == 0) return fail(EEXIST);
  return errno == ENOENT ? 0 : -1;
}

bool is_folder(const char* path) {
  struct stat of {};
  return path != nullptr && stat(path, &of) == 0 && S_ISDIR(of.st_mode);
}

}  // namespace
}  // namespace waitpoint::posix

using namespace waitpoint::posix;

// Under the C library's names: its headers redirect those without a size to the others.
#define WAITPOINT_SAME_AS(name) extern "C" [[gnu::visibility("default"), gnu::alias(#name)]]

WAITPOINT_INTERPOSED int mkostemps64(char* form, int suffix, int flags) {
  return is_simulated() ? make_file(form, suffix, flags) : WAITPOINT_NEXT(mkostemps64)(form, suffix, flags);
}
WAITPOINT_SAME_AS(mkostemps64) [[gnu::nonnull(1)]] int waitpoint_mkostemps(char*, int, int) __asm__("mkostemps");
WAITPOINT_INTERPOSED int mkstemps64(char* form, int suffix) { return mkostemps64(form, suffix, 0); }
WAITPOINT_SAME_AS(mkstemps64) [[gnu::nonnull(1)]] int waitpoint_mkstemps(char*, int) __asm__("mkstemps");
WAITPOINT_INTERPOSED int mkostemp64(char* form, int flags) { return mkostemps64(form, 0, flags); }
WAITPOINT_SAME_AS(mkostemp64) [[gnu::nonnull(1)]] int waitpoint_mkostemp(char*, int) __asm__("mkostemp");
WAITPOINT_INTERPOSED int mkstemp64(char* form) { return mkostemps64(form, 0, 0); }
WAITPOINT_SAME_AS(mkstemp64) [[gnu::nonnull(1)]] int waitpoint_mkstemp(char*) __asm__("mkstemp");

WAITPOINT_INTERPOSED char* mkdtemp(char* form) noexcept {
  if (!is_simulated()) return WAITPOINT_NEXT(mkdtemp)(form);
  return make_named(form, 0, [](const char* name) { return mkdir(name, 0700); }) == 0 ? form : nullptr;
}
WAITPOINT_INTERPOSED char* mktemp(char* form) noexcept {
  if (make_named(form, 0, find_free) != 0) *form = '\0';
  return form;
}

WAITPOINT_INTERPOSED char* tmpnam_r(char* name) noexcept {
  if (name == nullptr) return nullptr;
  std::snprintf(name, L_tmpnam, "%s/file%s", P_tmpdir, marks);
  return make_named(name, 0, find_free) == 0 ? name : nullptr;
}
WAITPOINT_INTERPOSED char* tmpnam(char* name) noexcept {
  static char own[L_tmpnam];
  return tmpnam_r(name != nullptr ? name : own);
}
WAITPOINT_INTERPOSED char* tempnam(const char* folder, const char* prefix) noexcept {
  const char* const asked = secure_getenv("TMPDIR");
  const char* const in = is_folder(asked) ? asked : is_folder(folder) ? folder : P_tmpdir;
  char name[PATH_MAX];
  const int size = std::snprintf(name, sizeof name, "%s/%.5s%s", in, prefix != nullptr ? prefix : "file", marks);
  if (size < 0 || static_cast<std::size_t>(size) >= sizeof name) return nullptr;
  return make_named(name, 0, find_free) == 0 ? strdup(name) : nullptr;
}
