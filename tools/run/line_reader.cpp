// SPDX-License-Identifier: BSD-3-Clause
#include "tools/run/line_reader.hpp"

#include <poll.h>
#include <unistd.h>

#include "tools/command/interruption.hpp"

namespace waitpoint::tools {
namespace {

// Interval at which a wait polls for signals: one that arrives just before poll() would otherwise wait for the next
// line.
constexpr int patience_ms = 200;

}  // namespace

bool LineReader::take(std::string& line) {
  const std::size_t end = buffer_.find('\n');
  if (end == std::string::npos && !(ended_ && !buffer_.empty())) return false;
  line = buffer_.substr(0, end);
  buffer_.erase(0, end == std::string::npos ? end : end + 1);
  return true;
}

LineReader::Result LineReader::read(std::string& line, int timeout_ms) {
  for (;;) {
    if (take(line)) return Result::line;
    if (ended_) return Result::end;
    pollfd input{descriptor_, POLLIN, 0};
    if (::poll(&input, 1, timeout_ms) <= 0) return Result::nothing;
    char part[4096];
    const ssize_t got = ::read(descriptor_, part, sizeof part);
    if (got > 0) buffer_.append(part, static_cast<std::size_t>(got));
    ended_ = got == 0;
    if (got < 0) return Result::nothing;
  }
}

LineReader::Result LineReader::poll(std::string& line) { return read(line, 0); }

LineReader::Result LineReader::wait(std::string& line) {
  for (;;) {
    if (interruption() != 0) return Result::interrupted;
    if (const Result result = read(line, patience_ms); result != Result::nothing) return result;
  }
}

}  // namespace waitpoint::tools
