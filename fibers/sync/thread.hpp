// SPDX-License-Identifier: BSD-3-Clause
// Threads, in the names and semantics of std::thread, as fibers of the running simulation.
//
// A thread belongs to the robot of the task that makes it. An exception that escapes its function ends the run and is
// rethrown by the call that runs it. Joining oneself is a deadlock of one, and reported as such; joining or detaching
// what is not joinable is a bug.
#pragma once

#include <functional>
#include <iosfwd>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "fibers/clocks/task_clock.hpp"
#include "fibers/sync/call.hpp"
#include "fibers/sync/clock.hpp"
#include "fibers/sync/local_values.hpp"
#include "fibers/sync/processor.hpp"

namespace waitpoint {

/// What std::thread cannot be told.
struct thread_attributes {
  const char* name = "thread";
  kernel::StackSize stack = kernel::StackSize::medium;
  bool service = false;  ///< does not keep the run alive
  /// How its local virtual time moves while it computes; its children do not inherit it.
  kernel::ClockOptions clock = {};
  /// The processor that it shares with others, null for one of its own; and its priority there, the greater the more
  /// urgent.
  processor* on = nullptr;
  int priority = 0;
};
/// Of a thread of which nothing else was said.
inline constexpr thread_attributes plain_thread;

enum class signal_sent : std::uint8_t;

namespace sync {

struct TaskSignals;

/// What a thread's handle and its task share; it lives until both are gone.
struct ThreadState {
  std::unique_ptr<Call> call;          ///< null once it began
  std::shared_ptr<ThreadState> share;  ///< the task's, until it ends
  kernel::Object ended{"end of thread"};
  kernel::Task* task = nullptr;  ///< null once it ended
  std::optional<kernel::TaskClock> clock;
  std::optional<kernel::Seat> seat;
  bool run_over = false;  ///< ended with its run: there is nothing to join
  std::uint64_t id = 0;
  std::shared_ptr<TaskSignals> signals;       ///< null until it has to do with one
  LocalValues locals;                         ///< see fiber_local.hpp
  std::vector<std::function<void()>> at_end;  ///< what is made ready when the thread has ended
};

/// How a thread computes, beside what every task has.
struct Computing {
  kernel::ClockOptions clock;
  processor* on = nullptr;
  int priority = 0;
};

/// Makes a task of `robot` that runs `call`; std::system_error where no more can be had.
std::shared_ptr<ThreadState> start_thread(kernel::Scheduler& scheduler, kernel::Robot& robot,
                                          kernel::SpawnOptions options, std::unique_ptr<Call> call,
                                          const Computing& computing = {});

/// The state of the thread that `task` is; null once its function has returned, and for a task that is no thread.
ThreadState* thread_of(const kernel::Task& task);
/// The values of the running task; not to be within a thread is a bug.
LocalValues& values_of_running_task();

}  // namespace sync

class thread {
 public:
  class id {
   public:
    constexpr id() = default;
    explicit constexpr id(std::uint64_t value) : value_(value) {}
    friend constexpr auto operator<=>(id, id) = default;
    /// Sixteen hexadecimal digits: the same in every run.
    friend std::ostream& operator<<(std::ostream& out, id of);

   private:
    friend struct std::hash<id>;
    std::uint64_t value_ = 0;
  };

  using native_handle_type = kernel::Task*;

  thread() = default;
  template <class Function, class... Arguments>
  requires(!std::is_same_v<std::remove_cvref_t<Function>, thread> &&
           !std::is_same_v<std::remove_cvref_t<Function>, thread_attributes>) explicit thread(Function&& function,
                                                                                              Arguments&&... arguments)
      : thread(plain_thread, std::forward<Function>(function), std::forward<Arguments>(arguments)...) {}
  template <class Function, class... Arguments>
  thread(const thread_attributes& attributes, Function&& function, Arguments&&... arguments)
      : state_(start(attributes,
                     sync::make_call(std::forward<Function>(function), std::forward<Arguments>(arguments)...))) {}
  thread(thread&& other) noexcept = default;
  /// As std::thread: the target must not be joinable, or the program ends.
  thread& operator=(thread&& other) noexcept;
  /// As std::thread: must not be joinable. While a run is unwound, and after it, the thread is let go.
  ~thread();

  bool joinable() const noexcept { return state_ != nullptr && !state_->run_over; }
  void join();
  /// False if the thread has not ended when the time has come; it is joinable still. The standard has no timed join.
  template <class Rep, class Ratio>
  bool try_join_for(const std::chrono::duration<Rep, Ratio>& span) {
    return join_before(sync::after(span));
  }
  template <class Clock, class Span>
  bool try_join_until(const std::chrono::time_point<Clock, Span>& deadline) {
    return join_before(sync::until(deadline));
  }
  void detach();
  id get_id() const noexcept { return state_ ? id(state_->id) : id(); }
  /// The kernel's record; null once the thread has ended.
  native_handle_type native_handle() const noexcept { return state_ ? state_->task : nullptr; }
  /// A declared number, SimulationOptions::hardware_concurrency, never that of the machine; 0 outside any task.
  static unsigned hardware_concurrency() noexcept;
  void swap(thread& other) noexcept { state_.swap(other.state_); }
  friend void swap(thread& a, thread& b) noexcept { a.swap(b); }

  /// For destructors: waits for the end if there is something to join, and when the run is over lets go without a
  /// throw.
  void await_end() noexcept;

 private:
  friend signal_sent send_signal(const thread& to, int signal);
  bool join_before(Time deadline);
  static std::shared_ptr<sync::ThreadState> start(const thread_attributes& attributes,
                                                  std::unique_ptr<sync::Call> call);

  std::shared_ptr<sync::ThreadState> state_;
};

namespace this_thread {

inline thread::id get_id() { return thread::id(sync::running_task().id); }

/// Tells what the caller touches whenever it runs; that is to stay until it has ended, or been told anew.
inline void set_working_set(const WorkingSet& set) {
  kernel::Task& task = sync::running_task();
  task.working_set = set.lines().data();
  task.working_set_size = static_cast<std::uint32_t>(set.lines().size());
}

/// Goes behind all tasks of this instant.
inline void yield() {
  if (!sync::running_task().scheduler->yield()) sync::unwind();
}

[[gnu::always_inline]] inline void sleep_until(Time time) {
  if (!sync::running_task().scheduler->sleep_until(time)) sync::unwind();
}
template <class Clock, class Span>
[[gnu::always_inline]] inline void sleep_until(const std::chrono::time_point<Clock, Span>& time) {
  sleep_until(sync::until(time));
}
template <class Rep, class Ratio>
[[gnu::always_inline]] inline void sleep_for(const std::chrono::duration<Rep, Ratio>& span) {
  sleep_until(sync::after(span));
}
inline void sleep_for(Duration span) { sleep_for(std::chrono::nanoseconds(span.ns())); }

}  // namespace this_thread
}  // namespace waitpoint

template <>
struct std::hash<waitpoint::thread::id> {
  std::size_t operator()(waitpoint::thread::id id) const noexcept { return id.value_; }
};
