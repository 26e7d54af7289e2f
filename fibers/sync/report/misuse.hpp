// SPDX-License-Identifier: BSD-3-Clause
// The words for the misuse of a primitive: the operation, the object and its holders.
//
//   WAITPOINT_REQUIRE(owner == running, sync::about(object, "a task unlocks a mutex that it does not hold"));
#pragma once

#include "core/error.hpp"

namespace waitpoint::kernel {
struct Object;
}

namespace waitpoint::sync {

/// `message` with the object's name and holders, for a failed check; the text is a static buffer.
const char* about(const kernel::Object& object, const char* message);

}  // namespace waitpoint::sync
