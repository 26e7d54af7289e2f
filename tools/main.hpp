// SPDX-License-Identifier: BSD-3-Clause
// The whole of the `waitpoint` program as one call, for programs with modules of their own:
//
//   int main(int argc, char** argv) {
//     return waitpoint::main(argc, argv, {waitpoint::genom::module_type<Blinker>("blinker")});
//   }
//
// Linked with waitpoint-robots it simulates; with waitpoint-robots-native, and WAITPOINT_REAL_THREADS defined, the same
// program runs its modules on the threads of the system: `run` with --set, --seed and --until.
#pragma once

#include <vector>

#include "modules/genom/module_type.hpp"

namespace waitpoint {

/// Does what the arguments say, with the modules of the paper and those of `own`, which scenarios may use by their
/// names; one of `own` takes the place of the paper's of that name. Returns the exit status.
int main(int argc, const char* const* argv, std::vector<genom::ModuleType> own = {});

}  // namespace waitpoint
