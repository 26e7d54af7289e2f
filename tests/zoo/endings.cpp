// SPDX-License-Identifier: BSD-3-Clause
// Ends during ongoing work: stops, cancellations, results, last messages.
#include <array>
#include <deque>
#include <mutex>

#include "fibers/explore/explore.hpp"
#include "fibers/sync/atomic.hpp"
#include "fibers/sync/condition_variable.hpp"
#include "fibers/sync/future.hpp"
#include "fibers/sync/mutex.hpp"
#include "fibers/sync/stop_token.hpp"
#include "tests/zoo/zoo.hpp"

// Needs the primitives declared above.
#include "tests/zoo/shared/endings.hpp"

namespace waitpoint::zoo {
namespace {

// The worker finds no message, and then that it should stop: the last message arrived in between. Mended, it checks the
// stop first.
template <bool mended>
void last_message() {
  constexpr int messages = 3;
  mutex lock;
  std::deque<int> queue;
  atomic<bool> stop(false);
  int handled = 0;
  const auto handle = [&] {
    const std::lock_guard guard(lock);
    if (queue.empty()) return false;
    queue.pop_front();
    ++handled;
    return true;
  };
  Crew crew;
  crew.add("sender", [&] {
    for (int i = 0; i < messages; ++i) {
      const std::lock_guard guard(lock);
      queue.push_back(i);
    }
    stop.store(true);
  });
  crew.add("worker", [&] {
    for (;;) {
      const bool stops = mended && stop.load();
      if (handle()) continue;
      if (mended ? stops : stop.load()) break;
      this_thread::yield();
    }
  });
  crew.join();
  check(handled == messages, "the last message is lost");
}

}  // namespace

Specimens endings() {
  return {{"last message", last_message<false>, last_message<true>, 2, "ending"},
          {"stop between", stop_between<false>, stop_between<true>, 2, "ending"},
          {"promise kept twice", promise_kept_twice<false>, promise_kept_twice<true>, 1, "ending"},
          {"cancel against complete", cancel_against_complete<false>, cancel_against_complete<true>, 1, "ending"},
          {"freed in use", freed_in_use<false>, freed_in_use<true>, 1, "ending"},
          {"closed too early", closed_too_early<false>, closed_too_early<true>, 1, "ending"}};
}

}  // namespace waitpoint::zoo
