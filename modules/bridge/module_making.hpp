// SPDX-License-Identifier: BSD-3-Clause
// Makes a robot's module from what a scenario says of it.
#pragma once

#include <memory>
#include <span>
#include <string>

#include "modules/genom/module.hpp"
#include "modules/scenario/scenario.hpp"

namespace waitpoint::bridge {

/// BadInput at the module's line, or at that of a setting, for an unknown type and for settings that the module does
/// not accept; other exceptions of its constructor are a failure that names module and robot. `setup` has the module's
/// settings.
std::unique_ptr<genom::Module> make_module(const scenario::ModuleScenario& module,
                                           std::span<const genom::ModuleType> types, const std::string& robot,
                                           genom::ModuleSetup& setup);

}  // namespace waitpoint::bridge
