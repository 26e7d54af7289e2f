// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/exec/program_calls.hpp"

#include <dlfcn.h>

#include <string>

#include "core/error.hpp"
#include "fibers/explore/report/reordered_events.hpp"
#include "fibers/kernel/visit.hpp"

namespace waitpoint::posix {

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

sync::CodePlaces program_calls(kernel::Task& task) {
  void* frames[exploration::frames_searched];
  const std::size_t count = kernel::call_stack(task, frames, exploration::frames_searched);
  WAITPOINT_CHECK(count <= exploration::frames_searched, "a call stack is longer than its room");
  return program_calls(std::span(frames, count));
}

}  // namespace waitpoint::posix
