// SPDX-License-Identifier: BSD-3-Clause
// The module classes known to a program, by the type names that scenarios use: made by module_type() of module.hpp.
#pragma once

#include <memory>
#include <string>
#include <vector>

namespace waitpoint::genom {

class Module;
struct ModuleSetup;

struct ModuleType {
  std::string name;
  std::unique_ptr<Module> (*make)(ModuleSetup& setup);
};

}  // namespace waitpoint::genom
