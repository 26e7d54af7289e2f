// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/reports/program_calls.hpp"

#include <dlfcn.h>

#include <optional>
#include <string>

#include "core/error.hpp"
#include "fibers/explore/report/reordered_events.hpp"
#include "fibers/kernel/call_stack.hpp"
#include "fibers/kernel/visit.hpp"
#include "fibers/posix/program/program.hpp"

namespace waitpoint::posix {
namespace {

constexpr std::size_t frames_of_running_max = 64;

}  // namespace

sync::CodePlaces program_calls(std::span<void* const> frames) {
  Dl_info layer{};
  const bool is_known =
      dladdr(reinterpret_cast<void*>(static_cast<sync::CodePlaces (*)(kernel::Task&)>(program_calls)), &layer) != 0;
  const std::string own = is_known ? layer.dli_fname : "";
  sync::CodePlaces calls;
  for (void* const frame : frames)
    if (sync::CodePlace place = sync::code_place_of(frame); !place.module.empty() && place.module != own)
      calls.push_back(std::move(place));
  return calls;
}

sync::CodePlaces running_calls() {
  std::optional<InKernel> within;  // the search for handlers of exceptions takes locks
  if (is_simulated()) within.emplace();
  void* frames[frames_of_running_max];
  return program_calls({frames, kernel::capture_call_stack(frames, frames_of_running_max)});
}

sync::CodePlaces program_calls(kernel::Task& task) {
  void* frames[exploration::frames_searched];
  const std::size_t count = kernel::call_stack(task, frames, exploration::frames_searched);
  WAITPOINT_CHECK(count <= exploration::frames_searched, "a call stack is longer than its room");
  return program_calls(std::span(frames, count));
}

}  // namespace waitpoint::posix
