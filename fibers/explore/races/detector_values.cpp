// SPDX-License-Identifier: BSD-3-Clause
// The detector's atomic operations in weak memory: the values of loads, and the happens-before edges of the stores that
// they read.
#include <cstring>

#include "fibers/explore/races/detector.hpp"
#include "fibers/explore/races/memory_order.hpp"
#include "fibers/kernel/access.hpp"

namespace waitpoint::races {
namespace {

Operator at(Context& context, int order, const void* place) {
  return {context.clock, context.index, context.record, reinterpret_cast<std::uint64_t>(place), order};
}

}  // namespace

// Code that is not instrumented may have released something there: the lock of a static, for example.
Location& Detector::location_of(std::uint64_t address, std::uint32_t size, std::uint64_t found) {
  const SyncPoint* const known = sync_points_.find(address);
  const bool is_of_this_run = known != nullptr && known->run == run_;
  return weak_.location(shadow_.cell_of(address / 8), address, size, found, is_of_this_run ? &known->clock : nullptr);
}

void Detector::acquire_from(const Store& store, int order) {
  join(acquires(order) ? current_->clock : current_->acquirable, store.released, clocks_);
}

std::uint64_t Detector::weak_load(std::uint64_t address, std::uint32_t size, std::uint64_t found, int order,
                                  const void* place) {
  Location& location = location_of(address, size, found);
  const Operator reader = at(*current_, order, place);
  read_location_ = &location;
  read_order_ = order;
  const bool had_left_out = weak_.left_out();
  const std::uint32_t readable = weak_.readable(location, reader);
  if (listener_ != nullptr && weak_.left_out() && !had_left_out) listener_->left_out_value();
  const Store& store = weak_.read(location, kernel::choose_value(readable), reader);
  acquire_from(store, order);
  return store.value;
}

void Detector::weak_compare(std::uint64_t address, std::uint32_t size, std::uint64_t found, int order,
                            const void* place) {
  acquire_from(weak_.read(location_of(address, size, found), 0, at(*current_, order, place)), order);
}

// A store starts a new release sequence: acquiring its value gives no knowledge of earlier ones.
void Detector::weak_store(std::uint64_t address, std::uint32_t size, std::uint64_t found, std::uint64_t value,
                          int order, const void* place) {
  Store& made = weak_.store(location_of(address, size, found), value, at(*current_, order, place));
  weak_.release(made, releases(order) ? current_->clock : current_->released);
  if (releases(order)) next_epoch(*current_);
}

// A read-modify-write continues it.
void Detector::weak_modify(std::uint64_t address, std::uint32_t size, std::uint64_t found, std::uint64_t value,
                           int order, const void* place) {
  Location& location = location_of(address, size, found);
  acquire_from(location.newest(), order);
  Store& made = weak_.store(location, value, at(*current_, order, place));
  weak_.release(made, location.newest(1).released);
  weak_.release(made, releases(order) ? current_->clock : current_->released);
  if (releases(order)) next_epoch(*current_);
}

void Detector::weak_read(const void* word, std::size_t size) {
  const auto address = reinterpret_cast<std::uint64_t>(word);
  const Cell* const cell = shadow_.find(address / 8);
  Location* const location = cell != nullptr ? weak_.find(*cell, address, static_cast<std::uint32_t>(size)) : nullptr;
  if (location != nullptr) weak_.read(*location, 0, at(*current_, __ATOMIC_RELAXED, nullptr));
}

void Detector::weak_overwrite(std::uint64_t address, std::uint32_t size) {
  for (std::uint64_t word = address / 8; word * 8 < address + size; ++word)
    if (const Cell* const cell = shadow_.find(word); cell != nullptr) weak_.overwrite(*cell, footprint::bytes);
}

ReadableStore Detector::readable_store(std::uint32_t newer) {
  const Store& store = read_location_->newest(newer);
  ReadableStore readable{store.value, store.place, {}, store.record, read_order_};
  std::memcpy(readable.task, tasks_[store.record].name, sizeof readable.task);
  return readable;
}

}  // namespace waitpoint::races
