// SPDX-License-Identifier: BSD-3-Clause
#include "tools/explore/learned_code.hpp"

namespace waitpoint::tools {
namespace {

// In random orders, after a run in the default order.
std::uint64_t learning_runs(const Finding& usual) {
  constexpr std::uint64_t short_run = 5'000, medium_run = 50'000;  // in events
  if (usual.decisions == 0) return 0;
  return usual.events <= short_run ? 8 : usual.events <= medium_run ? 2 : 0;
}

}  // namespace

std::vector<std::uint64_t> learn_code(
    const ProgramFiles& files,
    const std::function<Finding(const Plan& plan, const std::vector<std::uint64_t>& known)>& learn) {
  if (!files.watches_accesses()) return {};
  const Finding usual = learn({.drawn = false}, {});
  std::vector<std::uint64_t> known = usual.profile.code;
  const std::uint64_t more = files.instrumented ? 0 : learning_runs(usual);
  for (std::uint64_t i = 0; i < more; ++i) {
    const Finding finding = learn({.drawn = false, .at_random_from = 0, .attempt = i}, known);
    if (finding.kind == Finding::Kind::no_progress) break;  // the next could take as long, too
    known.insert(known.end(), finding.profile.code.begin(), finding.profile.code.end());
  }
  return known;
}

}  // namespace waitpoint::tools
