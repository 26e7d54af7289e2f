// SPDX-License-Identifier: BSD-3-Clause
// The module classes known to a program, by the type names that scenarios use.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "modules/genom/module.hpp"

namespace waitpoint::genom {

struct ModuleType {
  std::string name;
  std::unique_ptr<Module> (*make)(ModuleSetup& setup);
};

/// Registers a module class, constructible from ModuleSetup&, under a name.
template <class M>
ModuleType module_type(std::string name) {
  return {std::move(name), [](ModuleSetup& setup) -> std::unique_ptr<Module> {
            auto module = std::make_unique<M>(setup);
            static_cast<Module&>(*module).size_ = sizeof(M);
            return module;
          }};
}

}  // namespace waitpoint::genom
