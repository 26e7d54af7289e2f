// SPDX-License-Identifier: BSD-3-Clause
// Threads, in the names and semantics of std::thread, as fibers of the running simulation.
//
// A thread belongs to the robot of the task that makes it. An exception that escapes its function ends the run and is
// rethrown by the call that runs it. Joining oneself is reported as a self-deadlock; joining or detaching a thread that
// is not joinable is a misuse.
#pragma once

#include <functional>
#include <iosfwd>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "fibers/clocks/task_clock.hpp"
#include "fibers/kernel/spawn_options.hpp"
#include "fibers/kernel/waitpoint_calls.hpp"
#include "fibers/sync/call.hpp"
#include "fibers/sync/clock.hpp"
#include "fibers/sync/local_values.hpp"
#include "fibers/sync/processor.hpp"

namespace waitpoint {

/// Attributes beyond std::thread's interface.
struct thread_attributes {
  const char* name = "thread";
  kernel::StackSize stack = kernel::StackSize::medium;
  bool service = false;  ///< does not keep the run alive
  /// The local clock, i.e. how computing moves local virtual time; not inherited by child threads.
  kernel::ClockOptions clock = {};
  /// The shared processor, null for one of its own; and the priority there, the greater the more urgent.
  processor* on = nullptr;
  int priority = 0;
};
/// The default attributes.
inline constexpr thread_attributes plain_thread;

enum class signal_sent : std::uint8_t;

namespace sync {

struct TaskSignals;

/// Shared by a thread's handle and its task; destroyed with the later of the two.
struct ThreadState {
  std::unique_ptr<Call> call;          ///< null once the function has begun
  std::shared_ptr<ThreadState> share;  ///< the task's own reference, until it ends
  kernel::Object ended{"end of thread"};
  kernel::Task* task = nullptr;  ///< null once the task has ended
  std::optional<kernel::TaskClock> clock;
  std::optional<kernel::Seat> seat;
  bool run_over = false;  ///< ended with its run: nothing to join
  std::uint64_t id = 0;
  std::shared_ptr<TaskSignals> signals;       ///< null until its first use of signals
  LocalValues locals;                         ///< see fiber_local.hpp
  std::vector<std::function<void()>> at_end;  ///< the shared states to make ready at the thread's end
};

/// A thread's processor and clock, beyond those of any task.
struct Computing {
  kernel::ClockOptions clock;
  processor* on = nullptr;
  int priority = 0;
};

/// Creates a task of `robot` that runs `call`; std::system_error if no more can be created.
std::shared_ptr<ThreadState> start_thread(kernel::Scheduler& scheduler, kernel::Robot& robot,
                                          kernel::SpawnOptions options, std::unique_ptr<Call> call,
                                          const Computing& computing = {});

/// The state of the thread of `task`; null once its function has returned, and for tasks that are not threads.
ThreadState* thread_of(const kernel::Task& task);
/// The values of the running task; calling it outside a thread is a misuse.
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
  /// As std::thread: must not be joinable. While a run is unwound, and after it, the thread is detached.
  ~thread();

  bool joinable() const noexcept { return state_ != nullptr && !state_->run_over; }
  void join();
  /// False if the thread has not ended by the deadline; it remains joinable. The standard has no timed join.
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
  /// The declared SimulationOptions::hardware_concurrency, never the machine's; 0 outside any task.
  static unsigned hardware_concurrency() noexcept;
  void swap(thread& other) noexcept { state_.swap(other.state_); }
  friend void swap(thread& a, thread& b) noexcept { a.swap(b); }

  /// For destructors: joins if joinable; detaches without a throw if the run is over.
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

/// Declares the memory that the caller touches at each turn; it must stay valid until the caller ends or sets another.
inline void set_working_set(const WorkingSet& set) {
  kernel::Task& task = sync::running_task();
  task.working_set = set.lines().data();
  task.working_set_size = static_cast<std::uint32_t>(set.lines().size());
}

/// Declares what the caller executes, for reports (kernel::Work); the texts must outlive it.
inline void set_work(const char* what, const char* of) { sync::running_task().work = {what, of}; }

/// Moves the caller behind all tasks of this instant.
inline void yield() {
  if (!kernel::yield(*sync::running_task().scheduler)) sync::unwind();
}

[[gnu::always_inline]] inline void sleep_until(Time time) {
  if (!kernel::sleep_until(*sync::running_task().scheduler, time)) sync::unwind();
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
