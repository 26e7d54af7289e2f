// SPDX-License-Identifier: BSD-3-Clause
// Measures the portfolio on the body with instrumented accesses to memory: `PROGRAM STRATEGY 1 MILLISECONDS`; prints
// lines "NAME VALUE". A separate process, as it links another library.
#include "tests/bench/explore/throughput.hpp"
#include "tests/bench/kernel/meter.hpp"

int main(int argc, char** argv) {
  using namespace waitpoint::bench;
  const Request request = parse_request(argc, argv);
  const double seconds = 1e-3 * request.budget_ms;
  const Speed speed = best_of_some(seconds, [&](double s) { return by_strategy(request.workload, s); });
  answer("schedules", speed.schedules);
  answer("distinct", speed.distinct);
  answer("switch_points", speed.switch_points);
  answer("seconds", speed.seconds);
  return 0;
}
