// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/exec/own_machine.hpp"

#include <net/if.h>
#include <net/route.h>
#include <netinet/in.h>
#include <sched.h>
#include <sys/ioctl.h>
#include <sys/mount.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>

#include "fibers/posix/base/interposed.hpp"
#include "fibers/posix/program/program.hpp"

namespace waitpoint::posix {
namespace {

[[noreturn]] void refuse_machine(const char* what) {
  char reason[160];
  std::snprintf(reason, sizeof reason, "--own-machine: cannot make %s: %s", what, std::strerror(errno));
  refuse(reason);
}

// The loopback is up and says that it passes multicast on, which programs look at.
bool start_loopback(int socket) {
  ifreq device{};
  std::strcpy(device.ifr_name, "lo");
  device.ifr_flags = IFF_UP | IFF_LOOPBACK | IFF_RUNNING | IFF_MULTICAST;
  return WAITPOINT_NEXT(ioctl)(socket, SIOCSIFFLAGS, &device) == 0;
}

// For sockets that name no device for multicast.
bool route_multicast(int socket) {
  rtentry route{};
  const auto set = [](sockaddr& address, in_addr_t host) {
    auto& internet = reinterpret_cast<sockaddr_in&>(address);
    internet.sin_family = AF_INET;
    internet.sin_addr.s_addr = htonl(host);
  };
  set(route.rt_dst, INADDR_UNSPEC_GROUP);
  set(route.rt_genmask, 0xF000'0000);
  route.rt_flags = RTF_UP;
  char loopback[] = "lo";
  route.rt_dev = loopback;
  return WAITPOINT_NEXT(ioctl)(socket, SIOCADDRT, &route) == 0;
}

}  // namespace

void enter_own_machine() {
  if (unshare(CLONE_NEWNET | CLONE_NEWNS | CLONE_NEWIPC) != 0) refuse_machine("namespaces");
  const bool is_private = mount(nullptr, "/", nullptr, MS_REC | MS_PRIVATE, nullptr) == 0;
  if (!is_private || mount("tmpfs", "/dev/shm", "tmpfs", MS_NOSUID | MS_NODEV, "mode=1777") != 0)
    refuse_machine("a folder /dev/shm");
  const int socket = WAITPOINT_NEXT(socket)(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  if (socket < 0 || !start_loopback(socket) || !route_multicast(socket)) refuse_machine("a loopback device");
  WAITPOINT_NEXT(close)(socket);
}

}  // namespace waitpoint::posix
