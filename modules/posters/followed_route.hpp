// SPDX-License-Identifier: BSD-3-Clause
// The route that a module drives a robot along, for viewers. Not a poster: it would be an event of the run.
#pragma once

#include <span>

#include "core/pose.hpp"

namespace waitpoint::posters {

class FollowedRoute {
 public:
  virtual ~FollowedRoute() = default;

  /// The via points ahead in the map frame, the last is the goal; empty without a route.
  virtual std::span<const Point> route_ahead() const = 0;
};

}  // namespace waitpoint::posters
