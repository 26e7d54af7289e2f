// SPDX-License-Identifier: BSD-3-Clause
#include "tools/explore/runs/learned_code.hpp"

#include <algorithm>
#include <iterator>

namespace waitpoint::tools {
namespace {

// In random orders, after a run in the default order.
std::uint64_t learning_runs(const Finding& usual) {
  constexpr std::uint64_t short_run = 5'000, medium_run = 50'000;  // in events
  if (usual.decisions == 0) return 0;
  return usual.events <= short_run ? 8 : usual.events <= medium_run ? 2 : 0;
}

// Instructions with the operand of a learned one, a global variable or, nearby, the same registers, access the same
// memory: paths that the learning runs have not taken, such as that of a lock which is held.
bool are_alike(const posix::AccessInstruction& one, const posix::AccessInstruction& other) {
  constexpr std::uint64_t nearby = 256;
  const std::uint64_t distance = std::max(one.place, other.place) - std::min(one.place, other.place);
  return one.module() == other.module() && one.displacement == other.displacement &&
         one.is_absolute == other.is_absolute && one.base == other.base && one.index == other.index &&
         one.scale == other.scale && (one.is_absolute || distance < nearby);
}

void add_alike(const std::vector<posix::AccessInstruction>& all, std::vector<std::uint64_t>& known) {
  std::ranges::sort(known);
  std::vector<posix::AccessInstruction> learned;
  std::ranges::copy_if(all, std::back_inserter(learned), [&](const posix::AccessInstruction& one) {
    return std::ranges::binary_search(known, one.place);
  });
  for (const posix::AccessInstruction& one : all)
    if (std::ranges::any_of(learned, [&](const posix::AccessInstruction& other) { return are_alike(one, other); }))
      known.push_back(one.place);
}

}  // namespace

std::vector<std::uint64_t> learn_code(
    const ProgramFiles& files,
    const std::function<Finding(const Plan& plan, const std::vector<std::uint64_t>& known)>& learn) {
  if (!files.watches_accesses()) return {};
  const Finding usual = learn({.drawn = false}, {});
  if (usual.obstacle != AccessObstacle::none) return {};
  std::vector<std::uint64_t> known = usual.lesson.profile.code;
  const std::uint64_t more = files.instrumented ? 0 : learning_runs(usual);
  for (std::uint64_t i = 0; i < more; ++i) {
    const Finding finding = learn({.drawn = false, .at_random_from = 0, .attempt = i}, known);
    if (finding.kind == RunVerdict::Kind::no_progress) break;  // the next could take as long, too
    if (finding.obstacle != AccessObstacle::none) return {};
    known.insert(known.end(), finding.lesson.profile.code.begin(), finding.lesson.profile.code.end());
  }
  add_alike(files.accesses, known);
  return known;
}

}  // namespace waitpoint::tools
