// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/kernel/process_end.hpp"

#include <sys/syscall.h>
#include <unistd.h>

#include <ctime>
#include <mutex>

#include "core/spin_lock.hpp"
#include "fibers/kernel/scheduler.hpp"
#include "fibers/kernel/turn.hpp"

namespace waitpoint::kernel {
namespace {

constexpr int stop_wait_ms = 300;

std::atomic<const void*> owner = nullptr;  // of the end, by its thread pointer
std::atomic<const void*> dying_thread = nullptr;
std::atomic<pid_t> process = 0;
std::atomic<bool> has_committed = false;

/// The status that the main thread returns, and that of the exit which has begun.
constexpr int no_status = -1;
std::atomic<const void*> main_thread = nullptr;
std::atomic<int> returned_status = no_status, exit_status = no_status;

SpinLock lock;
TaskThread* first_thread = nullptr;
constinit thread_local TaskThread* own_thread = nullptr;

const void* self() { return __builtin_thread_pointer(); }

// The C library's function is noted as a task's wait in real time.
void wait_ms() {
  const timespec millisecond{.tv_sec = 0, .tv_nsec = 1'000'000};
  syscall(SYS_nanosleep, &millisecond, nullptr);
}

/// Returns with the end; true if the thread had it before.
bool take_end() {
  for (;;) {
    const void* had = nullptr;
    if (owner.compare_exchange_strong(had, self())) return false;
    if (had == self()) return true;
    wait_ms();
  }
}

}  // namespace

TaskThread::TaskThread() : turn_(&turn) {
  process = getpid();
  own_thread = this;
  const std::lock_guard guard(lock);
  next_ = first_thread;
  first_thread = this;
}

TaskThread::~TaskThread() {
  own_thread = nullptr;
  const std::lock_guard guard(lock);
  TaskThread** at = &first_thread;
  while (*at != this) at = &(*at)->next_;
  *at = next_;
}

void TaskThread::set_scheduler(Scheduler* scheduler) {
  process = getpid();
  const std::lock_guard guard(lock);
  scheduler_ = scheduler;
}

bool TaskThread::is_one(pthread_t thread) {
  const std::lock_guard guard(lock);
  const TaskThread* at = first_thread;
  while (at != nullptr && pthread_equal(at->id_, thread) == 0) at = at->next_;
  return at != nullptr;
}

// Writes what pause() writes, from another thread: each variable is read anew at each event. False if a thread is still
// on its way to one.
bool TaskThread::ask_all_to_stop() {
  const std::lock_guard guard(lock);
  bool have_stopped = true;
  for (TaskThread* at = first_thread; at != nullptr; at = at->next_) {
    if (at == own_thread || at->scheduler_ == nullptr || at->has_stopped_) continue;
    have_stopped = false;
    std::atomic_ref(at->scheduler_->agenda.until).store(Time(), std::memory_order_relaxed);
    at->scheduler_->fast_path.allow_short_cuts(false);
    std::atomic_ref(at->turn_->at).store(Turn::never, std::memory_order_relaxed);
    std::atomic_ref(at->turn_->fast_epoch).store(Turn::no_epoch, std::memory_order_relaxed);
  }
  return have_stopped;
}

bool is_process_of_tasks() { return process == getpid(); }

void begin_death() {
  if (!is_process_of_tasks() || dying_thread == self()) return;
  take_end();
  dying_thread = self();
  // Again and again: a thread may be about to overwrite a variable.
  for (int waited_ms = 0; waited_ms < stop_wait_ms && !TaskThread::ask_all_to_stop(); ++waited_ms) wait_ms();
}

void wait_if_dying() {
  if (const void* const dying = dying_thread; dying == nullptr || dying == self() || !is_process_of_tasks()) return;
  if (own_thread != nullptr) own_thread->has_stopped_ = true;
  for (;;) ::pause();
}

Commit::Commit() : is_inner_(!is_process_of_tasks() || take_end()) { has_committed = true; }
Commit::~Commit() {
  if (!is_inner_) owner = nullptr;
}
bool Commit::has_begun() { return has_committed; }

void set_exit_status(int status) {
  main_thread = self();
  returned_status = status;
}

int settle_exit_status(int status) {
  if (!is_process_of_tasks()) return status;
  if (const auto begun = begun_exit_status()) return *begun;
  take_end();
  if (dying_thread == self() || returned_status == no_status) return status;
  exit_status = main_thread == self() ? status : returned_status.load();
  return exit_status;
}

std::optional<int> begun_exit_status() {
  if (const int status = exit_status; status != no_status && is_process_of_tasks()) return status;
  return std::nullopt;
}

}  // namespace waitpoint::kernel
