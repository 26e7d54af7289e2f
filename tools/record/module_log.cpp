// SPDX-License-Identifier: BSD-3-Clause
#include "tools/record/module_log.hpp"

#include <fmt/format.h>

#include <utility>

#include "modules/genom/module.hpp"

namespace waitpoint::tools {
namespace {

std::string words_of_report(genom::Report report) {
  const std::string name = genom::name(report);
  return genom::code_of(report) < genom::first_own_report ? name : fmt::format("{} {}", name, genom::code_of(report));
}

std::string words_of_report(const genom::ModuleEvent& event) {
  const std::string& request = event.request.name;
  if (event.kind == genom::LetterKind::request) return request + ": asked";
  const std::string what = event.activity < 0 ? request + ":" : fmt::format("{}: activity {}", request, event.activity);
  if (event.kind == genom::LetterKind::intermediate_reply) return what + " started";
  if (event.activity >= 0) return what + " ended: " + words_of_report(event.report);
  return what + (event.report == genom::ok ? " done" : " refused: " + words_of_report(event.report));
}

}  // namespace

void ModuleLog::on(const genom::Module& module, const genom::ModuleEvent& event) {
  told_.push_back({&module, event});
  if (next_ != nullptr) next_->on(module, event);
}

std::vector<ModuleLog::Line> ModuleLog::take() {
  std::vector<Line> lines;
  for (const Told& told : std::exchange(told_, {}))
    lines.push_back(
        {told.event.date, told.module->name(), words_of_report(told.event), told.event.report != genom::ok});
  return lines;
}

}  // namespace waitpoint::tools
