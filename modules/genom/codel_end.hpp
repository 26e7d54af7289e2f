// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "core/process_state.hpp"
#include "fibers/sync/threads.hpp"
#include "modules/genom/module_data.hpp"

namespace waitpoint::genom {

/// After a codel, unless it threw an exception: the code that follows has the standard surroundings.
inline void end_codel(const ModuleData& module, const char* what, const std::string& of) {
  threads::this_thread::set_work(nullptr, "");
  restore_after_codel([&] { return what + (" of " + of) + " of module " + module.name; });
}

}  // namespace waitpoint::genom
