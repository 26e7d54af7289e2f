// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/io/poll.hpp"

#include <algorithm>

namespace waitpoint::io {
namespace {

// Registered with all polled channels during its lifetime.
class Poller {
 public:
  explicit Poller(std::span<PollEntry> entries) : entries_(entries) {
    for (const PollEntry& entry : entries_) entry.source.channel().add_poller(object);
  }
  ~Poller() {
    for (const PollEntry& entry : entries_) entry.source.channel().remove_poller(object);
  }
  Poller(const Poller&) = delete;
  Poller& operator=(const Poller&) = delete;

  kernel::Object object{"poll"};

 private:
  std::span<PollEntry> entries_;
};

std::size_t look(std::span<PollEntry> entries) {
  std::size_t count = 0;
  for (PollEntry& entry : entries) {
    entry.ready = entry.source.channel().ready() & (entry.wanted | Events::closed);
    count += any(entry.ready) ? 1 : 0;
  }
  return count;
}

}  // namespace

Result<std::size_t> poll(std::span<PollEntry> entries, const Deadline& deadline) {
  for (const PollEntry& entry : entries) entry.source.channel().enter();
  Poller poller(entries);
  if (!sync::before_blocking(kernel::Operation::poll, poller.object)) return Status::closed;
  std::size_t count = look(entries);
  while (count == 0) {
    if (deadline.at() <= sync::running_task().local_time) return deadline.late();
    if (!sync::block(poller.object, deadline.at())) return Status::timed_out;
    count = look(entries);
  }
  return count;
}

Result<std::size_t> select(std::vector<Source>& readable, std::vector<Source>& writable, const Deadline& deadline) {
  std::vector<PollEntry> entries;
  entries.reserve(readable.size() + writable.size());
  for (const Source& source : readable) entries.push_back({source, Events::readable});
  for (const Source& source : writable) entries.push_back({source, Events::writable});
  const Result<std::size_t> result = poll(entries, deadline);
  const std::size_t split = readable.size();
  readable.clear();
  writable.clear();
  for (std::size_t i = 0; i < entries.size(); ++i)
    if (any(entries[i].ready)) (i < split ? readable : writable).push_back(entries[i].source);
  return result;
}

}  // namespace waitpoint::io
