// SPDX-License-Identifier: BSD-3-Clause
// What came of a communication, as a value: everything that a correct program must expect. Misuse (a handle used after
// its close, a name bound twice by one socket, an object of another robot) is a bug with a name instead.
#pragma once

#include <cstdint>
#include <utility>

#include "core/error.hpp"

namespace waitpoint::io {

enum class Status : std::uint8_t {
  ok,
  end_of_file,       ///< all that was sent has been read, and nobody can send any more
  would_block,       ///< with no_wait
  timed_out,         ///< with a finite timeout
  peer_closed,       ///< nobody reads what is sent (POSIX: EPIPE)
  closed,            ///< the object was closed while the caller waited
  refused,           ///< nobody listens at that address, or too many wait there
  no_route,          ///< there is no such robot, or no link to it
  address_in_use,    ///< another one of this robot has the name
  message_too_long,  ///< for the datagrams of this socket
};

/// The status in words: "timed out".
constexpr const char* to_string(Status status) {
  constexpr const char* names[] = {"ok",     "end of file", "would block", "timed out",      "peer closed",
                                   "closed", "refused",     "no route",    "address in use", "message too long"};
  return names[static_cast<int>(status)];
}

/// A status, and the value that comes with it. The value may be looked at whatever the status is: a write that timed
/// out says how much it had written.
template <class T>
class [[nodiscard]] Result {
 public:
  Result(T value) : value_(std::move(value)) {}
  Result(Status status, T value = T()) : status_(status), value_(std::move(value)) {}

  Status status() const { return status_; }
  explicit operator bool() const { return status_ == Status::ok; }
  const T& value() const { return value_; }
  T& operator*() {
    WAITPOINT_CHECK(status_ == Status::ok, "the value of a communication that failed is used");
    return value_;
  }
  T* operator->() { return &**this; }

 private:
  Status status_ = Status::ok;
  T value_;
};

}  // namespace waitpoint::io
