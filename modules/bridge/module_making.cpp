// SPDX-License-Identifier: BSD-3-Clause
#include "modules/bridge/module_making.hpp"

#include <algorithm>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "core/doing.hpp"
#include "core/exception_text.hpp"
#include "core/nearest_name.hpp"
#include "core/process_state.hpp"

namespace waitpoint::bridge {

std::unique_ptr<genom::Module> make_module(const scenario::ModuleScenario& module,
                                           std::span<const genom::ModuleType> types, const std::string& robot,
                                           genom::ModuleSetup& setup) {
  const auto type = std::find_if(types.begin(), types.end(), [&](const auto& t) { return t.name == module.type; });
  if (type == types.end()) {
    std::vector<std::string_view> known;
    for (const genom::ModuleType& t : types) known.push_back(t.name);
    throw module.written.bad("unknown module type '" + module.type + "'" +
                             did_you_mean_or_expected(module.type, known));
  }
  const std::string doing = "constructing module " + module.name + " of robot " + robot;
  const Doing construction(doing.c_str());
  const ProcessStateKept surroundings(doing.c_str());
  // Errors of settings have a line of their own; others get the module's.
  try {
    std::unique_ptr<genom::Module> made = type->make(setup);
    setup.settings.check_all_used();
    made->check_costs(setup.settings);
    return made;
  } catch (const BadInput& error) {
    if (error.line() > 0 || error.file().starts_with("--set")) throw;
    throw module.written.bad(error.what());
  } catch (const std::exception& error) {
    throw std::runtime_error(doing + " threw an exception: " + exception_text(error));
  } catch (...) {
    throw std::runtime_error(doing + " threw an exception of unknown type");
  }
}

}  // namespace waitpoint::bridge
