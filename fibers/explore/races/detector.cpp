// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/explore/races/detector.hpp"

#include <algorithm>
#include <cstring>

#include "fibers/kernel/access.hpp"
#include "fibers/kernel/scheduler.hpp"

namespace waitpoint::races {

constinit Detector detector;

namespace {

// Who accesses only what nobody else touches passes no switch point. One that waits so for another's write would wait
// for ever: after accesses of so much weight the others get a turn.
constexpr std::uint32_t weight_max = 100'000;

std::uint8_t bytes_of(std::uint64_t address, std::uint64_t size) {
  return static_cast<std::uint8_t>(((1u << size) - 1) << (address % 8));
}

bool is_unwound(const kernel::Task* task) { return task != nullptr && task->scheduler->unwinding(); }

}  // namespace

// --- accesses ---

void Detector::access_word(std::uint64_t address, std::uint32_t size, std::uint8_t kind, const void* place,
                           kernel::Operation operation) {
  const std::uint64_t at = reinterpret_cast<std::uint64_t>(place);
  std::uint32_t index = shadow_.cell_of(address / 8);
  if (is_switch_point(shadow_[index], kind, at)) {
    pass_switch_point(operation, shadow_[index]);
    if (!watching_) return;
    if (shadow_[index].word != address / 8) index = shadow_.cell_of(address / 8);  // others have forgotten it meanwhile
  }
  record(index, bytes_of(address, size), static_cast<std::uint8_t>(size), kind, at);
}

void Detector::access_range(std::uint64_t address, std::size_t size, std::uint8_t kind, const void* place,
                            kernel::Operation operation) {
  if (size == 0) return;
  const std::uint64_t at = reinterpret_cast<std::uint64_t>(place);
  const std::uint64_t end = address + size;
  // One switch point for all of it.
  for (std::uint64_t word = address / 8; word * 8 < end; ++word) {
    const std::uint32_t index = shadow_.cell_of(word);
    if (!is_switch_point(shadow_[index], kind, at)) continue;
    pass_switch_point(operation, shadow_[index]);
    if (!watching_) return;
    break;
  }
  const auto size_kept = static_cast<std::uint8_t>(std::min<std::size_t>(size, 63));
  for (std::uint64_t word = address / 8; word * 8 < end; ++word) {
    const std::uint64_t low = std::max(address, word * 8);
    const std::uint64_t high = std::min(end, word * 8 + 8);
    record(shadow_.cell_of(word), bytes_of(low, high - low), size_kept, kind, at);
  }
}

inline bool Detector::is_switch_point(const Cell& cell, std::uint8_t kind, std::uint64_t place) {
  if (cell.touched && (cell.several || cell.owner != current_->index) && ((kind & kind::write) != 0 || cell.written))
    return true;
  weight_ += (kind & kind::atomic) != 0 ? atomic_weight : 1;
  return weight_ >= weight_max || learned_.find(place) != nullptr;
}

void Detector::pass_switch_point(kernel::Operation operation, Cell& cell) {
  const bool computed_long = weight_ >= weight_max;
  weight_ = 0;
  if (computed_long) return kernel::give_turn();
  kernel::access(operation, &shadow_.object(cell));
}

// A task that is unwound and spins on memory would never end: the kernel gives up who goes on calling it.
void Detector::unwatched(std::uint32_t weight) {
  if (!is_unwound(kernel::running) || (weight_ += weight) < weight_max) return;
  weight_ = 0;
  kernel::give_turn();
}

inline void Detector::record(std::uint32_t index, std::uint8_t bytes, std::uint8_t size, std::uint8_t kind,
                             std::uint64_t place) {
  Context& self = *current_;
  Cell& cell = shadow_[index];
  const Epoch epoch = self.epoch();
  const MemoryAccess& latest = cell.latest;
  if (latest.task == self.index && latest.epoch == epoch &&
      MemoryAccess::covers(latest.bytes, latest.kind, bytes, kind))
    return;
  const std::uint32_t calls = self.calls.path(paths_);
  // Written field by field to where it belongs: a copy of what was just put together waits for all of it.
  const auto note_in = [&](MemoryAccess& access) {
    access.place = place;
    access.epoch = epoch;
    access.calls = calls;
    access.event = static_cast<std::uint32_t>(kernel::running->sequence);
    access.task = self.index;
    access.bytes = bytes;
    access.kind = static_cast<std::uint8_t>(kind & 3);
    access.size = static_cast<std::uint8_t>(size & 63);
  };
  const bool writes = (kind & kind::write) != 0, is_atomic = (kind & kind::atomic) != 0;
  self.accessed = epoch;
  if (!cell.touched) {
    cell.touched = true;
    cell.owner = self.index;
    cell.written = writes && is_atomic;
    note_in(cell.latest);
    return;
  }
  cell.several |= cell.owner != self.index;
  cell.written |= writes && (cell.several || is_atomic);
  const auto is_ordered = [&](const MemoryAccess& earlier) {
    return earlier.task == self.index || earlier.epoch <= self.clock.of(earlier.task);
  };
  // Mostly it comes in the place of the one before.
  if (cell.more == no_more && !learning_ && MemoryAccess::covers(bytes, kind, latest.bytes, latest.kind) &&
      is_ordered(latest))
    return note_in(cell.latest);

  MemoryAccess access;
  note_in(access);
  // What the new access stands for makes room for it; what is left moves back.
  MemoryAccess kept[1 + more_max];
  int count = 0;
  const auto look_at = [&](const MemoryAccess& earlier) {
    if (earlier.bytes == 0) return;
    const bool ordered = is_ordered(earlier);
    const bool races = !ordered && earlier.conflicts_with(access);
    if (races) report(cell, earlier, access);
    cell.written |= races;
    if ((ordered || races) && access.stands_for(earlier)) return;
    kept[count++] = earlier;
  };
  look_at(cell.latest);
  if (cell.more != no_more)
    for (const MemoryAccess& earlier : shadow_.more(cell).access) look_at(earlier);
  if (learning_ && cell.several && cell.written) learn_from(cell, place);
  cell.latest = access;
  if (count == 0 && cell.more == no_more) return;
  MoreAccesses& more = shadow_.more(cell);
  for (int i = 0; i < more_max; ++i) more.access[i] = i < count ? kept[i] : MemoryAccess{};
}

// All the code that accesses what tasks share, as far as it is remembered.
void Detector::learn_from(Cell& cell, std::uint64_t place) {
  learn_place(place);
  learn_place(cell.latest.place);
  if (cell.more == no_more) return;
  for (const MemoryAccess& access : shadow_.more(cell).access)
    if (access.bytes != 0) learn_place(access.place);
}

void Detector::learn_place(std::uint64_t place) {
  bool& known = learned_[place];
  if (!known && listener_ != nullptr) listener_->learned(place);
  known = true;
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

void Detector::report(const Cell& cell, const MemoryAccess& first, const MemoryAccess& second) {
  if (race_count_ == races_kept) return;
  for (std::size_t i = 0; i < race_count_; ++i) {
    const std::uint64_t a = races_[i].first.access.place, b = races_[i].second.access.place;
    if ((a == first.place && b == second.place) || (a == second.place && b == first.place)) return;
  }
  FoundRace& race = races_[race_count_++];
  std::memset(&race, 0, sizeof race);
  describe(race.first, first);
  describe(race.second, second);
  race.address = cell.word * 8 + static_cast<std::uint64_t>(__builtin_ctz(first.bytes & second.bytes));
  const char* address = reinterpret_cast<const char*>(race.address);
  for (const kernel::Task* task = kernel::running->scheduler->first_task(); task != nullptr; task = task->next)
    if (address >= task->fiber.stack.low && address < task->fiber.stack.high)
      std::memcpy(race.stack_of, task->name, sizeof race.stack_of);
  if (listener_ != nullptr) listener_->found(race);
}

std::size_t Detector::found(const FoundRace*& races) const {
  races = races_;
  return race_count_;
}

}  // namespace waitpoint::races
