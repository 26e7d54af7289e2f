// SPDX-License-Identifier: BSD-3-Clause
// The partners outside that the options of a run name.
#pragma once

#include <string>
#include <vector>

#include "modules/outside/partners.hpp"
#include "modules/scenario/scenario.hpp"

namespace waitpoint::tools {

/// --external and --serve-world, as given.
struct PartnerOptions {
  std::vector<std::string> external;  ///< "ROBOT=unix:PATH" or "ROBOT=tcp:PORT" each, with run::ExternalSettings
  std::string serve_world;            ///< "unix:PATH" or "tcp:PORT"; empty: not served
  bool faults_end = false;

  /// The option that was given.
  const char* name() const { return external.empty() ? "--serve-world" : "--external"; }
  bool any() const { return !external.empty() || !serve_world.empty(); }
};

/// Listens for all of them. Throws BadInput for a robot that the scenario lacks, an endpoint that cannot be had, and a
/// world whose bodies cannot be guided. The scenario must outlive them.
outside::Partners make_partners(const PartnerOptions& options, const scenario::Scenario& scenario);

}  // namespace waitpoint::tools
