// SPDX-License-Identifier: BSD-3-Clause
// Waiting for the first of several channels: poll() and select(), to the semantics of POSIX.
//
//   io::PollEntry entries[] = {{reader, io::Events::readable}, {orders, io::Events::readable}};
//   if (io::poll(entries, 20ms)) ...entries[0].ready...
//
// Level-triggered: what is ready is told again by every poll until it is used up. Several tasks may poll a channel and
// are all told; who comes second finds that the first has been there. A channel that is closed while it is polled is
// told as Events::closed.
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
  Events ready = Events::none;  ///< written by poll(): of those wanted, and closed
};

/// Waits until an entry is ready; how many are. would_block or timed_out where none is in time.
Result<std::size_t> poll(std::span<PollEntry> entries, const Deadline& deadline = {});

/// As poll(); leaves in both lists those that are ready, in their order. Empty lists where none is in time.
Result<std::size_t> select(std::vector<Source>& readable, std::vector<Source>& writable, const Deadline& deadline = {});

}  // namespace waitpoint::io
