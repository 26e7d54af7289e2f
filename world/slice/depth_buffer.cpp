// SPDX-License-Identifier: BSD-3-Clause
#include "world/slice/depth_buffer.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "world/planar/hit.hpp"

namespace waitpoint::world {
namespace {

constexpr std::size_t beams_max = 1 << 20;
// Beams per radian of a fan with one beam: so many that rectangles off the beam fall outside its interval.
constexpr double per_rad_alone = 1e6;
// A tree with so many nodes is mostly out of the cache.
constexpr std::size_t many_nodes = 1024;

// Below the distance of EightBounds::nowhere().
constexpr float farthest_solid_m = 1e20f;

// Rounded up, so that no equally near solid is dropped.
float rounded_up(double range_m) { return static_cast<float>(range_m) * (1 + 1e-6f); }
float squared_up(double range_m) {
  const float rounded = static_cast<float>(range_m);
  return rounded * rounded * (1 + 1e-6f);
}

// Inserts `what` into the items of `pending` from index `before` on, which are sorted: the nearest is last.
template <class Pending>
void push_nearest_last(std::vector<Pending>& pending, std::size_t before, const Pending& what, float Pending::*near) {
  std::size_t at = pending.size();
  pending.push_back(what);
  for (; at > before && pending[at - 1].*near < what.*near; --at) pending[at] = pending[at - 1];
  pending[at] = what;
}

}  // namespace

void DepthBuffer::begin(const Fan& fan, double range_max_m, bool identify) {
  beams_ = fan.directions.size();
  half_rad_ = 0.5 * fan.angle_step_rad * static_cast<double>(beams_ > 1 ? beams_ - 1 : 0);
  WAITPOINT_CHECK(beams_ <= beams_max, "a fan of more than 2^20 beams");
  WAITPOINT_CHECK(half_rad_ >= 0 && half_rad_ <= exact::pi * (1 + 1e-12), "a fan of more than a full turn");
  WAITPOINT_CHECK(range_max_m >= 0, "a scan's greatest range is negative or NaN");
  [[maybe_unused]] const auto is_unit = [](Point direction) { return std::fabs(dot(direction, direction) - 1) < 1e-6; };
  WAITPOINT_FAST_CHECK(std::all_of(fan.directions.begin(), fan.directions.end(), is_unit) && is_unit(fan.axis),
                       "a direction of a fan is not a unit vector");
  origin_ = fan.origin;
  axis_ = fan.axis;
  per_rad_ = fan.angle_step_rad > 0 ? 1 / fan.angle_step_rad : per_rad_alone;
  range_max_m_ = range_max_m;
  identify_ = identify;

  const std::size_t blocks = (beams_ + Beams::block - 1) / Beams::block, padded = blocks * Beams::block;
  x_.resize(padded + Beams::beams_read_beyond);
  y_.resize(padded + Beams::beams_read_beyond);
  for (std::size_t i = kernels_->turn(fan.directions.data(), beams_, axis_, x_.data(), y_.data()); i < beams_; ++i) {
    const Point d = fan.directions[i];
    x_[i] = axis_.x * d.x - axis_.y * d.y;
    y_[i] = axis_.y * d.x + axis_.x * d.y;
  }
  for (std::size_t i = beams_; beams_ > 0 && i < x_.size(); ++i) {
    x_[i] = x_[beams_ - 1];
    y_[i] = y_[beams_ - 1];
  }
  ranges_m_.assign(padded + Beams::beams_read_beyond, range_max_m);
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
  view.farthest_m2 = farthest_m2_.data();
  return view;
}

bool DepthBuffer::hidden(float near_m2, std::int32_t first, std::int32_t last) const {
  if (last - first >= few_blocks * Beams::block)
    return kernels_->all_nearer(farthest_m2_.data(), first / Beams::block, last / Beams::block, near_m2);
  const double near_m = std::sqrt(static_cast<double>(near_m2)) * (1 - 1e-6);
  return kernels_->all_end_nearer(ranges_m_.data(), first, last, near_m);
}

// True if its interval begins and ends at beams of the scan.
bool DepthBuffer::is_within(const Pending& what) const {
  const auto beams = static_cast<std::int32_t>(beams_);
  return 0 <= what.first && what.first < beams && 0 <= what.last && what.last < beams;
}

bool DepthBuffer::hidden(const Pending& what) const {
  WAITPOINT_FAST_CHECK(is_within(what), "a rectangle's interval of beams is not within the scan");
  if (what.first <= what.last) return hidden(what.near_m2, what.first, what.last);
  return hidden(what.near_m2, what.first, static_cast<std::int32_t>(beams_) - 1) && hidden(what.near_m2, 0, what.last);
}

// Tests the node's narrow solids at once, and prefetches the children (`place(number)` is a solid's address). The other
// children are pushed, the nearest on top.
template <class Find, class Place>
void DepthBuffer::push_in_sight(std::span<const TreeNode> nodes, std::size_t node, const View& view, Find find,
                                Place place) {
  const auto& children = nodes[node].child;
  Sight sight;
  const std::size_t before = pending_.size();
  unsigned seen = kernels_->look(nodes[node], view, sight);
  const bool is_large = nodes.size() >= many_nodes;
  for (unsigned rest = is_large ? seen : 0; rest != 0; rest &= rest - 1) {
    const std::int32_t child = children[static_cast<std::size_t>(std::countr_zero(rest))];
    const void* const first =
        child < 0 ? static_cast<const void*>(place(~child)) : &nodes[static_cast<std::size_t>(child)];
    const std::size_t size = child < 0 ? sizeof(Outline) : sizeof(TreeNode);
    for (std::size_t at = 0; at < size; at += 64) __builtin_prefetch(static_cast<const char*>(first) + at);
  }
  std::array<NarrowQuestion, EightBounds::width> narrow;
  int narrow_count = 0;
  unsigned narrow_ones = seen & sight.narrow & sight.solids;
  seen &= ~narrow_ones;
  for (; narrow_ones != 0; narrow_ones &= narrow_ones - 1) {
    const auto i = static_cast<std::size_t>(std::countr_zero(narrow_ones));
    const Candidate candidate = find(~children[i]);
    if (candidate.outline == nullptr) continue;
    if (identify_ || candidate.outline->polygon != nullptr)
      ask_narrow(*candidate.outline, candidate.solid, {sight.near_m2[i], children[i], sight.first[i], sight.last[i]});
    else
      narrow[static_cast<std::size_t>(narrow_count++)] = {candidate.outline, sight.first[i], sight.last[i]};
  }
  for (; seen != 0; seen &= seen - 1) {
    const auto i = static_cast<std::size_t>(std::countr_zero(seen));
    const Pending child = {sight.near_m2[i], children[i], sight.first[i], sight.last[i]};
    WAITPOINT_FAST_CHECK(child.child != TreeNode::none, "an unused lane of a node is in sight");
    if (!is_of_two_blocks(child) && hidden(child)) continue;
    push_nearest_last(pending_, before, child, &Pending::near_m2);
  }
  if (narrow_count > 0) kernels_->ask_narrow(narrow.data(), narrow_count, beams());
}

// True if the test lowers the beam's range.
bool DepthBuffer::ask_beam(std::size_t beam, const Outline& outline, std::uint32_t solid) {
  WAITPOINT_FAST_CHECK(beam < beams_, "a solid is tested against a beam beyond the scan");
  const double range_m = hit(outline, {origin_, {x_[beam], y_[beam]}});
  WAITPOINT_FAST_CHECK(range_m >= 0, "the distance of a hit is negative or NaN");
  if (range_m > ranges_m_[beam]) return false;
  const bool nearer = range_m < ranges_m_[beam];
  // A hit exactly at the limit counts as none: a beam without a solid keeps none.
  if (identify_ && (nearer || (solids_[beam] != no_solid && solid < solids_[beam]))) solids_[beam] = solid;
  ranges_m_[beam] = range_m;
  return nearer;
}

void DepthBuffer::note_farthest(std::int32_t block) {
  WAITPOINT_FAST_CHECK(0 <= block && static_cast<std::size_t>(block) + Beams::blocks_read_beyond < farthest_m2_.size(),
                       "a block of beams is beyond the scan");
  const double* const first = ranges_m_.data() + block * Beams::block;
  double most = 0;
  for (int i = 0; i < Beams::block; ++i) most = std::max(most, first[i]);
  farthest_m2_[static_cast<std::size_t>(block)] = squared_up(most);
}

void DepthBuffer::ask_narrow(const Outline& outline, std::uint32_t solid, const Pending& where) {
  bool lowered = false;
  for (auto i = static_cast<std::size_t>(where.first); i <= static_cast<std::size_t>(where.last); ++i)
    if (squared_up(ranges_m_[i]) >= where.near_m2) lowered = ask_beam(i, outline, solid) || lowered;
  if (!lowered) return;
  for (std::int32_t block = where.first / Beams::block; block <= where.last / Beams::block; ++block)
    note_farthest(block);
}

// For polygons, which have no kernel: they are few.
void DepthBuffer::ask_each(const Outline& outline, std::uint32_t solid, const Pending& where) {
  const auto beams = static_cast<std::int32_t>(beams_);
  if (where.first <= where.last) return ask_narrow(outline, solid, where);
  ask_narrow(outline, solid, {where.near_m2, where.child, where.first, beams - 1});
  ask_narrow(outline, solid, {where.near_m2, where.child, 0, where.last});
}

void DepthBuffer::ask(const Outline& outline, std::uint32_t solid, const Pending& where) {
  WAITPOINT_FAST_CHECK(is_within(where), "a solid's interval of beams is not within the scan");
  if (is_narrow(where)) return ask_narrow(outline, solid, where);
  if (outline.polygon != nullptr) return ask_each(outline, solid, where);
  const auto question = outline.is_box ? kernels_->ask_box : kernels_->ask_disc;
  const std::int32_t first = where.first / Beams::block, last = where.last / Beams::block;
  if (where.first <= where.last) return question({outline, solid, first, last, where.near_m2}, beams());
  question({outline, solid, first, (static_cast<std::int32_t>(beams_) - 1) / Beams::block, where.near_m2}, beams());
  question({outline, solid, 0, last, where.near_m2}, beams());
}

// Tests the solids in sight that are not hidden, near to far.
template <class Find, class Place>
void DepthBuffer::walk(std::span<const TreeNode> nodes, const View& from, Find find, Place place) {
  pending_.clear();
  push_in_sight(nodes, 0, from, find, place);
  while (!pending_.empty()) {
    const Pending next = pending_.back();
    pending_.pop_back();
    if (hidden(next)) continue;
    if (next.child >= 0) {
      push_in_sight(nodes, static_cast<std::size_t>(next.child), from, find, place);
    } else if (const Candidate candidate = find(~next.child); candidate.outline != nullptr) {
      ask(*candidate.outline, candidate.solid, next);
    }
  }
}

// The lowest node that contains every solid in reach of the view; negative if there is none in reach.
std::int32_t DepthBuffer::node_in_reach(std::span<const TreeNode> nodes, const View& from, float reach_m) const {
  const FloatBounds wanted = {from.low_x - reach_m, from.low_y - reach_m, from.high_x + reach_m, from.high_y + reach_m};
  for (std::int32_t at = 0;;) {
    const TreeNode& node = nodes[static_cast<std::size_t>(at)];
    const unsigned met = kernels_->overlap(node.bounds, wanted);
    if (met == 0) return -1;
    const std::int32_t child = node.child[static_cast<std::size_t>(std::countr_zero(met))];
    if (!std::has_single_bit(met) || child < 0) return at;
    WAITPOINT_FAST_CHECK(at < child && static_cast<std::size_t>(child) < nodes.size(),
                         "a tree's node does not come before its child");
    at = child;
  }
}

// Walks the tree with few beams, near to far: a node is visited with the beams that meet it, and a solid is tested
// against the beams that meet its rectangle.
template <class Find>
void DepthBuffer::walk_few(std::span<const TreeNode> nodes, const View& from, Find find) {
  WAITPOINT_FAST_CHECK(0 < beams_ && beams_ <= FewBeams::most, "a walk with few beams has too many, or none");
  FewBeams few = {};
  few.low_x = from.low_x, few.low_y = from.low_y, few.high_x = from.high_x, few.high_y = from.high_y;
  for (std::size_t i = 0; i < beams_; ++i) {
    few.x[i] = static_cast<float>(x_[i]);
    few.y[i] = static_cast<float>(y_[i]);
    few.reach_m[i] = std::min(rounded_up(ranges_m_[i]), farthest_solid_m);
  }
  MetByFew met;
  pending_few_.clear();
  const float reach_m = *std::max_element(few.reach_m, few.reach_m + beams_);
  if (const std::int32_t first = node_in_reach(nodes, from, reach_m); first >= 0)
    pending_few_.push_back({0, first, (1u << beams_) - 1});
  while (!pending_few_.empty()) {
    const PendingFew next = pending_few_.back();
    pending_few_.pop_back();
    const TreeNode& node = nodes[static_cast<std::size_t>(next.child)];
    const std::size_t before = pending_few_.size();
    for (unsigned rest = kernels_->meet(node.bounds, next.near_m, few, next.beams, met); rest != 0; rest &= rest - 1) {
      const auto i = static_cast<std::size_t>(std::countr_zero(rest));
      const PendingFew child = {met.near_m[i], node.child[i], met.beams[i]};
      if (child.child >= 0) {
        push_nearest_last(pending_few_, before, child, &PendingFew::near_m);
      } else if (const Candidate candidate = find(~child.child); candidate.outline != nullptr) {
        for (unsigned those = child.beams; those != 0; those &= those - 1) {
          const auto beam = static_cast<std::size_t>(std::countr_zero(those));
          if (child.near_m <= few.reach_m[beam] && ask_beam(beam, *candidate.outline, candidate.solid))
            few.reach_m[beam] = rounded_up(ranges_m_[beam]);
        }
      }
    }
  }
  for (std::size_t beam = 0; beam < beams_; beam += Beams::block)
    note_farthest(static_cast<std::int32_t>(beam / Beams::block));
}

// Tests the solids that the beams may meet: `find(number)` is the candidate of a number in the tree, `place(number)`
// the address of its outline.
template <class Find, class Place>
void DepthBuffer::lower(std::span<const TreeNode> nodes, Point middle, double extent_m, Find find, Place place) {
  if (nodes.empty() || beams_ == 0) return;
  const View from = view(middle, extent_m);
  if (beams_ <= FewBeams::most) return walk_few(nodes, from, find);
  walk(nodes, from, find, place);
}

void DepthBuffer::lower(const Slice& slice) {
  const Tree& tree = slice.tree();
  const auto find = [&](std::int32_t in_tree) {
    const auto number = static_cast<std::size_t>(in_tree);
    return Candidate{&slice.outline(number), slice.solid(number)};
  };
  lower(tree.nodes(), tree.middle(), tree.extent_m(), find,
        [&](std::int32_t in_tree) { return &slice.outline(static_cast<std::size_t>(in_tree)); });
}

void DepthBuffer::lower(const MovingSolids& solids, double height_m, std::uint32_t except) {
  const auto find = [&](std::int32_t in_tree) {
    const auto at = static_cast<std::size_t>(in_tree);
    const std::uint32_t solid = solids.first_solid() + static_cast<std::uint32_t>(at);
    return solid != except && solids.reaches(at, height_m) ? Candidate{&solids.outline(at), solid} : Candidate{};
  };
  lower(solids.nodes(), {0, 0}, solids.extent_m(), find,
        [&](std::int32_t in_tree) { return &solids.outline(static_cast<std::size_t>(in_tree)); });
}

}  // namespace waitpoint::world
