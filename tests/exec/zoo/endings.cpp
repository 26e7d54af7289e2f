// SPDX-License-Identifier: BSD-3-Clause
// Ends during ongoing work: stops, cancellations, results, last messages.
#include <array>
#include <atomic>
#include <condition_variable>
#include <deque>
#include <future>
#include <mutex>
#include <stop_token>

#include "tests/exec/zoo/crew.hpp"

// Needs the primitives declared above.
#include "tests/zoo/shared/endings.hpp"

namespace waitpoint::zoo {
namespace {

// The worker finds no message, and then that it should stop: the last message arrived in between. Mended, it checks the
// stop first.
template <bool mended>
void last_message(int) {
  constexpr int messages = 3;
  std::mutex lock, orders;
  std::deque<int> queue;
  bool stop = false;
  int handled = 0;
  const auto handle = [&] {
    const std::lock_guard guard(lock);
    if (queue.empty()) return false;
    queue.pop_front();
    ++handled;
    return true;
  };
  const auto is_stopped = [&] {
    const std::lock_guard guard(orders);
    return stop;
  };
  Crew crew;
  crew.add([&] {
    for (int i = 0; i < messages; ++i) {
      const std::lock_guard guard(lock);
      queue.push_back(i);
    }
    const std::lock_guard guard(orders);
    stop = true;
  });
  crew.add([&] {
    for (;;) {
      const bool stops = mended && is_stopped();
      if (handle()) continue;
      if (mended ? stops : is_stopped()) break;
      std::this_thread::yield();
    }
  });
  crew.join();
  check(handled == messages, "the last message is lost");
}

}  // namespace
}  // namespace waitpoint::zoo

using namespace waitpoint::zoo;

const specimen endings[] = {
    {"last message", SYNCHRONIZATION, 2, either<last_message<false>, last_message<true>>},
    {"stop between", SYNCHRONIZATION, 2, either<stop_between<false>, stop_between<true>>},
    {"promise kept twice", MEMORY, 2, either<promise_kept_twice<false>, promise_kept_twice<true>>},
    {"cancel against complete", MEMORY, 2, either<cancel_against_complete<false>, cancel_against_complete<true>>},
    {"freed in use", MEMORY, 2, either<freed_in_use<false>, freed_in_use<true>>},
    {"closed too early", MEMORY, 2, either<closed_too_early<false>, closed_too_early<true>>},
    {},
};
