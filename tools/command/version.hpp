// SPDX-License-Identifier: BSD-3-Clause
// The identity of this build: when two digests differ, compare the outputs of --version first.
#pragma once

#include <string>

namespace waitpoint::tools {

/// Version, format of digests, compiler, flags (WAITPOINT_VERSION and WAITPOINT_FLAGS, set by the build) and the
/// fingerprint of the exact math, one per line. No trailing newline.
std::string version_text();

/// Its first line, the version.
std::string version_line();

/// The same as a document of JSON (docs/json.md). No trailing newline.
std::string version_json();

}  // namespace waitpoint::tools
