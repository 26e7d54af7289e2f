// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/reports/account.hpp"

#include <dlfcn.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>

#include "fibers/kernel/call_stack.hpp"
#include "fibers/posix/base/symbols.hpp"
#include "fibers/posix/family/family.hpp"
#include "fibers/posix/family/task_names.hpp"
#include "fibers/posix/program/program.hpp"
#include "fibers/posix/signals/signals.hpp"
#include "fibers/posix/threads/thread_states.hpp"

namespace waitpoint::posix {
namespace {

using family::Account;

// The call before the address that it returns to. False if it is the layer's own, or in no module.
bool locate(const void* return_address, Account::Place& place) {
  const auto* const call = static_cast<const char*>(return_address) - 1;
  static const char own = 0;
  Dl_info info{}, of_layer{};
  if (dladdr(call, &info) == 0 || info.dli_fname == nullptr) return false;
  if (dladdr(&own, &of_layer) != 0 && of_layer.dli_fbase == info.dli_fbase) return false;
  const char* function = nullptr;
  place.offset = function_at(call, function);
  std::snprintf(place.module, sizeof place.module, "%s", info.dli_fname);
  if (std::strcmp(info.dli_fname, program_invocation_name) == 0) {
    const ssize_t length = readlink("/proc/self/exe", place.module, sizeof place.module - 1);
    place.module[length > 0 ? length : 0] = '\0';
  }
  std::snprintf(place.function, sizeof place.function, "%s", function != nullptr ? function : "");
  return true;
}

// Runs in a handler, on top of the interrupted code.
void write_account() {
  if (family::family == nullptr || !record->began) return;
  Account& account = family::family->account;
  BoundedText text(account.states, sizeof account.states);
  add_states(text, record->scheduler());
  BoundedText running(account.running, sizeof account.running);
  account.place_count = 0;
  if (kernel::running != nullptr && is_thread(*kernel::running) && kernel::running->blocked_on == nullptr) {
    add_name(running, *kernel::running);
    constexpr std::size_t frames_max = 24;
    void* frames[frames_max];
    const std::size_t count = kernel::capture_call_stack(frames, frames_max);
    for (std::size_t i = 0; i < count && account.place_count < Account::places_max; ++i)
      if (locate(frames[i], account.places[account.place_count])) ++account.place_count;
  }
  account.is_written.store(true);
}

}  // namespace

void begin_to_answer() {
  answer_question = write_account;
  install_bell();
}

}  // namespace waitpoint::posix
