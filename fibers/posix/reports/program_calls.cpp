// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/reports/program_calls.hpp"

#include <dlfcn.h>

#include <optional>
#include <string>

#include "fibers/explore/report/reordered_events.hpp"
#include "fibers/kernel/call_stack.hpp"
#include "fibers/kernel/visit.hpp"
#include "fibers/posix/program/program.hpp"

namespace waitpoint::posix {
namespace {

constexpr std::size_t frames_of_running_max = 64;

struct StackVisit : kernel::Visit {
  void* frames[exploration::frames_searched];
  std::size_t count = 0;
};

// Of the running thread. The search for handlers of exceptions takes locks, which are waitpoints in the program's code.
std::size_t capture(std::span<void*> frames) {
  std::optional<InKernel> within;
  if (is_simulated()) within.emplace();
  return kernel::capture_call_stack(frames.data(), frames.size());
}

// At an access to memory a task is in the program's code, too.
void capture_stack(kernel::Visit& visit) {
  auto& request = static_cast<StackVisit&>(visit);
  request.count = capture(request.frames);
}

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
  void* frames[frames_of_running_max];
  return program_calls({frames, capture(frames)});
}

sync::CodePlaces program_calls(kernel::Task& task) {
  if (task.sequence == 0) return {};
  StackVisit request;
  request.act = capture_stack;
  kernel::visit(task, request);
  return program_calls(std::span(request.frames, request.count));
}

}  // namespace waitpoint::posix
