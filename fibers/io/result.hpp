// SPDX-License-Identifier: BSD-3-Clause
// The result of a communication, as a value: all outcomes that a correct program must expect. Misuse (a handle used
// after its close, a second name for one socket, an object of another robot) is reported as a misuse instead.
#pragma once

#include <cstdint>
#include <utility>

#include "core/error.hpp"

namespace waitpoint::io {

enum class Status : std::uint8_t {
  ok,
  end_of_file,       ///< all sent data has been read, and no sender is left
  would_block,       ///< with no_wait
  timed_out,         ///< with a finite timeout
  peer_closed,       ///< no reader is left (POSIX: EPIPE)
  closed,            ///< the object was closed while the caller waited
  refused,           ///< no listener at that address, or its backlog is full
  no_route,          ///< no such robot, or no link to it
  address_in_use,    ///< the name is in use on this robot
  message_too_long,  ///< for the datagrams of this socket
};

/// The status in words: "timed out".
constexpr const char* to_string(Status status) {
  constexpr const char* names[] = {"ok",     "end of file", "would block", "timed out",      "peer closed",
                                   "closed", "refused",     "no route",    "address in use", "message too long"};
  return names[static_cast<int>(status)];
}

/// A status, and its value. The value is valid for every status: after a timeout, a write's is the number of bytes
/// written.
template <class T>
class [[nodiscard]] Result {
 public:
  Result(T value) : value_(std::move(value)) {}
  Result(Status status, T value = T()) : status_(status), value_(std::move(value)) {}

  Status status() const { return status_; }
  explicit operator bool() const { return status_ == Status::ok; }
  const T& value() const { return value_; }
  T& operator*() {
    WAITPOINT_REQUIRE(status_ == Status::ok, "the value of a communication that failed is used");
    return value_;
  }
  T* operator->() { return &**this; }

 private:
  Status status_ = Status::ok;
  T value_;
};

}  // namespace waitpoint::io
