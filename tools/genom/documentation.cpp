// SPDX-License-Identifier: BSD-3-Clause
// The page of a module's requests, posters and tasks.
#include <fmt/format.h>

#include "tools/genom/c_text.hpp"
#include "tools/genom/generators.hpp"

namespace waitpoint::tools {

using description::Description;
using description::ExecTask;
using description::Field;
using description::Parameter;
using description::Poster;
using description::Request;
using description::Type;
using description::TypeKind;

namespace {

std::string joined(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += fmt::format("{}`{}`", text.empty() ? "" : ", ", name);
  return text;
}
std::string joined(const std::vector<description::Name>& names) {
  std::vector<std::string> texts;
  texts.reserve(names.size());
  for (const description::Name& name : names) texts.push_back(name.text);
  return joined(texts);
}

// "`via.x` (double)": the numbers of a value by the keys that a scenario and the prompt have for them.
void add_keys(const Type& type, const std::string& key, std::vector<std::string>& keys) {
  if (type.kind == TypeKind::structure) {
    for (const Field& field : type.fields) add_keys(*field.type, key + "." + field.name, keys);
  } else if (type.kind == TypeKind::array && !is_text(type)) {
    add_keys(*type.element, key + ".0", keys);
    if (type.count > 1) keys.back() += fmt::format(" to `.{}`", type.count - 1);
  } else {
    std::string kind = is_text(type) ? fmt::format("text of {} letters", type.count - 1) : name(type.scalar);
    if (type.kind == TypeKind::enumeration) {
      kind.clear();
      for (const description::Enumerator& e : type.enumerators)
        kind += fmt::format("{}{} {}", kind.empty() ? "" : ", ", e.value, e.name);
    }
    keys.push_back(fmt::format("`{}` ({})", key, kind));
  }
}

std::string values(const Parameter& parameter, const std::vector<description::InputInfo>& infos = {}) {
  std::vector<std::string> keys;
  add_keys(*parameter.type, parameter.name, keys);
  std::string text;
  for (std::size_t i = 0; i < keys.size(); ++i) {
    text += (text.empty() ? "" : "; ") + keys[i];
    if (infos.size() != keys.size()) continue;
    text +=
        fmt::format(" {}, default {}", infos[i].text, infos[i].is_text ? quoted_text(infos[i].value) : infos[i].value);
  }
  return text;
}

std::string of_request(const Request& request) {
  std::string text = fmt::format("### `{}`\n\n", request.name.text);
  if (!request.doc.empty()) text += capitalised(request.doc) + ".\n\n";
  const auto row = [&](const char* what, const std::string& value) {
    if (!value.empty()) text += fmt::format("| {} | {} |\n", what, value);
  };
  text += "| | |\n|---|---|\n";
  row("type", name(request.kind));
  if (request.exec_task) row("task", "`" + request.exec_task->text + "`");
  if (request.input) row("input", values(*request.input, request.input_infos));
  if (request.output) row("output", values(*request.output));
  row("interrupts", joined(request.interrupts));
  row("reports", joined(request.fail_reports));
  return text + "\n";
}

std::string of_task(const Description& description, const ExecTask& task) {
  const double tick_ms = 1000.0 / static_cast<double>(description.ticks_per_s);
  const std::string period = task.period_ticks
                                 ? fmt::format("every {:g} ms", static_cast<double>(*task.period_ticks) * tick_ms)
                                 : "when events wake it";
  std::string text = fmt::format("* `{}`: {}", task.name.text, period);
  if (task.delay_ticks > 0) text += fmt::format(", {:g} ms later", static_cast<double>(task.delay_ticks) * tick_ms);
  if (!task.reads.empty()) text += "; reads " + joined(task.reads);
  if (!task.clients_from.empty()) text += "; sends requests to " + joined(task.clients_from);
  return text + "\n";
}

}  // namespace

std::string documentation(const Description& description) {
  std::string text =
      fmt::format("# Module `{}`\n\nModule number {}.\n\n## Tasks\n\n", description.name.text, description.number);
  for (const ExecTask& task : description.tasks) text += of_task(description, task);
  text += "\n## Posters\n\n";
  for (const Poster& poster : description.posters) {
    text += fmt::format("* `{}.{}`, written by `{}`{}:", description.name.text, poster.name.text, poster.exec_task.text,
                        poster.automatic ? " at every wake-up" : "");
    for (const Parameter& item : poster.data)
      text += fmt::format(" `{}`{}{}", item.name, item.type->name.empty() ? "" : " (" + item.type->name + ")",
                          &item == &poster.data.back() ? "\n" : ",");
  }
  text += "\n## Requests\n\n";
  for (const Request& request : description.requests) text += of_request(request);
  text.pop_back();
  return text;
}

}  // namespace waitpoint::tools
