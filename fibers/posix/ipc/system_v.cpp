// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/ipc/system_v.hpp"

#include <unistd.h>

#include "fibers/posix/ipc/access.hpp"
#include "fibers/posix/ipc/system_v_ends.hpp"
#include "fibers/posix/program/waiting.hpp"
#include "fibers/posix/time/clocks.hpp"

namespace waitpoint::posix {

bool is_in_group(gid_t group) {
  if (group == getegid()) return true;
  gid_t groups[65536 / sizeof(gid_t)];
  const int count = getgroups(sizeof groups / sizeof *groups, groups);
  for (int i = 0; i < count; ++i)
    if (groups[i] == group) return true;
  return false;
}

}  // namespace waitpoint::posix

namespace waitpoint::posix::system_v {

void set_creator(Common& common, key_t key, int flags) {
  common.permissions.__key = key;
  common.permissions.uid = common.permissions.cuid = geteuid();
  common.permissions.gid = common.permissions.cgid = getegid();
  common.permissions.mode = static_cast<mode_t>(flags & 0777);
}

bool is_allowed(const Common& common, int asked) {
  const uid_t user = geteuid();
  if (user == 0) return true;
  const ipc_perm& permissions = common.permissions;
  unsigned granted = permissions.mode;
  if (user == permissions.uid || user == permissions.cuid)
    granted >>= 6;
  else if (is_in_group(permissions.gid) || is_in_group(permissions.cgid))
    granted >>= 3;
  return (static_cast<unsigned>(asked) & ~granted & 7) == 0;
}

bool is_owner(const Common& common) {
  const uid_t user = geteuid();
  return user == 0 || user == common.permissions.uid || user == common.permissions.cuid;
}

void set_owner(Common& common, const ipc_perm& to) {
  common.permissions.uid = to.uid;
  common.permissions.gid = to.gid;
  common.permissions.mode = (common.permissions.mode & ~0777U) | (to.mode & 0777);
}

time_t date() {
  const Time now = is_simulated() ? kernel::local_time(*kernel::running) : Time();
  return to_timespec(reading_ns(CLOCK_REALTIME, now)).tv_sec;
}

void forget_waiter(const kernel::Task& task) {
  forget_semaphore_waiter(task);
  forget_message_waiter(task);
}

void pass_if_simulated(kernel::Operation operation, kernel::Object* object) {
  if (is_simulated()) pass(operation, object);
}

}  // namespace waitpoint::posix::system_v
