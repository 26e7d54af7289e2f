// SPDX-License-Identifier: BSD-3-Clause
// Temporal plans: what is read is checked for consistency and controllability, and its execution begun.
#include <cstddef>
#include <cstdint>
#include <string>

#include "modules/plan/execution.hpp"
#include "modules/plan/plan_reader.hpp"
#include "tests/fuzz/refusal.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string contents(reinterpret_cast<const char*>(data), size);
  waitpoint::fuzz::reads_or_refuses([&] {
    const waitpoint::plan::TemporalPlan plan =
        waitpoint::plan::read_plan(waitpoint::scenario::parse_yaml(contents, "plan"));
    check(plan);
    waitpoint::plan::Execution execution(plan);
    const waitpoint::plan::PlanOrder order = execution.next({});
    if (order.kind == waitpoint::plan::PlanOrder::Kind::start) execution.started(order.action, {});
  });
  return 0;
}
