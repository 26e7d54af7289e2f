// SPDX-License-Identifier: BSD-3-Clause
#include "modules/outside/line_stream.hpp"

#include <sys/socket.h>

#include <cerrno>

namespace waitpoint::outside {
namespace {

constexpr std::size_t part_bytes = 4096, received_max = std::size_t{64} << 10, line_max = std::size_t{1} << 20,
                      unsent_max = std::size_t{1} << 20;

}  // namespace

void LineStream::receive() {
  received_.erase(0, begin_);
  begin_ = 0;
  (void)flush();
  for (std::size_t count = 0; count < received_max && !is_over_; count += part_bytes) {
    char part[part_bytes];
    const ssize_t got = recv(connection_.number(), part, sizeof part, count == 0 ? 0 : MSG_DONTWAIT);
    if (got > 0) received_.append(part, static_cast<std::size_t>(got));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0 && (errno == EAGAIN || errno == EWOULDBLOCK)) return;
    is_over_ = got <= 0;
  }
}

bool LineStream::take(std::string& line) {
  const std::size_t end = received_.find('\n', begin_);
  if (end == std::string::npos) {
    if (received_.size() - begin_ > line_max) is_over_ = true;
    return false;
  }
  line = received_.substr(begin_, end - begin_);
  if (line.ends_with('\r')) line.pop_back();
  begin_ = end + 1;
  ++lines_;
  return true;
}

bool LineStream::send(std::string_view lines) {
  if (sent_.size() + lines.size() > unsent_max) return false;
  sent_ += lines;
  return flush();
}

bool LineStream::flush() {
  while (!sent_.empty()) {
    const ssize_t sent = ::send(connection_.number(), sent_.data(), sent_.size(), MSG_NOSIGNAL);
    if (sent < 0 && errno == EINTR) continue;
    if (sent < 0) {
      const bool is_full = errno == EAGAIN || errno == EWOULDBLOCK;
      return is_full;
    }
    sent_.erase(0, static_cast<std::size_t>(sent));
  }
  return true;
}

}  // namespace waitpoint::outside
