// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/kernel/signal_safe_text.hpp"

#include <unistd.h>

#include <cerrno>

namespace waitpoint::kernel {

SignalSafeText& SignalSafeText::add(std::string_view text) {
  for (const char c : text) {
    if (size_ == sizeof text_) write();
    text_[size_++] = c;
  }
  return *this;
}

void SignalSafeText::add_digits(std::uint64_t number, std::size_t least) {
  char digits[20];
  std::size_t count = 0;
  do {
    digits[count++] = static_cast<char>('0' + number % 10);
    number /= 10;
  } while (number != 0 || count < least);
  while (count > 0) add({&digits[--count], 1});
}

SignalSafeText& SignalSafeText::add(std::uint64_t number) {
  add_digits(number, 1);
  return *this;
}

SignalSafeText& SignalSafeText::add(Time time) {
  const auto ns = static_cast<std::uint64_t>(time.ns());
  add_digits(ns / 1'000'000'000, 1);
  add(".");
  add_digits(ns % 1'000'000'000, 9);
  return *this;
}

void SignalSafeText::write() {
  const int error = errno;
  for (std::size_t done = 0; done < size_;) {
    const ssize_t written = ::write(STDERR_FILENO, text_ + done, size_ - done);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) break;  // an error here cannot be reported
    done += static_cast<std::size_t>(written);
  }
  size_ = 0;
  errno = error;
}

}  // namespace waitpoint::kernel
