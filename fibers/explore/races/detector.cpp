// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/explore/races/detector.hpp"

#include <algorithm>
#include <cstring>

#include "fibers/kernel/access.hpp"
#include "fibers/kernel/interruption.hpp"
#include "fibers/kernel/run.hpp"
#include "fibers/kernel/task.hpp"

namespace waitpoint::races {

constinit Detector detector;

namespace {

bool is_unwound(const kernel::Task* task) { return task != nullptr && kernel::is_unwinding(*task->scheduler); }

}  // namespace

// --- accesses ---

// The first access to a word in this run.
void Detector::touch(std::uint64_t word, Seen seen) {
  Cell& cell = shadow_.new_cell(word);
  if (!is_other_switch_point(seen)) return begin_cell(cell, seen);
  const std::uint32_t index = shadow_.index_of(cell);
  pass_switch_point(seen, cell);
  if (watching_) record(shadow_.cell_again(index, word), seen);
}

// record() for an empty cell.
inline void Detector::begin_cell(Cell& cell, const Seen& seen) {
  current_->accessed = current_->epoch();
  cell.touched = cell.is_private = true;
  cell.owner = current_->index;
  cell.written = seen.writes() && seen.is_atomic();
  cell.latest = describe(seen);
}

void Detector::access_shared(Cell& known, Seen seen) {
  Cell* cell = &known;
  if (is_shared_switch_point(known, seen.writes()) || is_other_switch_point(seen)) {
    const std::uint32_t index = shadow_.index_of(known);
    const std::uint64_t word = known.word;
    pass_switch_point(seen, known);
    if (!watching_) return;
    cell = &shadow_.cell_again(index, word);
  }
  record(*cell, seen);
}

// No other task has accessed it: no race is possible.
void Detector::record_own(Cell& cell, Seen seen) {
  current_->accessed = current_->epoch();
  const unsigned kept = !footprint::covers(seen.footprint, cell.latest.footprint);
  if (__builtin_expect((kept | cell.more_count) != 0, 0)) keep_own(cell, seen.footprint, kept);
  cell.latest = describe(seen);
}

void Detector::access_range(std::uint64_t address, std::size_t size, std::uint8_t kind, const void* place,
                            kernel::Operation operation) {
  if (size == 0) return;
  const std::uint64_t end = address + size;
  Seen seen{.place = reinterpret_cast<std::uint64_t>(place),
            .footprint = footprint::of(0, kind),
            .size = static_cast<std::uint8_t>(std::min<std::size_t>(size, 63)),
            .operation = operation};
  // One switch point for the whole range.
  for (std::uint64_t word = address / 8; word * 8 < end; ++word) {
    Cell* const cell = shadow_.find(word);
    if ((cell == nullptr || !is_shared_switch_point(*cell, seen.writes())) && !is_other_switch_point(seen)) continue;
    const std::uint64_t low = std::max(address, word * 8);
    seen.footprint = footprint_of(low, std::min(end, word * 8 + 8) - low, kind);
    pass_switch_point(seen, cell != nullptr ? *cell : shadow_.new_cell(word));
    if (!watching_) return;
    break;
  }
  for (std::uint64_t word = address / 8; word * 8 < end; ++word) {
    const std::uint64_t low = std::max(address, word * 8);
    const std::uint64_t high = std::min(end, word * 8 + 8);
    seen.footprint = footprint_of(low, high - low, kind);
    if (Cell* const cell = shadow_.find(word); cell != nullptr)
      record(*cell, seen);
    else
      begin_cell(shadow_.new_cell(word), seen);
  }
}

inline bool Detector::is_shared_switch_point(const Cell& cell, bool writes) const {
  return cell.touched && (cell.several || cell.owner != current_->index) && (writes || cell.written);
}

inline bool Detector::is_other_switch_point(const Seen& seen) {
  weight_ += seen.is_atomic() ? atomic_weight : 1;
  return weight_ >= weight_max || is_learned(seen.place);
}

void Detector::pass_switch_point(const Seen& seen, Cell& cell) {
  const bool computed_long = weight_ >= weight_max;
  weight_ = 0;
  if (computed_long) return kernel::yield_after_computing();
  kernel::MemoryWord& memory = shadow_.object(cell);
  const std::uint32_t bytes = seen.footprint & footprint::bytes;
  memory.starts |= static_cast<std::uint8_t>(bytes & ~(bytes - 1));
  kernel::access(seen.operation, &memory);
}

// A task that spins on memory while it is unwound would never end: the kernel abandons it.
void Detector::unwatched(std::uint32_t weight) {
  if (!is_unwound(kernel::running) || (weight_ += weight) < weight_max) return;
  weight_ = 0;
  kernel::yield_after_computing();
}

[[gnu::always_inline]] inline void Detector::record(Cell& cell, const Seen& seen) {
  Context& self = *current_;
  const Epoch epoch = self.epoch();
  const MemoryAccess& latest = cell.latest;
  if (__builtin_expect(cell.locations != no_location, 0) && seen.writes() && !seen.is_atomic())
    weak_.overwrite(cell, seen.footprint & footprint::bytes);
  if (latest.task == self.index && latest.epoch == epoch && footprint::covers(latest.footprint, seen.footprint)) return;
  self.accessed = epoch;
  if (__builtin_expect(!cell.touched, 0)) {
    cell.touched = cell.is_private = true;
    cell.owner = self.index;
  }
  cell.several |= cell.owner != self.index;
  cell.is_private &= !cell.several;
  cell.written |= seen.writes() && (cell.several || seen.is_atomic());

  // The earlier accesses that this one does not cover, one bit each.
  const auto is_kept = [&](const MemoryAccess& earlier) -> unsigned {
    const bool is_ordered = earlier.task == self.index || earlier.epoch <= self.clock.of(earlier.task);
    if (!is_ordered) {
      if (!footprint::conflict(seen.footprint, earlier.footprint)) return 1;
      report(cell, earlier, describe(seen));
    }
    return !footprint::covers(seen.footprint, earlier.footprint);
  };
  unsigned kept = is_kept(latest);
  if (cell.more_count != 0) {
    const MemoryAccess* const more = shadow_.more(cell);
    for (unsigned i = 0; i < cell.more_count; ++i) kept |= is_kept(more[i]) << (i + 1);
  }
  if (__builtin_expect(learning_ || noting_, 0) && cell.several && cell.written) learn_from(cell, seen.place);
  if (kept == 0) {
    cell.more_count = 0;
  } else if (cell.more_count == 0) {
    *shadow_.more(cell) = latest;
    cell.more_count = 1;
  } else {
    keep(cell, kept);
  }
  cell.latest = describe(seen);
}

// Shifts the kept accesses back, the latest first; the earliest is dropped if there is no room.
void Detector::keep(Cell& cell, unsigned kept) {
  const unsigned count = cell.more_count;
  cell.more_count = 0;
  if (kept == 0) return;
  MemoryAccess* const more = shadow_.more(cell);
  MemoryAccess moved = cell.latest;
  bool is_moving = (kept & 1) != 0;
  for (unsigned i = 0; i < count; ++i) {
    const bool stays = (kept >> (i + 1) & 1) != 0;
    const MemoryAccess here = more[i];
    if (is_moving) more[cell.more_count++] = moved;
    moved = here;
    is_moving = stays;
  }
  if (is_moving && cell.more_count < more_max) more[cell.more_count++] = moved;
}

// The same if all are of one task; the latest has been classified already.
void Detector::keep_own(Cell& cell, Footprint footprint, unsigned kept) {
  if (cell.more_count != 0) {
    const MemoryAccess* const more = shadow_.more(cell);
    unsigned none_covered = 0;
    for (unsigned i = 0; i < cell.more_count; ++i) {
      const unsigned bit = 2u << i;
      none_covered |= bit;
      if (!footprint::covers(footprint, more[i].footprint)) kept |= bit;
    }
    if (kept == none_covered) return;  // the new one replaces the latest
  }
  keep(cell, kept);
}

// Learns all remembered code places that access the shared word.
void Detector::learn_from(Cell& cell, std::uint64_t place) {
  learn_place(place);
  learn_place(cell.latest.place);
  if (cell.more_count == 0) return;
  const MemoryAccess* const more = shadow_.more(cell);
  for (unsigned i = 0; i < cell.more_count; ++i) learn_place(more[i].place);
}

void Detector::learn_place(std::uint64_t place) {
  if (is_learned(place)) return;
  if (!learning_) {
    if (listener_ != nullptr && !unlearned_) listener_->unlearned();
    unlearned_ = true;
    return;
  }
  if (listener_ != nullptr) listener_->learned(place);
  know(place);
}

void Detector::know(std::uint64_t place) {
  learned_[place] = true;
  learned_bits_[bit_of(place) / 64] |= std::uint64_t{1} << bit_of(place) % 64;
}

void Detector::forget_learned() {
  learned_.clear();
  std::fill(std::begin(learned_bits_), std::end(learned_bits_), 0);
}

void Detector::ignore(bool begin) {
  if (current_ == nullptr) return;
  begin ? ++current_->ignoring : --current_->ignoring;
  update_watching();
}

// --- reports ---

void Detector::describe(Side& side, const MemoryAccess& access) {
  side.access = access;
  side.calls[0] = reinterpret_cast<void*>(access.place);
  side.call_count = 1 + paths_.write(access.calls, side.calls + 1, calls_shown - 1);
  for (std::uint32_t i = tasks_.size(); i > 0; --i) {
    const TaskRecord& task = tasks_[i - 1];
    if (task.index != access.task || task.first > access.epoch) continue;
    std::memcpy(side.task, task.name, sizeof side.task);
    side.record = i - 1;
    return;
  }
}

void Detector::report(Cell& cell, const MemoryAccess& first, const MemoryAccess& second) {
  cell.written = true;
  if (race_count_ == races_kept) return;
  for (std::size_t i = 0; i < race_count_; ++i) {
    const std::uint64_t a = races_[i].first.access.place, b = races_[i].second.access.place;
    if ((a == first.place && b == second.place) || (a == second.place && b == first.place)) return;
  }
  FoundRace& race = races_[race_count_++];
  std::memset(&race, 0, sizeof race);
  describe(race.first, first);
  describe(race.second, second);
  race.address = cell.word * 8 + static_cast<std::uint64_t>(__builtin_ctz(first.bytes() & second.bytes()));
  const char* address = reinterpret_cast<const char*>(race.address);
  for (const kernel::Task* task = kernel::first_task(*kernel::running->scheduler); task != nullptr; task = task->next)
    if (address >= task->fiber.stack.low && address < task->fiber.stack.high)
      std::memcpy(race.stack_of, task->name, sizeof race.stack_of);
  if (listener_ != nullptr) listener_->found(race);
}

std::size_t Detector::found(const FoundRace*& races) const {
  races = races_;
  return race_count_;
}

}  // namespace waitpoint::races
