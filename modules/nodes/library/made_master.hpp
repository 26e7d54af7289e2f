// SPDX-License-Identifier: BSD-3-Clause
// The master of a run: inside, or Debian's.
#pragma once

#include <memory>

#include "modules/nodes/library/used_master.hpp"

namespace waitpoint::nodes {

/// Throws std::runtime_error if there is no port for it, or if Debian's does not start.
std::unique_ptr<UsedMaster> make_master(bool is_of_debian);

}  // namespace waitpoint::nodes
