// SPDX-License-Identifier: BSD-3-Clause
// Compiled with -fsanitize=thread.
#include "fibers/sync/thread.hpp"
#include "tests/fibers/explore/weak_memory/litmus.hpp"

namespace waitpoint::weak_memory {
namespace {

struct alignas(64) Variable {
  std::atomic<int> value{0};
};

// Not inlined: all threads have the same code.
[[gnu::noinline]] int execute(const Step& step, Variable* variables) {
  std::atomic<int>& variable = variables[step.location].value;
  switch (step.kind) {
    case Step::Kind::load: return variable.load(step.order);
    case Step::Kind::store: return variable.store(step.value, step.order), 0;
    case Step::Kind::add: return variable.fetch_add(step.value, step.order);
    case Step::Kind::exchange: return variable.exchange(step.value, step.order);
    case Step::Kind::fence: return std::atomic_thread_fence(step.order), 0;
  }
  return 0;
}

}  // namespace

void execute(const Litmus& litmus, void (*note)(std::size_t thread, int value)) {
  Variable variables[locations];
  // From here on each access is a switch point, in whatever order.
  for (int location = 0; location < locations; ++location) execute(store(location, 0, relaxed), variables);
  std::vector<thread> threads;
  for (std::size_t i = 0; i < litmus.size(); ++i)
    threads.emplace_back([&, i] {
      for (const Step& step : litmus[i])
        if (const int value = execute(step, variables); step.reads()) note(i, value);
    });
  for (thread& each : threads) each.join();
  for (int location = 0; location < locations; ++location)
    if (is_final(litmus, location)) note(litmus.size(), variables[location].value.load(relaxed));
}

}  // namespace waitpoint::weak_memory
