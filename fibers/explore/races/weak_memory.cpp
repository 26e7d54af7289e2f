// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/explore/races/weak_memory.hpp"

#include <algorithm>

#include "fibers/explore/races/memory_order.hpp"

namespace waitpoint::races {
namespace {

std::uint32_t bytes_of(const Location& location) { return ((1U << location.size) - 1) << (location.address % 8); }

// True if one of the accesses that `seen` gives by tasks happens before what has this clock.
bool knows(const VectorClock& clock, const VectorClock& seen) {
  const std::uint32_t size = std::min(clock.size, seen.size);
  for (std::uint32_t i = 0; i < size; ++i)
    if (seen.epochs[i] != 0 && seen.epochs[i] <= clock.epochs[i]) return true;
  return false;
}

}  // namespace

void WeakMemory::begin_run() {
  clocks_.reset();
  locations_.reset();
  fences_.reset();
  fenced_ = VectorClock();
  barriers_ = 0;
}

// --- locations ---

Location& WeakMemory::location(Cell& cell, std::uint64_t address, std::uint32_t size, std::uint64_t value,
                               const VectorClock* synchronised) {
  VectorClock known;  // of locations that overlap
  for (std::uint32_t* at = &cell.locations; *at != no_location;) {
    Location& found = locations_[*at];
    if (found.address == address && found.size == size) {
      if (found.is_overwritten || found.newest().value != value) restart(found, value, synchronised);
      return found;
    }
    const bool overlaps = found.address < address + size && address < found.address + found.size;
    if (overlaps) join(known, found.newest().released, clocks_);
    if (overlaps)
      *at = found.next;
    else
      at = &found.next;
  }
  const std::uint32_t made = locations_.add();
  Location& fresh = locations_[made];
  fresh = Location{address, size, cell.locations, 0, false, {}, {}, {}};
  cell.locations = made;
  cell.is_private = false;
  restart(fresh, value, synchronised);
  join(fresh.newest().released, known, clocks_);
  return fresh;
}

Location* WeakMemory::find(const Cell& cell, std::uint64_t address, std::uint32_t size) {
  for (std::uint32_t at = cell.locations; at != no_location; at = locations_[at].next)
    if (locations_[at].address == address && locations_[at].size == size) return &locations_[at];
  return nullptr;
}

// The value in memory becomes the only one. Who reads it knows, beside what has been released, what he would have known
// by the last store: code that is not instrumented may have modified that.
void WeakMemory::restart(Location& location, std::uint64_t value, const VectorClock* synchronised) {
  VectorClock known;
  if (location.made != 0) join(known, location.newest().released, clocks_);
  for (Store& store : location.stores) store.released.size = store.seen.size = 0;
  location.made = 1;
  location.is_overwritten = false;
  location.last.size = location.times.size = 0;
  Store& only = location.stores[0];
  only.value = value;
  only.strong = only.record = 0;
  only.barriers = barriers_;
  only.place = 0;
  join(only.released, known, clocks_);
  if (synchronised != nullptr) join(only.released, *synchronised, clocks_);
}

void WeakMemory::overwrite(const Cell& cell, std::uint32_t bytes) {
  for (std::uint32_t at = cell.locations; at != no_location; at = locations_[at].next)
    locations_[at].is_overwritten |= (bytes_of(locations_[at]) & bytes) != 0;
}

// --- operations ---

const WeakMemory::Fence* WeakMemory::last_fence_before(const VectorClock& clock, std::uint32_t& number) {
  for (number = fences_.size(); number-- > 0;)
    if (fences_[number].epoch <= clock.of(fences_[number].index)) return &fences_[number];
  return nullptr;
}

std::uint32_t WeakMemory::readable(Location& location, const Operator& reader) {
  const std::uint32_t kept = location.kept();
  if (kept == 1) return 1;
  const bool is_strong = is_seq_cst(reader.order);
  std::uint32_t fence_number = 0;
  const Fence* const fence = last_fence_before(reader.clock, fence_number);
  const auto hides_older = [&](const Store& store) {
    if (store.barriers != barriers_ || knows(reader.clock, store.seen)) return true;
    if (is_strong && (store.strong != 0 || knows(fenced_, store.seen))) return true;
    return fence != nullptr &&
           ((store.strong != 0 && store.strong - 1 <= fence_number) || knows(fence->before, store.seen));
  };
  std::uint32_t count = 1;
  while (count < kept && !hides_older(location.newest(count - 1))) ++count;
  left_out_ |= count == kept && location.made > kept && !hides_older(location.newest(count - 1));
  if (count == 1) return 1;
  const bool repeats =
      location.times.of(reader.index) >= repeats_max && location.last.of(reader.index) != location.made;
  left_out_ |= repeats;
  return repeats ? 1 : count;
}

void WeakMemory::note_access(Store& store, const Operator& by) {
  extend(store.seen, by.index + 1, clocks_);
  Epoch& first = store.seen.epochs[by.index];
  if (first == 0) first = by.epoch();
  if (is_seq_cst(by.order) && store.strong == 0) store.strong = fences_.size() + 1;
}

const Store& WeakMemory::read(Location& location, std::uint32_t newer, const Operator& reader) {
  Store& store = location.newest(newer);
  note_access(store, reader);
  extend(location.last, reader.index + 1, clocks_);
  extend(location.times, reader.index + 1, clocks_);
  std::uint32_t& last = location.last.epochs[reader.index];
  std::uint32_t& times = location.times.epochs[reader.index];
  times = last == location.made - newer ? times + 1 : 1;
  last = location.made - newer;
  return store;
}

Store& WeakMemory::store(Location& location, std::uint64_t value, const Operator& writer) {
  ++location.made;
  Store& store = location.newest();
  store.value = value;
  store.released.size = store.seen.size = store.strong = 0;
  store.barriers = barriers_;
  store.record = writer.record;
  store.place = writer.place;
  note_access(store, writer);
  return store;
}

void WeakMemory::fence(const Operator& fencing) {
  const std::uint32_t number = fences_.add();
  Fence& fence = fences_[number];
  fence = Fence{fencing.index, fencing.epoch(), {}};
  assign(fence.before, fenced_, clocks_);
  join(fenced_, fencing.clock, clocks_);
}

}  // namespace waitpoint::races
