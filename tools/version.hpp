// SPDX-License-Identifier: BSD-3-Clause
// What makes this build: when two digests differ, what --version prints is the first thing to compare.
#pragma once

#include <string>

namespace waitpoint::tools {

/// Lines of version, compiler, flags (WAITPOINT_VERSION and WAITPOINT_FLAGS, set by the build) and the fingerprint of
/// the exact math. Without a newline at the end.
std::string version_text();

}  // namespace waitpoint::tools
