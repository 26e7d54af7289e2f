// SPDX-License-Identifier: BSD-3-Clause
#include "modules/nodes/node_waits.hpp"

#include <dlfcn.h>
#include <fmt/format.h>

#include <algorithm>

#include "core/lasting_wait.hpp"

namespace waitpoint::nodes {
namespace {

// Null without the layer.
template <class Function>
Function* of_layer(const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_DEFAULT, name));
}

std::vector<std::string> lasting(Duration least, bool reported_only) {
  std::vector<std::string> lines;
  auto* const next = of_layer<NextWait>(next_wait);
  LastingWait wait{};
  for (int place = 0; next != nullptr && (place = next(place, &wait)) >= 0;) {
    const Duration lasts = Duration::from_ns(wait.lasts_ns);
    if (lasts < least || (reported_only && !wait.is_told)) continue;
    lines.push_back(fmt::format("{} waits for {}, for {:.3f} s", wait.thread, wait.what, lasts.seconds()));
  }
  std::sort(lines.begin(), lines.end());  // places are those of the order in which they began
  return lines;
}

}  // namespace

void watch_waits() {
  if (auto* const begin = of_layer<NoteWaits>(note_waits); begin != nullptr) begin();
}

std::vector<std::string> waits_longer_than(Duration least) { return lasting(least, false); }
std::vector<std::string> calls_longer_than(Duration least) { return lasting(least, true); }

}  // namespace waitpoint::nodes
