// SPDX-License-Identifier: BSD-3-Clause
//
// System V shared memory: pages of the process, which each attachment maps once more. A child made by fork() shares the
// pages of the segments that were there before.
#include <sys/mman.h>
#include <sys/shm.h>
#include <unistd.h>

#include <cstdint>
#include <cstring>

#include "fibers/posix/interposed.hpp"
#include "fibers/posix/system_v.hpp"
#include "fibers/posix/system_v_ends.hpp"

namespace waitpoint::posix::system_v {
namespace {

// Linux's, as it is when a machine starts.
constexpr int segments_max = 4096;
constexpr std::size_t page = 4096;

struct Segment : Common {
  Segment() : Common("System V shared memory") {}
  ~Segment() { munmap(pages, mapped_bytes()); }
  std::size_t mapped_bytes() const { return (size + page - 1) / page * page; }

  std::size_t size = 0;
  void* pages = MAP_FAILED;
  time_t attached = 0, detached = 0, changed = 0;
  pid_t creator = 0, last = 0;
  unsigned long attachments = 0;
};

struct Attachment {
  void* address;
  Segment* segment;
  Attachment* next;
};

Table<Segment, segments_max> segments;
Attachment* first = nullptr;

// One more name for the same pages.
void* map_again(const Segment& segment, void* at) {
  const int flags = at == nullptr ? MREMAP_MAYMOVE : MREMAP_MAYMOVE | MREMAP_FIXED;
  return mremap(segment.pages, 0, segment.mapped_bytes(), flags, at);
}

bool is_free(void* address, std::size_t bytes) {
  void* const mapped = mmap(address, bytes, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_FIXED_NOREPLACE, -1, 0);
  if (mapped == address) munmap(mapped, bytes);
  return mapped == address;
}

void* attach(Segment& segment, void* at, int flags) {
  void* const address = map_again(segment, at);
  if (address == MAP_FAILED) return nullptr;
  int protection = PROT_READ;
  if ((flags & SHM_RDONLY) == 0) protection |= PROT_WRITE;
  if ((flags & SHM_EXEC) != 0) protection |= PROT_EXEC;
  mprotect(address, segment.mapped_bytes(), protection);
  auto* const made = static_cast<Attachment*>(std::malloc(sizeof(Attachment)));
  if (made == nullptr) {
    munmap(address, segment.mapped_bytes());
    return nullptr;
  }
  *made = {address, &segment, first};
  first = made;
  ++segment.attachments;
  ++segment.users;
  segment.last = getpid();
  segment.attached = date();
  return address;
}

// What is marked for destruction goes with its last attachment.
void destroy_if_unused(Segment& segment) {
  if ((segment.permissions.mode & SHM_DEST) != 0 && segment.attachments == 0 && !segment.removed)
    segments.remove(segment);
}

int tell_status(const Segment& segment, shmid_ds* to) {
  *to = {};
  to->shm_perm = segment.permissions;
  to->shm_segsz = segment.size;
  to->shm_atime = segment.attached;
  to->shm_dtime = segment.detached;
  to->shm_ctime = segment.changed;
  to->shm_cpid = segment.creator;
  to->shm_lpid = segment.last;
  to->shm_nattch = segment.attachments;
  return 0;
}

int tell_limits(void* to) {
  constexpr unsigned long most = ~0UL - (1UL << 24);
  const shminfo limits{most, 1, segments_max, segments_max, most, 0, 0, 0, 0};
  std::memcpy(to, &limits, sizeof limits);
  return segments.greatest_slot();
}

int tell_use(void* to) {
  shm_info use{};
  use.used_ids = segments.count();
  for (int slot = 0; slot < segments.end(); ++slot)
    if (const Segment* segment = segments.in_slot(slot); segment != nullptr)
      use.shm_tot += segment->mapped_bytes() / page;
  use.shm_rss = use.shm_tot;
  std::memcpy(to, &use, sizeof use);
  return segments.greatest_slot();
}

int control(Segment& segment, int command, shmid_ds* status) {
  switch (command) {
    case IPC_STAT: return is_allowed(segment, 4) ? tell_status(segment, status) : fail(EACCES);
    case IPC_SET:
      if (!is_owner(segment)) return fail(EPERM);
      set_owner(segment, status->shm_perm);
      segment.changed = date();
      return 0;
    case IPC_RMID:
      if (!is_owner(segment)) return fail(EPERM);
      segment.permissions.mode |= SHM_DEST;
      segment.permissions.__key = IPC_PRIVATE;
      destroy_if_unused(segment);
      return 0;
    case SHM_LOCK:
    case SHM_UNLOCK:
      if (!is_owner(segment)) return fail(EPERM);
      segment.permissions.mode &= ~static_cast<mode_t>(SHM_LOCKED);
      if (command == SHM_LOCK) segment.permissions.mode |= SHM_LOCKED;
      return 0;
    default: return fail(EINVAL);
  }
}

}  // namespace

void forget_memory() {
  while (first != nullptr) shmdt(first->address);
  segments.clear();
}

}  // namespace waitpoint::posix::system_v

using namespace waitpoint;
using namespace waitpoint::posix;
using namespace waitpoint::posix::system_v;

WAITPOINT_INTERPOSED int shmget(key_t key, std::size_t size, int flags) noexcept {
  pass_if_simulated(kernel::Operation::open, nullptr);
  return segments.get(
      key, flags, [&](const Segment& segment) { return size > segment.size ? EINVAL : 0; },
      [&](Segment*& made) {
        if (size == 0 || size > SIZE_MAX / 2) return size == 0 ? EINVAL : ENOMEM;
        made = make_object<Segment>();
        if (made == nullptr) return ENOMEM;
        made->size = size;
        made->pages = mmap(nullptr, made->mapped_bytes(), PROT_READ | PROT_WRITE,
                           MAP_SHARED | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
        if (made->pages == MAP_FAILED) {
          std::free(made);
          return ENOMEM;
        }
        made->creator = getpid();
        made->changed = date();
        return 0;
      });
}

WAITPOINT_INTERPOSED void* shmat(int id, const void* address, int flags) noexcept {
  void* const failed = reinterpret_cast<void*>(-1);
  auto at = reinterpret_cast<std::uintptr_t>(address);
  if ((flags & SHM_RND) != 0) at -= at % SHMLBA;
  Segment* const segment = segments.find(id);
  if (segment == nullptr || at % SHMLBA != 0 || (at == 0 && (flags & SHM_REMAP) != 0)) {
    fail(EINVAL);
    return failed;
  }
  const Use<Segment> use(segment);
  if (!is_allowed(*segment, (flags & SHM_RDONLY) != 0 ? 4 : 6)) {
    fail(EACCES);
    return failed;
  }
  pass_if_simulated(kernel::Operation::open, &segment->object);
  if (segment->removed) {
    fail(EIDRM);
    return failed;
  }
  void* const wanted = reinterpret_cast<void*>(at);
  if (wanted != nullptr && (flags & SHM_REMAP) == 0 && !is_free(wanted, segment->mapped_bytes())) {
    fail(EINVAL);
    return failed;
  }
  void* const attached = attach(*segment, wanted, flags);
  if (attached != nullptr) return attached;
  fail(ENOMEM);
  return failed;
}

WAITPOINT_INTERPOSED int shmdt(const void* address) noexcept {
  pass_if_simulated(kernel::Operation::close, nullptr);
  Attachment** link = &first;
  while (*link != nullptr && (*link)->address != address) link = &(*link)->next;
  Attachment* const found = *link;
  if (found == nullptr) return fail(EINVAL);
  *link = found->next;
  Segment& segment = *found->segment;
  std::free(found);
  munmap(const_cast<void*>(address), segment.mapped_bytes());
  const Use<Segment> use(&segment);
  --segment.users;  // the attachment's
  --segment.attachments;
  segment.last = getpid();
  segment.detached = date();
  destroy_if_unused(segment);
  return 0;
}

WAITPOINT_INTERPOSED int shmctl(int id, int command, shmid_ds* status) noexcept {
  if (command < 0 || id < 0) return fail(EINVAL);
  if (command == IPC_INFO) return tell_limits(status);
  if (command == SHM_INFO) return tell_use(status);
  const bool by_slot = command == SHM_STAT || command == SHM_STAT_ANY;
  const Use<Segment> segment(by_slot ? segments.in_slot(id) : segments.find(id));
  if (!segment) return fail(EINVAL);
  if (by_slot) {
    if (command == SHM_STAT && !is_allowed(*segment, 4)) return fail(EACCES);
    tell_status(*segment, status);
    return segment->id;
  }
  pass_if_simulated(kernel::Operation::modify, &segment->object);
  return segment->removed ? fail(EIDRM) : control(*segment, command, status);
}
