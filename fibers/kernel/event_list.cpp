// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/kernel/event_list.hpp"

#include <sys/mman.h>

#include "core/error.hpp"

namespace waitpoint::kernel {

EventList::EventList(std::uint32_t capacity) : capacity_(capacity) {
  void* memory = mmap(nullptr, capacity * sizeof(Entry), PROT_READ | PROT_WRITE,
                      MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  WAITPOINT_CHECK(memory != MAP_FAILED, "no address space for the event list");
  entries_ = static_cast<Entry*>(memory);
}

EventList::~EventList() { munmap(entries_, capacity_ * sizeof(Entry)); }

void EventList::insert(EventNode& node, EventKey key) {
  WAITPOINT_CHECK(!node.in_list(), "an event is put into the list twice");
  WAITPOINT_CHECK(size_ < capacity_, "more events than the event list holds");
  sift_up(size_++, Entry{key, &node});
}

void EventList::remove(EventNode& node) {
  WAITPOINT_CHECK(node.place < size_ && entries_[node.place].node == &node, "an event to remove is not in the list");
  const std::uint32_t at = node.place;
  node.place = EventNode::absent;
  const Entry last = entries_[--size_];
  if (at == size_) return;
  if (at > 0 && last.key < entries_[(at - 1) / 4].key)
    sift_up(at, last);
  else
    sift_down(at, last);
}

EventNode& EventList::pop() {
  WAITPOINT_CHECK(size_ > 0, "the event list is empty");
  EventNode& node = *entries_[0].node;
  node.place = EventNode::absent;
  const Entry last = entries_[--size_];
  if (size_ > 0) sift_down(0, last);
  return node;
}

EventNode& EventList::pop_and_insert(EventNode& node, EventKey key) {
  WAITPOINT_CHECK(size_ > 0, "the event list is empty");
  WAITPOINT_CHECK(!node.in_list(), "an event is put into the list twice");
  EventNode& least = *entries_[0].node;
  least.place = EventNode::absent;
  sift_down(0, Entry{key, &node});
  return least;
}

void EventList::sift_up(std::uint32_t at, const Entry& entry) {
  while (at > 0) {
    const std::uint32_t parent = (at - 1) / 4;
    if (!(entry.key < entries_[parent].key)) break;
    place(at, entries_[parent]);
    at = parent;
  }
  place(at, entry);
}

void EventList::sift_down(std::uint32_t at, const Entry& entry) {
  for (;;) {
    const std::uint32_t first = 4 * at + 1;
    if (first >= size_) break;
    const std::uint32_t end = first + 4 < size_ ? first + 4 : size_;
    std::uint32_t least = first;
    for (std::uint32_t child = first + 1; child < end; ++child)
      if (entries_[child].key < entries_[least].key) least = child;
    if (!(entries_[least].key < entry.key)) break;
    place(at, entries_[least]);
    at = least;
  }
  place(at, entry);
}

}  // namespace waitpoint::kernel
