// SPDX-License-Identifier: BSD-3-Clause
// The result of one schedule of a scenario or a program as bytes: it is computed in a process of its own, and sent
// through a pipe from a program to itself.
#pragma once

#include <string>
#include <string_view>

#include "fibers/explore/target/finding.hpp"
#include "fibers/explore/target/plan.hpp"
#include "fibers/explore/target/wanted_evidence.hpp"

namespace waitpoint::tools {

using exploration::Finding;
using exploration::Plan;
using exploration::RunVerdict;
using exploration::ToldRace;
using exploration::WantedEvidence;

std::string to_bytes(const Finding& finding);
/// Parses the complete output of to_bytes().
Finding finding_of(std::string_view bytes);
/// "wp1:0123456789abcdef".
std::string digest_text(std::uint64_t digest);

}  // namespace waitpoint::tools
