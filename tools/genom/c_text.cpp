// SPDX-License-Identifier: BSD-3-Clause
#include "tools/genom/c_text.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace waitpoint::tools {

using description::Description;
using description::ExecTask;
using description::Request;
using description::Scalar;
using description::Type;
using description::TypeKind;

namespace {

const Type& element_of(const Type& type) {
  return type.kind == TypeKind::array && type.name.empty() ? element_of(*type.element) : type;
}
std::string dimensions(const Type& type) {
  if (type.kind != TypeKind::array || !type.name.empty()) return "";
  return fmt::format("[{}]{}", type.count, dimensions(*type.element));
}
std::string c_name(const Type& type) { return type.name == "_Bool" ? "bool" : type.name; }

const char* frame_scalar(Scalar scalar) {
  constexpr const char* names[] = {"bool",         "char",          "std::int8_t",  "std::uint8_t",
                                   "std::int16_t", "std::uint16_t", "std::int32_t", "std::uint32_t",
                                   "std::int64_t", "std::uint64_t", "double",       "double"};
  return names[static_cast<std::size_t>(scalar)];
}

void add(std::vector<Codel>& codels, Codel codel) {
  const bool known = std::any_of(codels.begin(), codels.end(), [&](const Codel& c) { return c.name == codel.name; });
  if (!codel.name.empty() && !known) codels.push_back(std::move(codel));
}

std::string unused(const std::string& names) {
  std::string text;
  for (std::size_t begin = 0, comma; (comma = names.find(", ", begin)) != names.npos; begin = comma + 2)
    text += fmt::format("  (void){};\n", names.substr(begin, comma - begin));
  return text;
}

}  // namespace

std::string c_declaration(const Type& type, const std::string& name) {
  return c_name(element_of(type)) + " " + name + dimensions(type);
}

std::string c_pointer(const Type& type, const std::string& name) {
  if (type.kind != TypeKind::array) return c_name(type) + " *" + name;
  const Type& element = *type.element;
  if (element.kind == TypeKind::array && element.name.empty())
    return fmt::format("{} (*{}){}", c_name(element_of(element)), name, dimensions(element));
  return c_name(element) + " *" + name;
}

std::string quoted_text(std::string_view text) {
  std::string quoted = "\"";
  for (const char letter : text) {
    if (letter == '"' || letter == '\\') quoted += '\\';
    quoted += letter == '\n' ? std::string("\\n") : std::string(1, letter);
  }
  return quoted + "\"";
}

std::string upper(std::string text) {
  for (char& letter : text)
    if (letter >= 'a' && letter <= 'z') letter = static_cast<char>(letter - 'a' + 'A');
  return text;
}

std::string capitalised(std::string text) {
  if (!text.empty()) text[0] = upper(text.substr(0, 1))[0];
  return text;
}

std::string fields_name(const Type& type, const std::string& inside) {
  if (type.name.empty()) return inside;
  std::string name = type.name;
  std::replace(name.begin(), name.end(), ' ', '_');
  return name;
}

std::string frame_type(const Type& type, const std::string& inside) {
  switch (type.kind) {
    case TypeKind::scalar:
    case TypeKind::enumeration: return frame_scalar(type.scalar);
    case TypeKind::array: return fmt::format("std::array<{}, {}>", frame_type(*type.element, inside), type.count);
    case TypeKind::structure: break;
  }
  return "genom_fields::" + fields_name(type, inside);
}

std::string input_parameter(const Request& request) {
  return request.input ? c_pointer(*request.input->type, request.input->name) + ", " : "";
}
std::string output_parameter(const Request& request) {
  return request.output ? c_pointer(*request.output->type, request.output->name) + ", " : "";
}
std::string input_name(const Request& request) { return request.input ? request.input->name + ", " : ""; }
std::string output_name(const Request& request) { return request.output ? request.output->name + ", " : ""; }

bool interrupts_itself(const Request& request) {
  return std::any_of(request.interrupts.begin(), request.interrupts.end(),
                     [&](const description::Name& name) { return name.text == request.name.text; });
}

std::vector<Codel> control_codels(const Description& description) {
  std::vector<Codel> codels;
  for (const Request& request : description.requests)
    add(codels, {request.control, fmt::format("STATUS {}({}int *report)", request.control, input_parameter(request)),
                 unused(input_name(request)), "OK",
                 fmt::format("Checks the input of {}: OK, or ERROR with a report.", request.name.text)});
  return codels;
}

std::vector<Codel> task_codels(const Description& description, std::size_t number) {
  const ExecTask& task = description.tasks[number];
  std::vector<Codel> codels;
  const std::string& name = task.name.text;
  const auto of_task = [&](const std::string& codel, const char* parameters, const std::string& comment) {
    add(codels, {codel, fmt::format("STATUS {}({})", codel, parameters), "", "OK", comment});
  };
  of_task(task.start, "int *report", fmt::format("Called once when {} starts.", name));
  of_task(task.main, "int *report", fmt::format("Called at every wake-up of {}, before the activities.", name));
  of_task(task.main2, "int *report", fmt::format("Called at every wake-up of {}, after the activities.", name));
  of_task(task.wait, "int *report", fmt::format("Waits for the next wake-up of {}, without the module's locks.", name));
  of_task(task.end, "void", fmt::format("Called once when {} ends.", name));
  for (const Request& request : description.requests) {
    if (!request.exec_task || request.exec_task->text != name) continue;
    const auto of_activity = [&](const std::string& codel, const char* state, const char* next) {
      add(codels, {codel,
                   fmt::format("ACTIVITY_EVENT {}({}{}int *report)", codel, input_parameter(request),
                               output_parameter(request)),
                   unused(input_name(request) + output_name(request)), next,
                   fmt::format("{} of {}.", state, request.name.text)});
    };
    of_activity(request.start, "START", "EXEC");
    of_activity(request.main, "EXEC", request.end.empty() ? "ETHER" : "END");
    of_activity(request.end, "END", "ETHER");
    of_activity(request.fail, "FAIL", "ZOMBIE");
    of_activity(request.inter, "INTER", "ETHER");
  }
  return codels;
}

}  // namespace waitpoint::tools
