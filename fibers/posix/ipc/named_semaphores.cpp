// SPDX-License-Identifier: BSD-3-Clause
//
// Named semaphores: private to this simulation, that is its processes and, if there are several, its programs.
#include <fcntl.h>
#include <limits.h>
#include <semaphore.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdarg>
#include <cstdlib>
#include <cstring>
#include <type_traits>

#include "core/error.hpp"
#include "fibers/posix/base/error_number.hpp"
#include "fibers/posix/base/interposed.hpp"
#include "fibers/posix/family/order.hpp"
#include "fibers/posix/ipc/access.hpp"
#include "fibers/posix/ipc/named_objects.hpp"
#include "fibers/posix/program/state_calls.hpp"

namespace waitpoint::posix {
namespace {

constexpr int names_max = 4096;

/// In the family's memory, until no other process can have it open.
struct Named {
  char name[NAME_MAX + 1];
  sem_t semaphore;
  bool unlinked;
  // As of the file that it would be.
  uid_t owner;
  gid_t group;
  mode_t mode;
};

struct Names {
  Named* at[names_max];
  bool has_forked;
};

static_assert(std::is_trivially_default_constructible_v<Named> && std::is_trivially_default_constructible_v<Names>,
              "they are made of memory full of zeroes");

Names* names = nullptr;  // in the family's memory
/// Times that this process has opened it and not closed it.
unsigned opened[names_max];

Names* all_names() { return names = static_cast<Names*>(family::common(family::Part::names, sizeof(Names))); }

// Returns names_max if there is none.
int find_named(const char* name) {
  int at = 0;
  while (at < names_max &&
         (names->at[at] == nullptr || names->at[at]->unlinked || std::strcmp(names->at[at]->name, name) != 0))
    ++at;
  return at;
}

void let_go(int at) {
  Named* const named = names->at[at];
  if (named == nullptr || !named->unlinked || opened[at] > 0) return;
  if (names->has_forked && family::has_others()) return;
  sem_destroy(&named->semaphore);
  family::give(named);
  names->at[at] = nullptr;
}

// As glibc, which makes files "sem.NAME" of them: one optional slash at the start, none behind it.
bool is_name(const char* name) {
  if (*name == '/') ++name;
  const std::size_t length = std::strlen(name);
  return length > 0 && length <= NAME_MAX - 4 && std::strchr(name, '/') == nullptr;
}

// To use it is to read and to write its file.
bool may_use(const Named& named) {
  const uid_t user = geteuid();
  if (user == 0) return true;
  const unsigned shift = user == named.owner ? 6 : is_in_group(named.group) ? 3 : 0;
  constexpr unsigned both = 6;
  return (named.mode >> shift & both) == both;
}

// The files' folder is sticky: who may remove the name owns the file.
bool may_unlink(const Named& named) {
  const uid_t user = geteuid();
  return user == 0 || user == named.owner;
}

mode_t unmasked(mode_t mode) {
  const mode_t mask = umask(0);
  umask(mask);
  return mode & 0777 & ~mask;
}

// Returns an error number.
int make_named(const char* name, mode_t mode, unsigned count, int& at) {
  for (at = 0; at < names_max && names->at[at] != nullptr;) ++at;
  if (at == names_max) return ENFILE;
  auto* const named = static_cast<Named*>(family::take(sizeof(Named)));
  if (named == nullptr) return ENOMEM;
  WAITPOINT_CHECK(std::strlen(name) < sizeof named->name, "a semaphore's name does not fit into its record");
  std::strcpy(named->name, name);
  sem_init(&named->semaphore, 1, count);
  named->owner = geteuid();
  named->group = getegid();
  named->mode = unmasked(mode);
  names->at[at] = named;
  return 0;
}

// Returns an error number, and the index of the name.
int open(const char* name, int flags, mode_t mode, unsigned count, int& at) {
  if (!is_name(name)) return EINVAL;
  if (*name == '/') ++name;
  if (all_names() == nullptr) return ENOMEM;
  at = find_named(name);
  const bool exists = at < names_max;
  if (!exists && (flags & O_CREAT) == 0) return ENOENT;
  if (exists && (flags & O_CREAT) != 0 && (flags & O_EXCL) != 0) return EEXIST;
  if (exists && !may_use(*names->at[at])) return EACCES;
  if (!exists && count > SEM_VALUE_MAX) return EINVAL;
  if (!exists)
    if (const int error = make_named(name, mode, count, at); error != 0) return error;
  WAITPOINT_CHECK(at >= 0 && at < names_max && names->at[at] != nullptr, "a semaphore was opened that has no name");
  ++opened[at];
  return 0;
}

}  // namespace

void share_named_semaphores() {
  if (all_names() != nullptr) names->has_forked = true;
}

void forget_named_semaphores() {
  for (int at = 0; names != nullptr && at < names_max; ++at) {
    if (names->at[at] == nullptr) continue;
    names->at[at]->unlinked = true;
    opened[at] = 0;
    let_go(at);
  }
}

}  // namespace waitpoint::posix

using namespace waitpoint;
using namespace waitpoint::posix;

WAITPOINT_INTERPOSED sem_t* sem_open(const char* name, int flags, ...) noexcept {
  mode_t mode = 0;
  unsigned count = 0;
  if ((flags & O_CREAT) != 0) {
    va_list more;
    va_start(more, flags);
    mode = va_arg(more, mode_t);
    count = va_arg(more, unsigned);
    va_end(more);
  }
  before_call<"sem_open">(changing(place::objects));
  int at = 0;
  if (const int error = posix::open(name, flags, mode, count, at); error != 0) {
    errno = error;
    return SEM_FAILED;
  }
  return &names->at[at]->semaphore;
}

WAITPOINT_INTERPOSED int sem_close(sem_t* semaphore) noexcept {
  before_call<"sem_close">(changing(place::objects));
  for (int at = 0; names != nullptr && at < names_max; ++at) {
    if (opened[at] == 0 || &names->at[at]->semaphore != semaphore) continue;
    --opened[at];
    let_go(at);
    return 0;
  }
  return fail(EINVAL);
}

WAITPOINT_INTERPOSED int sem_unlink(const char* name) noexcept {
  before_call<"sem_unlink">(changing(place::objects));
  if (*name == '/') ++name;
  const int at = names != nullptr ? find_named(name) : names_max;
  if (at == names_max) return fail(ENOENT);
  if (!may_unlink(*names->at[at])) return fail(EACCES);
  names->at[at]->unlinked = true;
  let_go(at);
  return 0;
}
