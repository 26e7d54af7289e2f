// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/exec/misuse_log.hpp"

#include <unwind.h>

#include <algorithm>
#include <new>

#include "fibers/kernel/scheduler.hpp"
#include "fibers/posix/exec/memory.hpp"
#include "fibers/posix/family/family.hpp"
#include "fibers/posix/family/misuse.hpp"
#include "fibers/posix/program/program.hpp"

namespace waitpoint::posix {
namespace {

constexpr std::size_t misuses_max = 100, frames_max = 32;

struct Frames {
  void* at[frames_max];
  std::size_t count = 0;
};

_Unwind_Reason_Code add_frame(_Unwind_Context* context, void* to) {
  Frames& frames = *static_cast<Frames*>(to);
  if (frames.count == frames_max) return _URC_END_OF_STACK;
  frames.at[frames.count++] = reinterpret_cast<void*>(_Unwind_GetIP(context));
  return _URC_NO_REASON;
}

void log(const char* sentence) {
  Frames frames;
  _Unwind_Backtrace(add_frame, &frames);
  const NewInFamily memory;
  void* const known = family::common(family::Part::misuses, 0);
  std::vector<LoggedMisuse>& all = static_cast<MisuseLog*>(known)->misuses;
  const auto is_same = [sentence](const LoggedMisuse& one) { return one.sentence == sentence; };
  if (all.size() == misuses_max || std::ranges::any_of(all, is_same)) return;
  LoggedMisuse& one = all.emplace_back(LoggedMisuse{sentence, kernel::running->local_time, {}});
  const std::string own = sync::code_place_of(reinterpret_cast<void*>(&log)).module;
  for (std::size_t i = 0; i < frames.count; ++i)
    if (sync::CodePlace place = sync::code_place_of(frames.at[i]); !place.module.empty() && place.module != own)
      one.calls.push_back(std::move(place));
}

}  // namespace

void begin_misuse_log() {
  if (family::common(family::Part::misuses, 0) == nullptr) {
    void* const memory = family::common(family::Part::misuses, sizeof(MisuseLog));
    if (memory == nullptr) refuse("there is no memory for the misuses of this run");
    new (memory) MisuseLog();
  }
  on_misuse = log;
}

}  // namespace waitpoint::posix
