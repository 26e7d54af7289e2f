// SPDX-License-Identifier: BSD-3-Clause
#include "tools/exec/own_machine_rights.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <linux/capability.h>
#include <sched.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <cstring>
#include <string>

#include "core/error.hpp"

namespace waitpoint::tools {
namespace {

constexpr std::uint32_t needed = 1u << CAP_SYS_ADMIN | 1u << CAP_NET_ADMIN;

struct Rights {
  __user_cap_header_struct head{_LINUX_CAPABILITY_VERSION_3, 0};
  __user_cap_data_struct words[_LINUX_CAPABILITY_U32S_3] = {};
};

bool read_rights(Rights& rights) { return syscall(SYS_capget, &rights.head, rights.words) == 0; }

bool write_into(const char* path, const std::string& text) {
  const int file = open(path, O_WRONLY | O_CLOEXEC);
  if (file < 0) return false;
  const bool is_written = write(file, text.data(), text.size()) == static_cast<ssize_t>(text.size());
  close(file);
  return is_written;
}

// All other users and groups are nobody there.
bool enter_user_namespace() {
  const uid_t user = geteuid();
  const gid_t group = getegid();
  return unshare(CLONE_NEWUSER) == 0 && write_into("/proc/self/setgroups", "deny") &&
         write_into("/proc/self/uid_map", fmt::format("{} {} 1", user, user)) &&
         write_into("/proc/self/gid_map", fmt::format("{} {} 1", group, group));
}

// Started programs keep them, as each finds the run's file in the files of this process, which must not have further
// rights; nor may it hide its files, as after a gain of rights.
bool pass_on_rights() {
  Rights rights;
  rights.words[0] = {needed, needed, needed};
  if (syscall(SYS_capset, &rights.head, rights.words) != 0) return false;
  for (const unsigned long right : {CAP_SYS_ADMIN, CAP_NET_ADMIN})
    if (prctl(PR_CAP_AMBIENT, PR_CAP_AMBIENT_RAISE, right, 0, 0) != 0) return false;
  return prctl(PR_SET_DUMPABLE, 1, 0, 0, 0) == 0;
}

}  // namespace

void take_rights_for_own_machine() {
  Rights rights;
  if (read_rights(rights) && (rights.words[0].effective & needed) == needed) return;
  if (!enter_user_namespace() || !pass_on_rights())
    throw BadInput("--own-machine",
                   std::string("expected a system that allows user namespaces, found: ") + std::strerror(errno));
}

}  // namespace waitpoint::tools
