// SPDX-License-Identifier: BSD-3-Clause
// The processes of a run, as the process that watches it sees them.
#pragma once

#include <cstdint>
#include <string>

#include "core/digest.hpp"
#include "fibers/posix/family/family.hpp"
#include "fibers/posix/program/record.hpp"

namespace waitpoint::tools {

/// What the processes share for a part of the layer; null if they have used none.
const void* common_of(const posix::Record& record, posix::family::Part part);
/// The digest of all processes.
Digest digest_of(const posix::Record& record);
/// "2 processes, 3 threads, 2 at once, 40 events, 12 switches, 0.5 s of virtual time".
std::string counts_of(const posix::Record& record);
/// After the end of the first process: waits for the others, and kills those that are left when the run is over.
void end_others(const posix::Record& record);

}  // namespace waitpoint::tools
