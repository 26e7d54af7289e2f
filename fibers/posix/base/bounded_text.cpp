// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/base/bounded_text.hpp"

#include <unistd.h>

#include <cstdarg>
#include <cstdio>

#include "core/error.hpp"
#include "fibers/posix/base/interposed.hpp"

namespace waitpoint::posix {

BoundedText::BoundedText(char* room, std::size_t size) : room_(room), size_(size) {
  WAITPOINT_CHECK(room != nullptr && size > 0, "a text has no room");
  room_[0] = '\0';
}

void BoundedText::add(const char* format, ...) {
  va_list values;
  va_start(values, format);
  const int added = std::vsnprintf(room_ + length_, size_ - length_, format, values);
  va_end(values);
  if (added < 0) return;
  length_ += static_cast<std::size_t>(added);
  if (length_ >= size_) length_ = size_ - 1;
  WAITPOINT_CHECK(room_[length_] == '\0', "a text is not ended");
}

void BoundedText::write() const {
  for (std::size_t at = 0; at < length_;) {
    const ssize_t count = WAITPOINT_NEXT(write)(STDERR_FILENO, room_ + at, length_ - at);
    if (count <= 0) return;
    at += static_cast<std::size_t>(count);
  }
}

}  // namespace waitpoint::posix
