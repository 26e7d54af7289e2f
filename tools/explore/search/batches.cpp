// SPDX-License-Identifier: BSD-3-Clause
#include "tools/explore/search/batches.hpp"

#include <algorithm>

namespace waitpoint::tools {

void Batches::start(const Batch& batch, double now_s) {
  running_.insert_or_assign(batch.place, Running{batch.count, now_s});
}

void Batches::end(std::uint64_t place, std::uint32_t count, double now_s) {
  constexpr double batch_s = 0.005;
  const Running batch = running_.extract(place).mapped();
  const double each_s = (now_s - batch.started_s) / count;
  if (each_s * 2 * size_ < batch_s)
    size_ = std::min(2 * size_, most_);
  else if (each_s * size_ >= batch_s)
    size_ = 1;
  if (count < batch.count) left_.emplace(place + count, batch.count - count);
}

bool Batches::divide(std::uint64_t place) {
  const std::uint32_t count = running_.at(place).count;
  if (count == 1) return false;
  running_.erase(place);
  for (std::uint32_t i = 0; i < count; ++i) left_.emplace(place + i, 1);
  return true;
}

std::optional<Batches::Batch> Batches::take_left(std::uint64_t end) {
  if (left_.empty() || left_.begin()->first >= end) return std::nullopt;
  const Batch batch{left_.begin()->first, left_.begin()->second};
  left_.erase(left_.begin());
  return batch;
}

}  // namespace waitpoint::tools
