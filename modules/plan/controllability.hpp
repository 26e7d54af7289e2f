// SPDX-License-Identifier: BSD-3-Clause
// Dynamic controllability: whether a network with contingent links, whose durations nature chooses within bounds, can
// be executed so that all constraints hold, each decision made with the knowledge of the past alone.
//
// The cubic algorithm of P. Morris, "Dynamic controllability and dispatchability relationships" (CPAIOR 2014): from
// each point with an incoming negative edge, distances are propagated backwards until they are not negative; what then
// has been derived replaces the negative path. The network is controllable unless that leads back to a point under way.
// A reaction may be at the instant of what it reacts to.
//
// The by-products make the network dispatchable: constraints that follow from the contingent links, and waits: a point
// is not executed before a contingent end, or a time after that link's start, whichever comes first.
#pragma once

#include <span>
#include <vector>

#include "modules/plan/temporal_network.hpp"

namespace waitpoint::plan {

/// `least <= end - start <= most`, and nature executes `end`. `least` is not negative; a point ends at most one link.
struct ContingentLink {
  PointId start, end;
  Duration least, most;
  std::uint32_t label;
};

/// `point` waits for the end of the link, or until `after` past its start.
struct Wait {
  PointId point;
  std::size_t link;
  Duration after;
};

struct Controllability {
  bool controllable = true;
  std::vector<std::uint32_t> conflict;  ///< if not: labels of the constraints and links that contradict each other
  std::vector<Edge> implied;            ///< if controllable: constraints that follow, with the links' labels
  std::vector<Wait> waits;
};

/// `edges` are the constraints besides the links' own bounds, without a negative cycle.
Controllability controllability(std::size_t points, std::span<const Edge> edges, std::span<const ContingentLink> links);

}  // namespace waitpoint::plan
