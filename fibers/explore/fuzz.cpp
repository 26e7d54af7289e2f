// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/explore/fuzz.hpp"

#include <cstdio>
#include <cstdlib>

#include "fibers/explore/analysis/analysis.hpp"
#include "fibers/explore/body_target.hpp"
#include "fibers/explore/explore.hpp"
#include "fibers/explore/strategies/bytes.hpp"

namespace waitpoint {
namespace {

constexpr std::uint64_t runs_to_minimize = 20'000;
constexpr std::uint64_t runs_to_explain = 5'000;

}  // namespace

fuzz_target::fuzz_target(std::function<void()> body)
    : body_(std::move(body), nullptr, ExploreOptions().until, ExploreOptions().steps_max) {}

int fuzz_target::run(const std::uint8_t* data, std::size_t size) {
  exploration::Bytes bytes({data, size});
  bytes.begin(0, {}, {});
  const exploration::RunVerdict verdict = body_.run(bytes);
  if (verdict.passed()) return 0;
  const exploration::Finding found = body_.finding_of(verdict);
  exploration::BodyTarget target(body_, "", runs_to_minimize, runs_to_explain);
  const exploration::Analysis analysis =
      exploration::analyse(target, nullptr, {.drawn = false, .deviations = found.deviations}, found, {});
  const std::string& words = analysis.words.empty() ? analysis.least.words : analysis.words;
  std::fputs((words + "\n" + analysis.text).c_str(), stderr);
  std::abort();
}

}  // namespace waitpoint
