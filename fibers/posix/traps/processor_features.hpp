// SPDX-License-Identifier: BSD-3-Clause
// What the processor says of itself (cpuid): it has no random numbers of its own (rdrand, rdseed), and the instruction
// runs on its first core. The instruction is trapped, where the system and the processor are able to.
#pragma once

namespace waitpoint::posix {

/// From now on the instruction is a fault; forked children inherit it. Without an effect in a debugger, which would
/// stop at each.
void trap_processor_features();
bool are_processor_features_trapped();
/// In a handler of SIGSEGV: true if it was that instruction, which is done then.
bool answer_processor_features(void* context);

}  // namespace waitpoint::posix
