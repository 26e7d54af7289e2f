// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/explore/fuzz.hpp"

#include <cstdio>
#include <cstdlib>

#include "fibers/explore/explain.hpp"
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
  const exploration::Outcome outcome = body_.run(bytes);
  if (outcome.passed()) return 0;
  const exploration::Failure failure{body_.explorer().schedule(), outcome};
  const exploration::Failure least =
      exploration::with_places(body_, exploration::minimize(body_, failure, {runs_to_minimize}));
  const std::string text = least.outcome.failure + "\n" + exploration::explain(body_, least, {runs_to_explain}).text;
  std::fputs(text.c_str(), stderr);
  std::abort();
}

}  // namespace waitpoint
