// SPDX-License-Identifier: BSD-3-Clause
// The whole `waitpoint` program as one call, for programs with modules of their own:
//
//   int main(int argc, char** argv) {
//     return waitpoint::main(argc, argv, {waitpoint::genom::module_type<Blinker>("blinker")});
//   }
//
// Linked with waitpoint-robots it simulates; linked with waitpoint-robots-native, with WAITPOINT_REAL_THREADS defined,
// the same program runs its modules on system threads: `run` with --set, --seed and --until.
#pragma once

#include <vector>

#include "modules/genom/module.hpp"

namespace waitpoint {

/// Executes the command line. Scenarios may use the paper's modules and those of `own` by name; a module of `own`
/// replaces the paper's module of the same name. Returns the exit status. With --confined the process stays confined.
int main(int argc, const char* const* argv, std::vector<genom::ModuleType> own = {});

}  // namespace waitpoint
