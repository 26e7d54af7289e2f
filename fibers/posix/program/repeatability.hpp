// SPDX-License-Identifier: BSD-3-Clause
// What does not follow from the seed, and cannot be simulated: with --strict its use ends the run.
#pragma once

namespace waitpoint::posix {

/// The running thread uses `source`: with --strict, the run ends with its name and the place in the program. Without an
/// effect otherwise, and outside of the program's threads.
void note_unrepeatable(const char* source);

}  // namespace waitpoint::posix
