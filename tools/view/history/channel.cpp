// SPDX-License-Identifier: BSD-3-Clause
#include "tools/view/history/channel.hpp"

#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <system_error>

namespace waitpoint::tools::view {
namespace {

/// Before each message. A descriptor comes with the first byte of its head.
struct Head {
  std::uint64_t size = 0;
  std::uint64_t descriptors = 0;  // 0 or 1
};

constexpr std::size_t bytes_at_once = 1 << 16;

std::string framed(std::string_view text, bool has_descriptor) {
  const Head head{text.size(), has_descriptor ? 1u : 0u};
  std::string bytes(sizeof head, '\0');
  std::memcpy(bytes.data(), &head, sizeof head);
  return bytes.append(text);
}

ssize_t send_part(int socket, std::string_view bytes, int descriptor, int flags) {
  iovec part{const_cast<char*>(bytes.data()), bytes.size()};
  msghdr message{};
  message.msg_iov = &part;
  message.msg_iovlen = 1;
  alignas(cmsghdr) std::array<char, CMSG_SPACE(sizeof(int))> control{};
  if (descriptor >= 0) {
    message.msg_control = control.data();
    message.msg_controllen = control.size();
    cmsghdr* const head = CMSG_FIRSTHDR(&message);
    head->cmsg_level = SOL_SOCKET;
    head->cmsg_type = SCM_RIGHTS;
    head->cmsg_len = CMSG_LEN(sizeof(int));
    std::memcpy(CMSG_DATA(head), &descriptor, sizeof descriptor);
  }
  ssize_t sent = 0;
  do {
    sent = sendmsg(socket, &message, flags | MSG_NOSIGNAL);
  } while (sent < 0 && errno == EINTR);
  return sent;
}

}  // namespace

Descriptor& Descriptor::operator=(Descriptor&& other) noexcept {
  if (this == &other) return *this;
  if (number_ >= 0) close(number_);
  number_ = other.release();
  return *this;
}

Descriptor::~Descriptor() {
  if (number_ >= 0) close(number_);
}

std::pair<Channel, Channel> Channel::make() {
  int ends[2];
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0)
    throw std::system_error(errno, std::generic_category(), "a connection between processes");
  return {Channel(Descriptor(ends[0])), Channel(Descriptor(ends[1]))};
}

bool Channel::send(std::string_view text, int descriptor) {
  const std::string bytes = framed(text, descriptor >= 0);
  std::size_t sent = 0;
  while (is_open_ && sent < bytes.size()) {
    const ssize_t part = send_part(number(), std::string_view(bytes).substr(sent), sent == 0 ? descriptor : -1, 0);
    if (part < 0) is_open_ = false;
    if (part > 0) sent += static_cast<std::size_t>(part);
  }
  return is_open_;
}

void Channel::queue(std::string_view text) {
  outgoing_.push_back(framed(text, false));
  queued_ += outgoing_.back().size();
  flush();
}

bool Channel::flush() {
  while (is_open_ && !outgoing_.empty()) {
    const std::string_view rest = std::string_view(outgoing_.front()).substr(sent_of_first_);
    const ssize_t part = send_part(number(), rest, -1, MSG_DONTWAIT);
    if (part < 0) {
      if (errno == EAGAIN || errno == EWOULDBLOCK) return false;
      is_open_ = false;
      break;
    }
    sent_of_first_ += static_cast<std::size_t>(part);
    queued_ -= static_cast<std::size_t>(part);
    if (sent_of_first_ < outgoing_.front().size()) continue;
    outgoing_.pop_front();
    sent_of_first_ = 0;
  }
  return true;
}

std::optional<Channel::Message> Channel::next() {
  Head head;
  if (received_.size() < sizeof head) return std::nullopt;
  std::memcpy(&head, received_.data(), sizeof head);
  if (received_.size() - sizeof head < head.size) return std::nullopt;
  Message message{received_.substr(sizeof head, head.size), Descriptor()};
  received_.erase(0, sizeof head + head.size);
  if (head.descriptors > 0 && !descriptors_.empty()) {
    message.descriptor = std::move(descriptors_.front());
    descriptors_.pop_front();
  }
  return message;
}

// False if there is nothing to read, or the other end is gone.
bool Channel::read_more(bool waits) {
  std::array<char, bytes_at_once> bytes;
  iovec part{bytes.data(), bytes.size()};
  msghdr message{};
  message.msg_iov = &part;
  message.msg_iovlen = 1;
  alignas(cmsghdr) std::array<char, CMSG_SPACE(4 * sizeof(int))> control{};
  message.msg_control = control.data();
  message.msg_controllen = control.size();
  ssize_t size = 0;
  do {
    size = recvmsg(number(), &message, MSG_CMSG_CLOEXEC | (waits ? 0 : MSG_DONTWAIT));
  } while (size < 0 && errno == EINTR);
  if (size < 0 && (errno == EAGAIN || errno == EWOULDBLOCK)) return false;
  if (size <= 0) {
    is_open_ = false;
    return false;
  }
  for (cmsghdr* head = CMSG_FIRSTHDR(&message); head != nullptr; head = CMSG_NXTHDR(&message, head)) {
    if (head->cmsg_level != SOL_SOCKET || head->cmsg_type != SCM_RIGHTS) continue;
    const std::size_t count = (head->cmsg_len - CMSG_LEN(0)) / sizeof(int);
    for (std::size_t i = 0; i < count; ++i) {
      int descriptor = -1;
      std::memcpy(&descriptor, CMSG_DATA(head) + i * sizeof(int), sizeof descriptor);
      descriptors_.emplace_back(descriptor);
    }
  }
  received_.append(bytes.data(), static_cast<std::size_t>(size));
  return true;
}

std::optional<Channel::Message> Channel::receive() {
  for (;;) {
    if (auto message = next()) return message;
    if (!is_open_ || !read_more(true)) return std::nullopt;
  }
}

std::optional<Channel::Message> Channel::poll() {
  for (;;) {
    if (auto message = next()) return message;
    if (!is_open_ || !read_more(false)) return std::nullopt;
  }
}

bool Channel::is_wanted() const {
  pollfd end{number(), POLLRDHUP, 0};
  return ::poll(&end, 1, 0) == 0 || (end.revents & (POLLRDHUP | POLLHUP | POLLERR)) == 0;
}

bool Channel::has_news(int timeout_ms) const {
  pollfd news{number(), POLLIN, 0};
  return ::poll(&news, 1, timeout_ms) > 0;
}

}  // namespace waitpoint::tools::view
