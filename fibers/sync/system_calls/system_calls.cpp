// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/sync/system_calls/system_calls.hpp"

#include <dlfcn.h>
#include <sys/types.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdio>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/doing.hpp"
#include "core/spin_lock.hpp"
#include "fibers/kernel/call_stack.hpp"
#include "fibers/kernel/fault_reports.hpp"
#include "fibers/kernel/interruption.hpp"
#include "fibers/kernel/task.hpp"
#include "fibers/sync/report/source_lines.hpp"
#include "fibers/sync/system_calls/noted_calls.hpp"

namespace waitpoint::sync {
namespace {

constexpr std::size_t calls_max = 16, frames_searched = 24, frames_shown = 4;

struct Call {
  const char* function = nullptr;
  const char* effect = nullptr;  // null: a thread started outside of tasks
  const void* place = nullptr;
  char caller[3 * kernel::name_size] = {};
  std::optional<Time> time;  // absent outside of tasks
  void* frames[frames_searched] = {};
  std::size_t frame_count = 0;
};
// Of all threads. Kept without the heap: the caller may be an allocator, or on a task's small stack. A call that is
// counted does not change any more.
Call calls[calls_max];
std::atomic<bool> told[calls_max];
std::atomic<std::size_t> call_count = 0, told_count = 0;
SpinLock adding;
std::atomic<bool> are_collected = false, are_threads_noted = true;

/// The thread's own: its scopes in which calls are noted, their process, and if one has started a thread or process.
constinit thread_local std::uint32_t scopes = 0;
constinit thread_local pid_t process = 0;
constinit thread_local bool has_started = false;

bool is_known(const void* place) {
  return std::any_of(calls, calls + call_count, [&](const Call& call) { return call.place == place; });
}

void add(const Call& call) {
  const std::lock_guard guard(adding);
  if (call_count == calls_max || is_known(call.place)) return;
  calls[call_count] = call;
  ++call_count;
}

void note(const char* function, const char* effect, const void* place) {
  // Calls of a forked process are its own affair, as are those of a report's forked copy.
  if (scopes > 0 && process != getpid()) return;
  if (call_count == calls_max || is_known(place)) return;
  Call call;
  call.function = function;
  call.effect = effect;
  call.place = place;
  call.frame_count = kernel::capture_call_stack(call.frames, frames_searched);
  if (effect != nullptr) {
    const kernel::Task* const task = kernel::running;
    std::string caller = task != nullptr ? "task " : Doing::present();
    if (task != nullptr) caller.append(task->name).append(" of ").append(task->robot->name);
    caller.copy(call.caller, sizeof call.caller - 1);
    if (task != nullptr) call.time = task->local_time;
  }
  add(call);
}

/// The text of those calls that were in no text yet.
std::string text_of_new(bool outside) {
  std::vector<ReturnAddresses> stacks;
  std::vector<std::string> lines;
  for (std::size_t i = 0; i < call_count; ++i) {
    const Call& call = calls[i];
    if ((call.effect == nullptr) != outside || told[i].exchange(true)) continue;
    stacks.emplace_back(call.frames, call.frames + call.frame_count);
    lines.push_back(outside ? "a thread of the operating system was started outside of tasks; it is not repeatable"
                            : std::string(call.caller) + " calls " + call.function + "()" +
                                  (call.time ? " at " + to_string(*call.time) + " s: " : ": ") + call.effect);
  }
  if (lines.empty()) return "";
  const std::vector<std::vector<std::string>> places = user_source_lines(stacks, frames_shown);
  std::string text;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    text += "waitpoint: warning: ";
    text += lines[i] + "\n";
    for (const std::string& place : places[i]) text += "    at " + place + "\n";
  }
  return text;
}

}  // namespace

bool is_in_task() {
  return kernel::running != nullptr && scopes > 0 && !kernel::is_unwinding(*kernel::running->scheduler) &&
         !has_program_layer();
}

void note_start(const char* function, const void* place) {
  static constexpr char effect[] = "it runs in real time, and the run is not repeatable";
  const bool in_task = is_in_task();
  has_started = has_started || in_task;
  const bool in_module = kernel::running == nullptr && kernel::in_model_code() && !has_program_layer();
  if (in_task || in_module) note(function, effect, place);
}

void note_thread(const void* place) {
  if (is_in_task())
    note_start("pthread_create", place);
  else if (kernel::running == nullptr && !has_program_layer() && are_threads_noted)
    note("pthread_create", nullptr, place);
}

void note_wait(const char* function, const void* place) {
  if (is_in_task()) note(function, "it holds up all tasks of the run in real time", place);
}

SystemCalls::SystemCalls() {
  ++scopes;
  process = getpid();
}

SystemCalls::~SystemCalls() {
  --scopes;
  if (call_count == told_count || are_collected) return;
  tell_system_calls();
  told_count = call_count.load();
}

UnnotedThreads::UnnotedThreads() { are_threads_noted = false; }
UnnotedThreads::~UnnotedThreads() { are_threads_noted = true; }

void tell_system_calls() { std::fputs(text_of_new(false).c_str(), stderr); }
void tell_threads_outside() { std::fputs(text_of_new(true).c_str(), stderr); }
void collect_system_calls() { are_collected = true; }
std::string collected_system_calls() { return text_of_new(false); }
bool has_program_layer() {
  static const bool has = [] {
    Dl_info info{};
    void* const function = dlsym(RTLD_NEXT, "pthread_create");
    return function != nullptr && dladdr(function, &info) != 0 && info.dli_fname != nullptr &&
           std::string_view(info.dli_fname).find("libwaitpoint-in-process") != std::string_view::npos;
  }();
  return has;
}

bool has_started_outside_of_virtual_time() { return has_started; }
void forget_started() { has_started = false; }

}  // namespace waitpoint::sync
