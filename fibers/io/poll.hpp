// SPDX-License-Identifier: BSD-3-Clause
// Waiting for the first of several channels: poll() and select(), with the semantics of POSIX.
//
//   io::PollEntry entries[] = {{reader, io::Events::readable}, {orders, io::Events::readable}};
//   if (io::poll(entries, 20ms)) ...entries[0].ready...
//
// Level-triggered: an event is reported by every poll until it is consumed. Several tasks may poll a channel and are
// all woken; a later one may find the event consumed. Closing a channel while it is polled is reported as
// Events::closed.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "fibers/io/channel.hpp"

namespace waitpoint::io {

/// Anything that can be polled: a handle that shares its channel, or a channel itself, which must outlive the poll.
class Source {
 public:
  template <class Handle>
  requires requires(const Handle& handle) { handle.channel(); }
  Source(const Handle& handle) : channel_(handle.channel()) {}
  Source(Channel& channel) : channel_(std::shared_ptr<void>(), &channel) {}

  Channel& channel() const { return *channel_; }
  friend bool operator==(const Source& a, const Source& b) { return a.channel_.get() == b.channel_.get(); }

 private:
  std::shared_ptr<Channel> channel_;
};

struct PollEntry {
  Source source;
  Events wanted = Events::readable;
  Events ready = Events::none;  ///< set by poll(): the ready ones of those wanted, and closed
};

/// Waits until an entry is ready; returns the number of ready ones. would_block or timed_out if there is none in time.
Result<std::size_t> poll(std::span<PollEntry> entries, const Deadline& deadline = {});

/// As poll(); removes from both lists the sources that are not ready, keeping the order. Empty lists if none is in
/// time.
Result<std::size_t> select(std::vector<Source>& readable, std::vector<Source>& writable, const Deadline& deadline = {});

}  // namespace waitpoint::io
