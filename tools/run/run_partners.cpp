// SPDX-License-Identifier: BSD-3-Clause
#include "tools/run/run_partners.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "core/nearest_name.hpp"
#include "modules/outside/report_source.hpp"
#include "modules/outside/world_server.hpp"
#include "modules/run/intervention.hpp"

namespace waitpoint::tools {
namespace {

void check_robot(const std::string& name, const scenario::Scenario& scenario, const std::string& where) {
  std::string known;
  for (const scenario::RobotScenario& robot : scenario.robots) {
    if (robot.name == name) return;
    known += (known.empty() ? "" : ", ") + robot.name;
  }
  throw BadInput(where, "expected a robot of the scenario (" + known + "), found '" + name + "'");
}

/// All settings, so that a journal does not depend on the defaults of the version that repeats it.
std::string declaration(const std::string& given, const std::string& where) {
  const run::Intervention read = run::parse_intervention("external robot" + given, {where, 0});
  const run::ExternalSettings& settings = std::get<run::ExternalDeclaration>(read.what).settings;
  return fmt::format(" between={} jump_m={} silent_s={} late_s={}", settings.between, settings.jump_m,
                     settings.silent_s.seconds(), settings.late_s.seconds());
}

}  // namespace

outside::Partners make_partners(const PartnerOptions& options, const scenario::Scenario& scenario) {
  outside::Partners partners;
  std::vector<std::string> names;
  for (const std::string& text : options.external) {
    const std::string where = "--external";
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos || equals == 0)
      throw BadInput(where, "expected ROBOT=unix:PATH or ROBOT=tcp:PORT, found '" + text + "'");
    const std::string name = text.substr(0, equals);
    check_robot(name, scenario, where);
    if (std::find(names.begin(), names.end(), name) != names.end())
      throw BadInput(where, "expected each robot once, found '" + name + "' twice");
    if (scenario.engine == world::Engine::bullet)
      throw BadInput(where, "expected engine fcl or slice: bodies of a dynamic world are moved by forces");
    names.push_back(name);
    const std::size_t end = std::min(text.find(' ', equals), text.size());
    const outside::Endpoint endpoint = outside::parse_endpoint(text.substr(equals + 1, end - equals - 1), where);
    partners.add(std::make_unique<outside::ReportSource>(name, endpoint, declaration(text.substr(end), where), where));
  }
  if (options.serve_world.empty()) return partners;
  const std::string where = "--serve-world";
  const outside::Endpoint endpoint = outside::parse_endpoint(options.serve_world, where);
  partners.add(std::make_unique<outside::WorldServer>(scenario, names, endpoint, where));
  return partners;
}

}  // namespace waitpoint::tools
