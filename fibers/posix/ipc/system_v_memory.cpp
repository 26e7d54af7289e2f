// SPDX-License-Identifier: BSD-3-Clause
//
// System V shared memory: pages of the family's memory, mapped again by each attachment.
#include <sys/mman.h>
#include <sys/shm.h>
#include <unistd.h>

#include <cstdint>
#include <cstring>

#include "fibers/posix/base/interposed.hpp"
#include "fibers/posix/ipc/system_v.hpp"
#include "fibers/posix/ipc/system_v_ends.hpp"

namespace waitpoint::posix::system_v {
namespace {

// Linux's defaults.
constexpr int segments_max = 4096;
constexpr std::size_t page = 4096;

struct Segment : Common {
  Segment() : Common("System V shared memory") {}
  ~Segment() {
    WAITPOINT_CHECK(attachments == 0, "shared memory is freed that is attached");
    family::give_pages(pages, mapped_bytes());
  }
  std::size_t mapped_bytes() const { return (size + page - 1) / page * page; }

  std::size_t size = 0;
  void* pages = nullptr;
  time_t attached = 0, detached = 0, changed = 0;
  pid_t creator = 0, last = 0;
  unsigned long attachments = 0;
};

struct Attachment {
  pid_t process;
  void* address;
  Segment* segment;
  Attachment* next;
};

/// In the family's memory.
struct Segments : Table<Segment, segments_max> {
  Attachment* first;
};
Segments& segments() { return table_of<Segments>(family::Part::memory); }

// Maps the same pages a second time.
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
  auto* const made = static_cast<Attachment*>(family::take(sizeof(Attachment)));
  if (made == nullptr) {
    munmap(address, segment.mapped_bytes());
    return nullptr;
  }
  // In this order a process that is killed in between leaves too great a count.
  ++segment.attachments;
  ++segment.users;
  *made = {family::this_process(), address, &segment, segments().first};
  segments().first = made;
  segment.last = family::this_process();
  segment.attached = date();
  return address;
}

// A segment marked for destruction is removed with its last attachment.
void destroy_if_unused(Segment& segment) {
  if ((segment.permissions.mode & SHM_DEST) != 0 && segment.attachments == 0 && !segment.removed)
    segments().remove(segment);
}

// Removes an attachment.
void drop(Attachment** link) {
  Attachment* const attachment = *link;
  *link = attachment->next;
  Segment& segment = *attachment->segment;
  WAITPOINT_CHECK(segment.attachments > 0 && segment.users > 0, "shared memory is detached that counts no attachments");
  segment.last = attachment->process;
  segment.detached = date();
  family::give(attachment);
  --segment.users;
  --segment.attachments;
  destroy_if_unused(segment);
  if (segment.removed && segment.users == 0) free_object(segment);
}

// Detaches everything of processes that have ended.
void drop_dead() {
  for (Attachment** link = &segments().first; *link != nullptr;) {
    const pid_t process = (*link)->process;
    if (process == family::this_process() || family::lives(process))
      link = &(*link)->next;
    else
      drop(link);
  }
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
  return segments().greatest_slot();
}

int tell_use(void* to) {
  shm_info use{};
  use.used_ids = segments().count();
  for (int slot = 0; slot < segments().end(); ++slot)
    if (const Segment* segment = segments().in_slot(slot); segment != nullptr)
      use.shm_tot += segment->mapped_bytes() / page;
  use.shm_rss = use.shm_tot;
  std::memcpy(to, &use, sizeof use);
  return segments().greatest_slot();
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
  while (Attachment* const first = segments().first) {
    munmap(first->address, first->segment->mapped_bytes());
    drop(&segments().first);
  }
  segments().clear();
}

void inherit_memory(pid_t parent) {
  for (Attachment* each = segments().first; each != nullptr; each = each->next) {
    if (each->process != parent) continue;
    auto* const made = static_cast<Attachment*>(family::take(sizeof(Attachment)));
    if (made == nullptr) return;
    ++each->segment->attachments;
    ++each->segment->users;
    *made = {family::this_process(), each->address, each->segment, segments().first};
    segments().first = made;
  }
}

}  // namespace waitpoint::posix::system_v

using namespace waitpoint;
using namespace waitpoint::posix;
using namespace waitpoint::posix::system_v;

WAITPOINT_INTERPOSED int shmget(key_t key, std::size_t size, int flags) noexcept {
  pass_if_simulated(kernel::Operation::open, nullptr);
  drop_dead();
  return segments().get(
      key, flags, [&](const Segment& segment) { return size > segment.size ? EINVAL : 0; },
      [&](Segment*& made) {
        if (size == 0 || size > SIZE_MAX / 2) return size == 0 ? EINVAL : ENOMEM;
        made = make_object<Segment>();
        if (made == nullptr) return ENOMEM;
        made->size = size;
        made->pages = family::take_pages(made->mapped_bytes());
        if (made->pages == nullptr) {
          family::give(made);
          return ENOMEM;
        }
        WAITPOINT_CHECK(reinterpret_cast<std::uintptr_t>(made->pages) % page == 0,
                        "shared memory is not on whole pages");
        made->creator = family::this_process();
        made->changed = date();
        return 0;
      });
}

WAITPOINT_INTERPOSED void* shmat(int id, const void* address, int flags) noexcept {
  void* const failed = reinterpret_cast<void*>(-1);
  auto at = reinterpret_cast<std::uintptr_t>(address);
  if ((flags & SHM_RND) != 0) at -= at % SHMLBA;
  const auto failing = [&](int error) {
    fail(error);
    return failed;
  };
  const Use<Segment> segment([&] { return segments().find(id); });
  if (!segment || at % SHMLBA != 0 || (at == 0 && (flags & SHM_REMAP) != 0)) return failing(EINVAL);
  if (!is_allowed(*segment, (flags & SHM_RDONLY) != 0 ? 4 : 6)) return failing(EACCES);
  pass_if_simulated(kernel::Operation::open, &object_of(*segment));
  if (segment->removed) return failing(EIDRM);
  void* const wanted = reinterpret_cast<void*>(at);
  if (wanted != nullptr && (flags & SHM_REMAP) == 0 && !is_free(wanted, segment->mapped_bytes()))
    return failing(EINVAL);
  void* const attached = attach(*segment, wanted, flags);
  return attached != nullptr ? attached : failing(ENOMEM);
}

WAITPOINT_INTERPOSED int shmdt(const void* address) noexcept {
  pass_if_simulated(kernel::Operation::close, nullptr);
  Attachment** link = &segments().first;
  while (*link != nullptr && ((*link)->address != address || (*link)->process != family::this_process()))
    link = &(*link)->next;
  if (*link == nullptr) return fail(EINVAL);
  munmap(const_cast<void*>(address), (*link)->segment->mapped_bytes());
  drop(link);
  return 0;
}

WAITPOINT_INTERPOSED int shmctl(int id, int command, shmid_ds* status) noexcept {
  if (command < 0 || id < 0) return fail(EINVAL);
  if (command == IPC_INFO || command == SHM_INFO) {
    if (!has_memory(command, true, status)) return fail(EFAULT);
    return command == IPC_INFO ? tell_limits(status) : tell_use(status);
  }
  const bool by_slot = command == SHM_STAT || command == SHM_STAT_ANY;
  const Use<Segment> segment([&] { return by_slot ? segments().in_slot(id) : segments().find(id); });
  if (!segment) return fail(EINVAL);
  if (!has_memory(command, by_slot || command == IPC_STAT, status)) return fail(EFAULT);
  if (by_slot) {
    if (command == SHM_STAT && !is_allowed(*segment, 4)) return fail(EACCES);
    tell_status(*segment, status);
    return segment->id;
  }
  pass_if_simulated(kernel::Operation::modify, &object_of(*segment));
  drop_dead();
  return segment->removed ? fail(EIDRM) : control(*segment, command, status);
}
