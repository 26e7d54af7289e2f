// SPDX-License-Identifier: BSD-3-Clause
// A FIFO of bytes in a ring of bounded size, allocated at the first use.
//
//   |  room  | oldest ... newest |  room  |
//            ^ first_
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "core/error.hpp"

namespace waitpoint::io {

class ByteQueue {
 public:
  explicit ByteQueue(std::size_t capacity) : capacity_(capacity) {}

  std::size_t capacity() const { return capacity_; }
  std::size_t size() const { return size_; }
  std::size_t room() const { return capacity_ - size_; }
  bool empty() const { return size_ == 0; }
  void clear() { size_ = 0; }

  /// More than room() is a bug.
  void push(std::span<const std::byte> data) {
    WAITPOINT_CHECK(data.size() <= room(), "more bytes than a queue has room for");
    if (ring_.empty()) ring_.resize(capacity_);
    const std::size_t end = (first_ + size_) % capacity_;
    const std::size_t straight = std::min(data.size(), capacity_ - end);
    std::copy_n(data.data(), straight, ring_.data() + end);
    std::copy_n(data.data() + straight, data.size() - straight, ring_.data());
    size_ += data.size();
  }

  /// Moves bytes to `buffer`, as many as are queued and fit; returns their number.
  std::size_t pop(std::span<std::byte> buffer) {
    const std::size_t count = std::min(buffer.size(), size_);
    const std::size_t straight = std::min(count, capacity_ - first_);
    std::copy_n(ring_.data() + first_, straight, buffer.data());
    std::copy_n(ring_.data(), count - straight, buffer.data() + straight);
    first_ = (first_ + count) % capacity_;
    size_ -= count;
    return count;
  }

 private:
  std::size_t capacity_;
  std::size_t first_ = 0;
  std::size_t size_ = 0;
  std::vector<std::byte> ring_;
};

}  // namespace waitpoint::io
