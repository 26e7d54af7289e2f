// SPDX-License-Identifier: BSD-3-Clause
// CGAL: all obstacles in an arrangement of segments, and the visibility polygon of each place; a range ends where its
// beam leaves the polygon. Discs are polygons of sixteen sides. Visibility is exact and unlimited: there is no maximum
// range.
#include <CGAL/Arr_segment_traits_2.h>
#include <CGAL/Arr_trapezoid_ric_point_location.h>
#include <CGAL/Arrangement_2.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Triangular_expansion_visibility_2.h>

#include <algorithm>
#include <cmath>

#include "tests/bench/world/contenders.hpp"

namespace waitpoint::bench {
namespace {

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Arrangement = CGAL::Arrangement_2<CGAL::Arr_segment_traits_2<Kernel>>;
using Visibility = CGAL::Triangular_expansion_visibility_2<Arrangement, CGAL::Tag_true>;
using Location = CGAL::Arr_trapezoid_ric_point_location<Arrangement>;

class ByCgal : public Contender {
 public:
  explicit ByCgal(const Place& place) {
    std::vector<Kernel::Segment_2> sides;
    for (const world::Shape& shape : place.obstacles) {
      const std::vector<Point> around = corners(shape);
      for (std::size_t i = 0; i < around.size(); ++i) {
        const Point a = around[i], b = around[(i + 1) % around.size()];
        sides.emplace_back(Kernel::Point_2(a.x, a.y), Kernel::Point_2(b.x, b.y));
      }
    }
    CGAL::insert(arrangement_, sides.begin(), sides.end());
    location_.attach(arrangement_);
    visibility_.attach(arrangement_);
  }

  void place(std::span<const world::Shape>) override {}

  void scan(const Pose& at, std::uint32_t, std::span<double, beams> ranges_m) override {
    std::fill(ranges_m.begin(), ranges_m.end(), range_max_m);
    const Kernel::Point_2 eye(at.x, at.y);
    const auto found = location_.locate(eye);
    const auto* const face = boost::get<Arrangement::Face_const_handle>(&found);
    if (face == nullptr || (*face)->is_unbounded()) return;
    seen_.clear();
    const auto polygon = visibility_.compute_visibility(eye, *face, seen_);
    // Sides in counter-clockwise order around the eye: each has the beams between its ends.
    const auto [s, c] = exact::sincos(at.heading);
    const auto first = polygon->outer_ccb();
    auto side = first;
    do {
      const Point a = seen_from(at, side->source()->point()), b = seen_from(at, side->target()->point());
      lower({c * a.x + s * a.y, c * a.y - s * a.x}, {c * b.x + s * b.y, c * b.y - s * b.x}, ranges_m);
    } while (++side != first);
  }

 private:
  static Point seen_from(const Pose& at, const Kernel::Point_2& p) {
    return {CGAL::to_double(p.x()) - at.x, CGAL::to_double(p.y()) - at.y};
  }

  // Beams start at -90 degrees, in the device's frame.
  static void lower(Point a, Point b, std::span<double, beams> ranges_m) {
    const double across = cross(a, b);
    if (!(across > 0)) return;  // parallel to a beam
    constexpr double step_rad = exact::pi / (beams - 1);
    const double from = std::atan2(a.y, a.x) + 0.5 * exact::pi;
    const double to = from + std::atan2(across, dot(a, b));
    for (const double turn : {0.0, -2 * exact::pi}) {
      const auto last = static_cast<std::ptrdiff_t>(std::floor((to + turn) / step_rad));
      for (auto i = static_cast<std::ptrdiff_t>(std::ceil((from + turn) / step_rad)); i <= last; ++i) {
        if (i < 0 || i >= static_cast<std::ptrdiff_t>(beams)) continue;
        const auto beam = static_cast<std::size_t>(i);
        ranges_m[beam] = std::min(ranges_m[beam], across / cross(directions()[beam], b - a));
      }
    }
  }

  Arrangement arrangement_, seen_;
  Location location_;
  Visibility visibility_;
};

}  // namespace

std::unique_ptr<Contender> cgal(const Place& place) { return std::make_unique<ByCgal>(place); }

}  // namespace waitpoint::bench
