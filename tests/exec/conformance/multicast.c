// SPDX-License-Identifier: BSD-3-Clause
// Datagrams to groups of receivers, over the loopback.
#include "tests/exec/conformance/harness.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>

static struct sockaddr_in group;

static struct in_addr loopback(void) { return (struct in_addr){htonl(INADDR_LOOPBACK)}; }

// A socket that is bound to the group, at a port of its own for the first, and a member of it.
static int join_group(void) {
  const int made = socket(AF_INET, SOCK_DGRAM, 0);
  const int on = 1;
  socklen_t size = sizeof group;
  EXPECT_IS(setsockopt(made, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on), 0);
  group.sin_family = AF_INET;
  group.sin_addr.s_addr = inet_addr("239.255.77.1");
  EXPECT_IS(bind(made, (struct sockaddr*)&group, sizeof group), 0);
  EXPECT_IS(getsockname(made, (struct sockaddr*)&group, &size), 0);
  const struct ip_mreqn membership = {group.sin_addr, loopback(), 0};
  EXPECT_IS(setsockopt(made, IPPROTO_IP, IP_ADD_MEMBERSHIP, &membership, sizeof membership), 0);
  return made;
}

static int sender(void) {
  const int made = socket(AF_INET, SOCK_DGRAM, 0);
  const struct in_addr device = loopback();
  const unsigned char on = 1;
  EXPECT_IS(setsockopt(made, IPPROTO_IP, IP_MULTICAST_IF, &device, sizeof device), 0);
  EXPECT_IS(setsockopt(made, IPPROTO_IP, IP_MULTICAST_LOOP, &on, sizeof on), 0);
  EXPECT_IS(setsockopt(made, IPPROTO_IP, IP_MULTICAST_TTL, &on, sizeof on), 0);
  return made;
}

static void* send_to_group(void* unused) {
  let_others_wait();
  EXPECT_IS(sendto(sender(), "x", 1, 0, (struct sockaddr*)&group, sizeof group), 1);
  return unused;
}
CASE(a_datagram_wakes_all_members_of_its_group) {
  const int one = join_group(), two = join_group();
  char byte = 0;
  const pthread_t id = start(send_to_group, NULL);
  EXPECT_IS(recv(one, &byte, 1, 0), 1);
  EXPECT_IS(byte, 'x');
  byte = 0;
  EXPECT_IS(recv(two, &byte, 1, 0), 1);
  EXPECT_IS(byte, 'x');
  join(id);
}

CASE(who_has_left_its_group_gets_nothing) {
  const int member = join_group();
  const struct ip_mreqn membership = {group.sin_addr, loopback(), 0};
  const int off = 0;
  EXPECT_IS(setsockopt(member, IPPROTO_IP, IP_MULTICAST_ALL, &off, sizeof off), 0);
  EXPECT_IS(setsockopt(member, IPPROTO_IP, IP_DROP_MEMBERSHIP, &membership, sizeof membership), 0);
  char byte = 0;
  EXPECT_IS(sendto(sender(), "x", 1, 0, (struct sockaddr*)&group, sizeof group), 1);
  EXPECT_FAILS(recv(member, &byte, 1, MSG_DONTWAIT), EAGAIN);
}

CASE(a_message_in_parts_tells_its_destination) {
  const int member = join_group(), on = 1;
  EXPECT_IS(setsockopt(member, IPPROTO_IP, IP_PKTINFO, &on, sizeof on), 0);
  char out[3] = "ab", in[3] = "..";
  struct iovec sent[2] = {{out, 1}, {out + 1, 1}}, got[2] = {{in, 1}, {in + 1, 1}};
  struct msghdr message = {.msg_name = &group, .msg_namelen = sizeof group, .msg_iov = sent, .msg_iovlen = 2};
  EXPECT_IS(sendmsg(sender(), &message, 0), 2);
  _Alignas(struct cmsghdr) char control[CMSG_SPACE(sizeof(struct in_pktinfo))];
  struct msghdr received = {.msg_iov = got, .msg_iovlen = 2, .msg_control = control, .msg_controllen = sizeof control};
  EXPECT_IS(recvmsg(member, &received, 0), 2);
  EXPECT_IS(strcmp(in, "ab"), 0);
  const struct cmsghdr* const head = CMSG_FIRSTHDR(&received);
  EXPECT(head != NULL && head->cmsg_type == IP_PKTINFO);
  struct in_pktinfo info;
  memcpy(&info, CMSG_DATA(head), sizeof info);
  EXPECT_IS(info.ipi_addr.s_addr, group.sin_addr.s_addr);
}
