// SPDX-License-Identifier: BSD-3-Clause
#include "world/slice/depth_buffer.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "world/planar/ray.hpp"

namespace waitpoint::world {
namespace {

constexpr std::size_t beams_max = 1 << 20;
// Of a fan of one beam: so many to a radian that what does not lie before it is beside it.
constexpr double per_rad_alone = 1e6;

// Rounded up, so that nothing as near is dropped.
float squared_up(double range_m) {
  const float rounded = static_cast<float>(range_m);
  return rounded * rounded * (1 + 1e-6f);
}

}  // namespace

void DepthBuffer::begin(const Fan& fan, double range_max_m, bool identify) {
  beams_ = fan.directions.size();
  half_rad_ = 0.5 * fan.angle_step_rad * static_cast<double>(beams_ > 1 ? beams_ - 1 : 0);
  WAITPOINT_CHECK(beams_ <= beams_max, "a fan of more than 2^20 beams");
  WAITPOINT_CHECK(half_rad_ >= 0 && half_rad_ <= exact::pi * (1 + 1e-12), "a fan of more than a full turn");
  origin_ = fan.origin;
  axis_ = fan.axis;
  per_rad_ = fan.angle_step_rad > 0 ? 1 / fan.angle_step_rad : per_rad_alone;
  range_max_m_ = range_max_m;
  identify_ = identify;

  const std::size_t blocks = (beams_ + Beams::block - 1) / Beams::block, padded = blocks * Beams::block;
  x_.resize(padded);
  y_.resize(padded);
  for (std::size_t i = kernels_->turn(fan.directions.data(), beams_, axis_, x_.data(), y_.data()); i < beams_; ++i) {
    const Point d = fan.directions[i];
    x_[i] = axis_.x * d.x - axis_.y * d.y;
    y_[i] = axis_.y * d.x + axis_.x * d.y;
  }
  for (std::size_t i = beams_; i < padded; ++i) {
    x_[i] = x_[beams_ - 1];
    y_[i] = y_[beams_ - 1];
  }
  ranges_m_.assign(padded, range_max_m);
  if (identify) solids_.assign(padded, no_solid);
  farthest_m2_.assign(blocks + Beams::blocks_read_beyond, squared_up(range_max_m));
}

Beams DepthBuffer::beams() {
  return {origin_, x_.data(), y_.data(), ranges_m_.data(), farthest_m2_.data(), identify_ ? solids_.data() : nullptr};
}

View DepthBuffer::view(Point middle, double extent_m) const {
  const Point o = origin_ - middle;
  const double margin = float_margin_m(extent_m + std::max(std::fabs(o.x), std::fabs(o.y)));
  View view;
  view.low_x = static_cast<float>(o.x - margin);
  view.low_y = static_cast<float>(o.y - margin);
  view.high_x = static_cast<float>(o.x + margin);
  view.high_y = static_cast<float>(o.y + margin);
  view.axis_x = static_cast<float>(axis_.x);
  view.axis_y = static_cast<float>(axis_.y);
  view.half_rad = static_cast<float>(half_rad_);
  view.per_rad = static_cast<float>(per_rad_);
  view.beams = static_cast<std::int32_t>(beams_);
  view.reach_m2 = std::min(squared_up(range_max_m_), std::numeric_limits<float>::max());
  return view;
}

bool DepthBuffer::hidden(float near_m2, std::int32_t first, std::int32_t last) const {
  return kernels_->all_nearer(farthest_m2_.data(), first / Beams::block, last / Beams::block, near_m2);
}

bool DepthBuffer::hidden(const Pending& what) const {
  if (what.first <= what.last) return hidden(what.near_m2, what.first, what.last);
  return hidden(what.near_m2, what.first, static_cast<std::int32_t>(beams_) - 1) && hidden(what.near_m2, 0, what.last);
}

// Shows `ask` what is narrow, at once; the rest is pending, the nearest on top of what was so before.
template <class Ask>
void DepthBuffer::push_in_sight(const EightBounds& bounds, const View& view, std::span<const std::int32_t> children,
                                Ask ask) {
  Sight sight;
  const std::size_t before = pending_.size();
  for (unsigned seen = kernels_->look(bounds, view, sight); seen != 0; seen &= seen - 1) {
    const auto i = static_cast<std::size_t>(std::countr_zero(seen));
    const Pending child = {sight.near_m2[i], children[i], sight.first[i], sight.last[i]};
    if (hidden(child)) continue;
    if (child.child < 0 && is_narrow(child)) {
      ask(static_cast<std::size_t>(~child.child), child);
      continue;
    }
    std::size_t at = pending_.size();
    pending_.push_back(child);
    for (; at > before && pending_[at - 1].near_m2 < child.near_m2; --at) pending_[at] = pending_[at - 1];
    pending_[at] = child;
  }
}

void DepthBuffer::ask_narrow(const Outline& outline, std::uint32_t solid, const Pending& where) {
  bool lowered = false;
  for (auto i = static_cast<std::size_t>(where.first); i <= static_cast<std::size_t>(where.last); ++i) {
    if (squared_up(ranges_m_[i]) < where.near_m2) continue;
    const double range_m = hit_distance(outline, {origin_, {x_[i], y_[i]}});
    if (range_m > ranges_m_[i]) continue;
    const bool nearer = range_m < ranges_m_[i];
    // A hit at the limit is none, and is not told from one.
    if (identify_ && (nearer || (solids_[i] != no_solid && solid < solids_[i]))) solids_[i] = solid;
    ranges_m_[i] = range_m;
    lowered = lowered || nearer;
  }
  if (!lowered) return;
  for (std::int32_t block = where.first / Beams::block; block <= where.last / Beams::block; ++block) {
    const auto first = ranges_m_.begin() + block * Beams::block;
    farthest_m2_[static_cast<std::size_t>(block)] = squared_up(*std::max_element(first, first + Beams::block));
  }
}

void DepthBuffer::ask(const Outline& outline, std::uint32_t solid, const Pending& where) {
  if (is_narrow(where)) return ask_narrow(outline, solid, where);
  const auto question = outline.is_box ? kernels_->ask_box : kernels_->ask_disc;
  const std::int32_t first = where.first / Beams::block, last = where.last / Beams::block;
  if (where.first <= where.last) return question({outline, solid, first, last, where.near_m2}, beams());
  question({outline, solid, first, (static_cast<std::int32_t>(beams_) - 1) / Beams::block, where.near_m2}, beams());
  question({outline, solid, 0, last, where.near_m2}, beams());
}

// Shows `ask` what is in sight and not hidden, near to far, by its number in the tree.
template <class Ask>
void DepthBuffer::walk(std::span<const TreeNode> nodes, const View& from, Ask ask) {
  if (nodes.empty() || beams_ == 0) return;
  pending_.clear();
  push_in_sight(nodes[0].bounds, from, nodes[0].child, ask);
  while (!pending_.empty()) {
    const Pending next = pending_.back();
    pending_.pop_back();
    if (hidden(next)) continue;
    if (next.child >= 0) {
      const TreeNode& node = nodes[static_cast<std::size_t>(next.child)];
      push_in_sight(node.bounds, from, node.child, ask);
    } else {
      ask(static_cast<std::size_t>(~next.child), next);
    }
  }
}

void DepthBuffer::lower(const Slice& slice) {
  const Tree& tree = slice.tree();
  walk(tree.nodes(), view(tree.middle(), tree.extent_m()),
       [&](std::size_t in_tree, const Pending& where) { ask(slice.outline(in_tree), slice.solid(in_tree), where); });
}

void DepthBuffer::lower(const MovingSolids& solids, double height_m, std::uint32_t except) {
  walk(solids.nodes(), view({0, 0}, solids.extent_m()), [&](std::size_t at, const Pending& where) {
    const std::uint32_t solid = solids.first_solid() + static_cast<std::uint32_t>(at);
    if (solid != except && solids.reaches(at, height_m)) ask(solids.outline(at), solid, where);
  });
}

}  // namespace waitpoint::world
