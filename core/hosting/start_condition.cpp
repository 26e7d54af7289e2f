// SPDX-License-Identifier: BSD-3-Clause
#include "core/hosting/start_condition.hpp"

#include <arpa/inet.h>
#include <linux/inet_diag.h>
#include <linux/netlink.h>
#include <linux/sock_diag.h>
#include <netinet/tcp.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <string_view>
#include <vector>

#include "core/number_text.hpp"

namespace waitpoint {
namespace {

constexpr std::string_view of_port = "tcp:", of_start = ".started";

// A connection would disturb the server, so the system is asked for its listening sockets. It answers within the call
// that asks.
enum class Answer : std::uint8_t { no, yes, none };
Answer ask_system(int port, std::uint8_t family) {
  struct {
    nlmsghdr head;
    inet_diag_req_v2 body;
  } question{};
  question.head.nlmsg_len = sizeof question;
  question.head.nlmsg_type = SOCK_DIAG_BY_FAMILY;
  question.head.nlmsg_flags = NLM_F_REQUEST | NLM_F_DUMP;
  question.body.sdiag_family = family;
  question.body.sdiag_protocol = IPPROTO_TCP;
  question.body.idiag_states = 1U << TCP_LISTEN;
  question.body.id.idiag_sport = htons(static_cast<std::uint16_t>(port));
  const int socket_of_system = socket(AF_NETLINK, SOCK_RAW | SOCK_CLOEXEC, NETLINK_SOCK_DIAG);
  Answer answer = Answer::none;
  ssize_t received = send(socket_of_system, &question, sizeof question, 0);
  alignas(nlmsghdr) char part[16384];
  for (bool is_complete = false; !is_complete && received > 0;) {
    received = recv(socket_of_system, part, sizeof part, MSG_DONTWAIT);
    auto left = static_cast<unsigned>(std::max<ssize_t>(received, 0));
    for (auto* head = reinterpret_cast<nlmsghdr*>(part); NLMSG_OK(head, left); head = NLMSG_NEXT(head, left)) {
      is_complete = head->nlmsg_type == NLMSG_DONE || head->nlmsg_type == NLMSG_ERROR;
      if (head->nlmsg_type == NLMSG_DONE && answer == Answer::none) answer = Answer::no;
      if (is_complete) break;
      const auto* const found = static_cast<const inet_diag_msg*>(NLMSG_DATA(head));
      if (found->id.idiag_sport == question.body.id.idiag_sport) answer = Answer::yes;
    }
  }
  if (socket_of_system >= 0) close(socket_of_system);
  return answer;
}

// For systems that do not answer: the table tells all sockets, after some milliseconds on large machines.
bool is_in_table(int port, const char* table) {
  constexpr unsigned listening = TCP_LISTEN;
  std::FILE* const file = std::fopen(table, "r");
  if (file == nullptr) return false;
  char line[512];
  bool is_found = false;
  while (!is_found && std::fgets(line, sizeof line, file) != nullptr) {
    unsigned local = 0, state = 0;
    if (std::sscanf(line, " %*d: %*[0-9A-Fa-f]:%x %*[0-9A-Fa-f]:%*x %x", &local, &state) == 2)
      is_found = state == listening && local == static_cast<unsigned>(port);
  }
  std::fclose(file);
  return is_found;
}

bool is_listening_at(int port, std::uint8_t family, const char* table) {
  const Answer answer = ask_system(port, family);
  return answer == Answer::none ? is_in_table(port, table) : answer == Answer::yes;
}

}  // namespace

bool parse(const std::string& text, StartCondition& condition) {
  if (text.empty()) return false;
  if (text.starts_with(of_port)) {
    condition.kind = StartCondition::Kind::port;
    return parse_number(std::string_view(text).substr(of_port.size()), condition.port) && condition.port > 0 &&
           condition.port < 65536;
  }
  condition.of = text;
  if (text.find('/') != std::string::npos) {
    condition.kind = StartCondition::Kind::file;
  } else if (text.ends_with(of_start)) {
    condition.kind = StartCondition::Kind::start;
    condition.of.resize(text.size() - of_start.size());
  }
  return !condition.of.empty();
}

std::string in_words(const StartCondition& condition) {
  if (condition.kind == StartCondition::Kind::port) return std::string(of_port) + std::to_string(condition.port);
  return condition.kind == StartCondition::Kind::start ? condition.of + std::string(of_start) : condition.of;
}

void check_conditions(std::span<const ConditionedStart> programs,
                      const std::function<void(std::size_t program, const StartCondition* unknown)>& refuse) {
  const auto index_of = [&](const std::string& name) {
    const auto found = std::ranges::find(programs, std::string_view(name), &ConditionedStart::name);
    return static_cast<std::size_t>(found - programs.begin());
  };
  for (std::size_t i = 0; i < programs.size(); ++i)
    for (const StartCondition& condition : programs[i].after)
      if (condition.is_of_program() && index_of(condition.of) == programs.size()) return refuse(i, &condition);
  std::vector<bool> can_start(programs.size());
  const auto holds = [&](const StartCondition& condition) {
    return !condition.is_of_program() || can_start[index_of(condition.of)];
  };
  for (bool any = true; any;) {
    any = false;
    for (std::size_t i = 0; i < programs.size(); ++i) {
      if (can_start[i] || !std::ranges::all_of(programs[i].after, holds)) continue;
      can_start[i] = any = true;
    }
  }
  const auto never = std::ranges::find(can_start, false);
  if (never != can_start.end()) refuse(static_cast<std::size_t>(never - can_start.begin()), nullptr);
}

bool holds_outside(const StartCondition& condition) {
  if (condition.kind == StartCondition::Kind::file) return access(condition.of.c_str(), F_OK) == 0;
  return is_listening_at(condition.port, AF_INET, "/proc/net/tcp") ||
         is_listening_at(condition.port, AF_INET6, "/proc/net/tcp6");
}

}  // namespace waitpoint
