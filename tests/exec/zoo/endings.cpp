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

namespace zoo {
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

// A stop that is asked for between the look at the token and the wait wakes nobody. Mended, it takes the lock.
template <bool mended>
void stop_between(int) {
  std::mutex lock;
  std::condition_variable work;
  std::stop_source source;
  Crew crew;
  crew.add([&] {
    source.request_stop();
    std::unique_lock guard(lock, std::defer_lock);
    if (mended) guard.lock();
    work.notify_all();
  });
  crew.add([&] {
    std::unique_lock guard(lock);
    while (!source.stop_requested()) work.wait(guard);
  });
  crew.join();
}

// Two answers to one request: each looks whether there is one yet.
template <bool mended>
void promise_kept_twice(int threads) {
  std::promise<int> answer;
  std::atomic<bool> given = false;
  Crew crew;
  for (int i = 0; i < threads; ++i)
    crew.add([&, i] {
      const bool was_given = mended ? given.exchange(true) : given.load();
      if (was_given) return;
      given.store(true);
      answer.set_value(i);
    });
  crew.join();
  answer.get_future().get();
}

// A request is completed while its client cancels it: both call it off, and its buffer is given back twice.
template <bool mended>
void cancel_against_complete(int) {
  enum State { pending, running, completed, cancelled };
  std::atomic<State> state = pending;
  std::atomic<int> given_back = 0;
  Crew crew;
  crew.add([&] {
    State seen = pending;
    if (!state.compare_exchange_strong(seen, running)) return;
    seen = running;
    if (mended && !state.compare_exchange_strong(seen, completed)) return;
    if (!mended) state.store(completed);
    given_back.fetch_add(1);
  });
  crew.add([&] {
    State seen = state.load();
    while (seen != completed && !state.compare_exchange_strong(seen, cancelled)) {
    }
    if (seen != completed) given_back.fetch_add(1);
  });
  crew.join();
  check(given_back.load() == 1, "the buffer is given back twice");
}

// Readers announce themselves after they have read which table is in use; the old one is freed when nobody is there.
template <bool mended>
void freed_in_use(int) {
  std::array<std::atomic<bool>, 2> freed{};
  std::array<std::atomic<int>, 2> readers{};
  std::atomic<std::size_t> used = 0;
  Crew crew;
  crew.add([&] {
    std::size_t table = used.load();
    readers[table].fetch_add(1);
    while (mended && table != used.load()) {
      readers[table].fetch_sub(1);
      table = used.load();
      readers[table].fetch_add(1);
    }
    check(!freed[table].load(), "a table is read that is freed");
    readers[table].fetch_sub(1);
  });
  crew.add([&] {
    used.store(1);
    while (readers[0].load() != 0) std::this_thread::yield();
    freed[0].store(true);
  });
  crew.join();
}

// A pool closes as soon as no job is open; a job that makes another one closes itself first.
template <bool mended>
void closed_too_early(int) {
  std::atomic<int> open = 1;
  std::atomic<bool> closed = false;
  Crew crew;
  crew.add([&] {
    for (int i = 0; i < 3; ++i) {
      if (mended) open.fetch_add(1);
      open.fetch_sub(1);
      if (!mended) open.fetch_add(1);
      check(!closed.load(), "a job comes to a pool that is closed");
    }
    open.fetch_sub(1);
  });
  crew.add([&] {
    while (open.load() != 0) std::this_thread::yield();
    closed.store(true);
  });
  crew.join();
}

}  // namespace
}  // namespace zoo

using namespace zoo;

const specimen endings[] = {
    {"last message", SYNCHRONIZATION, 2, either<last_message<false>, last_message<true>>},
    {"stop between", SYNCHRONIZATION, 2, either<stop_between<false>, stop_between<true>>},
    {"promise kept twice", MEMORY, 2, either<promise_kept_twice<false>, promise_kept_twice<true>>},
    {"cancel against complete", MEMORY, 2, either<cancel_against_complete<false>, cancel_against_complete<true>>},
    {"freed in use", MEMORY, 2, either<freed_in_use<false>, freed_in_use<true>>},
    {"closed too early", MEMORY, 2, either<closed_too_early<false>, closed_too_early<true>>},
    {},
};
