// SPDX-License-Identifier: BSD-3-Clause
// The operation that a task announces at a waitpoint. Part of the digest: append new operations at the end.
#pragma once

#include <cstdint>

namespace waitpoint::kernel {

enum class Operation : std::uint8_t {
  start,    ///< a task's first event
  end,      ///< its last
  resume,   ///< woken from a block
  timeout,  ///< a finite timeout ran out
  yield,
  sleep,
  lock,
  try_lock,
  unlock,
  wait,
  notify_one,
  notify_all,
  acquire,
  try_acquire,
  release,
  join,
  timer_wait,
  timer_tick,
  step,  ///< the world's
  open,  ///< binds or opens a name
  close,
  connect,
  accept,
  send,
  receive,
  poll,
  timer_start,
  timer_stop,
  signal,  ///< a signal is sent
  lock_shared,
  try_lock_shared,
  unlock_shared,
  arrive,
  count_down,
  try_wait,
  request_stop,
  stop_requested,
  add_callback,
  remove_callback,
  make_ready,  ///< a future's shared state
  call_once,
  load,
  store,
  exchange,
  compare_exchange,
  modify,  ///< an atomic: fetch_add, fetch_or, ...
  fence,
  exit,  ///< of the process
  call,  ///< of a function that waits for nothing: what it reads and changes is its footprint
};

/// The operation's name, as reports and event files show it.
constexpr const char* name(Operation operation) {
  // clang-format off
  constexpr const char* names[] = {
      "start", "end", "resume", "timeout", "yield", "sleep",
      "lock", "try_lock", "unlock", "wait", "notify_one", "notify_all", "acquire", "try_acquire", "release", "join",
      "timer_wait", "timer_tick", "step",
      "open", "close", "connect", "accept", "send", "receive", "poll",
      "timer_start", "timer_stop", "signal",
      "lock_shared", "try_lock_shared", "unlock_shared", "arrive", "count_down", "try_wait",
      "request_stop", "stop_requested", "add_callback", "remove_callback", "make_ready", "call_once",
      "load", "store", "exchange", "compare_exchange", "modify", "fence",
      "exit", "call"};
  // clang-format on
  static_assert(sizeof names / sizeof *names == static_cast<int>(Operation::call) + 1);
  return names[static_cast<int>(operation)];
}

}  // namespace waitpoint::kernel
