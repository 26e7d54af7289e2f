// SPDX-License-Identifier: BSD-3-Clause
#include "tools/explore/search/batches.hpp"

#include <algorithm>

namespace waitpoint::tools {

void Batches::start(const Batch& batch, double now_s) { running_.insert_or_assign(batch.place, Running{batch, now_s}); }

// So many of its schedules are a batch of their own.
void Batches::leave(const Batch& batch, std::uint32_t from, std::uint32_t count) {
  const std::uint64_t place = batch.place + from;
  left_.emplace(place, Batch{.place = place, .number = batch.number + from * step_, .count = count});
}

void Batches::end(std::uint64_t place, std::uint32_t count, double now_s) {
  constexpr double batch_s = 0.005;
  const auto [batch, started_s] = running_.extract(place).mapped();
  const double each_s = (now_s - started_s) / count;
  if (each_s * 2 * size_ < batch_s)
    size_ = std::min(2 * size_, most_);
  else if (each_s * size_ >= batch_s)
    size_ = 1;
  if (count < batch.count) leave(batch, count, batch.count - count);
}

bool Batches::divide(std::uint64_t place) {
  const Batch batch = running_.at(place).batch;
  if (batch.count == 1) return false;
  running_.erase(place);
  for (std::uint32_t i = 0; i < batch.count; ++i) leave(batch, i, 1);
  return true;
}

std::optional<Batch> Batches::take_left(std::uint64_t end) {
  if (left_.empty() || left_.begin()->first >= end) return std::nullopt;
  return left_.extract(left_.begin()).mapped();
}

}  // namespace waitpoint::tools
