// SPDX-License-Identifier: BSD-3-Clause
// The module on the frame of modules/genom, and the program.
#include <fmt/format.h>

#include <algorithm>

#include "tools/genom/c_text.hpp"
#include "tools/genom/generators.hpp"

namespace waitpoint::tools {

using description::Description;
using description::ExecTask;
using description::Parameter;
using description::Poster;
using description::Request;
using description::RequestKind;

namespace {

class ModuleSource {
 public:
  explicit ModuleSource(const Description& description) : of_(description), module_(description.name.text) {}

  std::string text() const {
    std::string constructor, members;
    for (std::size_t i = 0; i < of_.tasks.size(); ++i) constructor += task(of_.tasks[i]);
    for (const Request& request : of_.requests) {
      members += request_members(request);
      constructor += request_line(request);
    }
    std::string posters, functions;
    for (const Poster& poster : of_.posters) {
      constructor += poster_line(poster);
      if (!poster.automatic) posters += user_poster(poster);
      if (!poster.automatic) functions += poster_functions(poster);
    }
    return fmt::format(
        "#include \"{0}Module.hpp\"\n\n#include <waitpoint/modules/genom/c_module.hpp>\n\n#include \"{0}Fields.hpp\"\n"
        "#include \"{0}Header.h\"\n\nnamespace genom_{0} {{\nnamespace {{\n\n"
        "using waitpoint::genom::copy_c;\nusing waitpoint::genom::from_c;\nusing waitpoint::genom::Nothing;\n"
        "using waitpoint::genom::Report;\nusing waitpoint::genom::State;\nusing waitpoint::genom::to_c;\n\n"
        "class Module : public waitpoint::genom::CModule {{\n public:\n"
        "  explicit Module(waitpoint::genom::ModuleSetup& setup);\n\n  {1} data{{}};  // internal_data\n{2}\n "
        "private:\n{3}}};\n\n"
        "Module::Module(waitpoint::genom::ModuleSetup& setup) : CModule(setup, {4}) {{\n{5}}}\n\n"
        "Module& running() {{ return static_cast<Module&>(Module::running()); }}\n\n}}  // namespace\n\n"
        "waitpoint::genom::ModuleType module_type() {{ return waitpoint::genom::module_type<Module>(\"{0}\"); }}\n\n"
        "}}  // namespace genom_{0}\n\n{6}",
        module_, of_.data->name, posters, members, of_.number, constructor, c_functions() + functions);
  }

 private:
  std::string c_functions() const {
    return fmt::format(
               "{1} *{0}InternalData(void) {{ return &genom_{0}::running().data; }}\n"
               "int {0}CurrentActivity(void) {{ return waitpoint::genom::CModule::activity(); }}\n"
               "double {0}TaskPeriod(int task) {{ return genom_{0}::running().period_s(task); }}\n",
               module_, of_.data->name) +
           posters_input();
  }

  // Ticks as nanoseconds, rounded.
  std::string span(std::int64_t ticks) const {
    return fmt::format("std::chrono::nanoseconds({})", (ticks * 1'000'000'000 + of_.ticks_per_s / 2) / of_.ticks_per_s);
  }

  std::string task(const ExecTask& task) const {
    const std::string& name = task.name.text;
    std::string text = fmt::format(
        "  auto& task_{0} = add_task(\"{0}\", {{.period_ms = {1}, .delay_ms = {2}, .cost_us = {{}}}});\n", name,
        task.period_ticks ? span(*task.period_ticks) : "{}", task.delay_ticks > 0 ? span(task.delay_ticks) : "{}");
    const auto codel = [&](const char* setter, const std::string& function, const char* call) {
      if (function.empty()) return;
      text += fmt::format("  task_{0}.{1}([this, &task_{0}] {{ permanent(task_{0}, {2}); }});\n", name, setter,
                          fmt::format(fmt::runtime(call), function));
    };
    codel("set_start", task.start, "{}");
    codel("set_permanent", task.main, "{}");
    codel("set_second_permanent", task.main2, "{}");
    codel("set_wait", task.wait, "{}");
    codel("set_end", task.end, "[](int*) {{ return {}(); }}");
    if (text.find("&task_") == std::string::npos) text += fmt::format("  (void)task_{};\n", name);
    return text;
  }

  static std::string type_of(const Request& request, const char* what) {
    const bool exists = what[0] == 'I' ? request.input.has_value() : request.output.has_value();
    return exists ? request.name.text + what : "Nothing";
  }
  static std::string local(const Parameter& parameter) {
    return c_declaration(*parameter.type, parameter.name) + "{};";
  }

  // The functions between the frame and the codels of one request.
  std::string request_members(const Request& request) const {
    std::string text = control_member(request);
    if (request.kind == RequestKind::control) return text;
    const std::string& name = request.name.text;
    const bool stored = interrupts_itself(request);
    std::string arguments, before, after;
    if (request.input) {
      const Parameter& input = *request.input;
      if (!stored)
        before += fmt::format("      {0}\n      to_c({1}, activity_.input.{1});\n", local(input), input.name);
      arguments += argument(input, stored) + ", ";
    }
    if (request.output) {
      const Parameter& output = *request.output;
      if (!stored)
        before += fmt::format("      {0}\n      to_c({1}, activity_.output.{1});\n", local(output), output.name);
      after =
          fmt::format("      from_c(activity_.output.{}, {});\n", output.name, stored ? in_data(output) : output.name);
      arguments += argument(output, stored) + ", ";
    }
    const std::string codel =
        fmt::format("ACTIVITY_EVENT (*codel_)({}{}int*)", pointer_type(request.input), pointer_type(request.output));
    return text +
           fmt::format(
               "  State call_{0}(waitpoint::genom::Running<{1}, {2}>& activity_, {3}) {{\n"
               "    return step(activity_, [&](int* report_) {{\n{4}"
               "      const ACTIVITY_EVENT next_ = codel_({5}report_);\n{6}      return next_;\n    }});\n  }}\n",
               name, type_of(request, "Input"), type_of(request, "Output"), codel, before, arguments, after);
  }

  static std::string pointer_type(const std::optional<Parameter>& parameter) {
    return parameter ? c_pointer(*parameter->type, "") + ", " : "";
  }
  std::string member(const Parameter& parameter) const {
    return path_text(parameter) == "all" ? "" : path_text(parameter);
  }
  std::string in_data(const Parameter& parameter) const {
    return member(parameter).empty() ? "this->data" : "this->data." + member(parameter);
  }
  std::string argument(const Parameter& parameter, bool is_in_data) const {
    const std::string value = is_in_data ? in_data(parameter) : parameter.name;
    return parameter.type->kind == description::TypeKind::array ? value : "&" + value;
  }

  // The control codel; then the input becomes part of the internal data, unless several activities may have their own.
  std::string control_member(const Request& request) const {
    std::string text;
    const bool stores = request.kind == RequestKind::control || interrupts_itself(request);
    const bool is_control = request.kind == RequestKind::control;
    if (request.input)
      text += fmt::format("    {0}\n    to_c({1}, from_.{1});\n", local(*request.input), request.input->name);
    if (!request.control.empty())
      text += fmt::format(
          "    const Report checked_ = control([&](int* report_) {{ return {}({}report_); }});\n"
          "    if (checked_ != waitpoint::genom::ok) return checked_;\n",
          request.control, request.input ? argument(*request.input, false) + ", " : "");
    if (request.input && stores)
      text += fmt::format("    copy_c({}, {});\n", in_data(*request.input), request.input->name);
    if (request.input && !stores && request.control.empty())
      text += fmt::format("    (void){};\n", request.input->name);
    if (is_control && request.output)
      text += fmt::format("    from_c(to_.{}, {});\n", request.output->name, in_data(*request.output));
    return fmt::format(
        "  Report check_{0}(const {1}&{2}{3}) {{\n{4}    return waitpoint::genom::ok;\n  }}\n", request.name.text,
        type_of(request, "Input"), request.input ? " from_" : "",
        is_control ? fmt::format(", {}&{}", type_of(request, "Output"), request.output ? " to_" : "") : "", text);
  }

  std::string request_line(const Request& request) const {
    const std::string& name = request.name.text;
    std::string interrupts;
    for (const description::Name& other : request.interrupts)
      interrupts += (interrupts.empty() ? "" : ", ") + quoted_text(other.text);
    const std::string types = type_of(request, "Input") + ", " + type_of(request, "Output");
    if (request.kind == RequestKind::control)
      return fmt::format(
          "  add_control<{0}>(\"{1}\", [this](const {2}& input, {3}& output) {{ return check_{1}(input, output); }}, "
          "{{{4}}});\n",
          types, name, type_of(request, "Input"), type_of(request, "Output"), interrupts);
    std::string codels = fmt::format(".control = [this](const auto& input) {{ return check_{}(input); }}", name);
    const auto codel = [&](const char* state, const std::string& function) {
      if (function.empty())
        codels += fmt::format(", .{} = nullptr", state);
      else
        codels +=
            fmt::format(", .{} = [this](auto& activity) {{ return call_{}(activity, {}); }}", state, name, function);
    };
    codel("start", request.start);
    codel("exec", request.main);
    codel("end", request.end);
    codel("fail", request.fail);
    codel("inter", request.inter);
    const bool is_init = request.kind == RequestKind::init;
    return fmt::format("  {}<{}>(\"{}\", task_{}, {{{}}}{});\n", is_init ? "add_init" : "add_activity", types, name,
                       request.exec_task->text, codels, is_init ? "" : ", {" + interrupts + "}");
  }

  std::string poster_line(const Poster& poster) const {
    const std::string type = "genom_fields::" + poster_type_name(of_, poster);
    if (!poster.automatic)
      return fmt::format("  poster_{0} = &add_poster<{1}>(\"{0}\", task_{2});\n", poster.name.text, type,
                         poster.exec_task.text);
    std::string items;
    for (const Parameter& item : poster.data)
      items += fmt::format("    from_c(value.{}, {});\n", item.name, in_data(item));
    return fmt::format("  add_computed_poster<{1}>(\"{0}\", task_{2}, [this]({1}& value) {{\n{3}  }});\n",
                       poster.name.text, type, poster.exec_task.text, items);
  }

  std::string user_poster(const Poster& poster) const {
    return fmt::format(
        "  {1} value_{0}{{}};\n  waitpoint::genom::OutputPoster<genom_fields::{1}>* poster_{0} = nullptr;\n",
        poster.name.text, poster_type_name(of_, poster));
  }

  std::string poster_functions(const Poster& poster) const {
    const std::string name = module_ + poster.name.text, type = poster_type_name(of_, poster);
    std::string text = fmt::format(
        "POSTER_ID {0}PosterId(void) {{\n  const auto& module = genom_{1}::running();\n"
        "  return module.find_poster(module.name() + \".{2}\");\n}}\n"
        "STATUS {0}PosterWrite(POSTER_ID poster, {3} *value) {{\n  auto& module = genom_{1}::running();\n"
        "  if (poster != {0}PosterId()) return ERROR;\n  module.value_{2} = *value;\n"
        "  genom_fields::{3} fields;\n  fields.from(*value);\n  module.poster_{2}->write(fields);\n  return OK;\n}}\n",
        name, module_, poster.name.text, type);
    for (const Parameter& item : poster.data) {
      const bool is_array = item.type->kind == description::TypeKind::array;
      text += fmt::format(
          "STATUS {0}{1}PosterWrite(POSTER_ID poster, {2}) {{\n  auto& module = genom_{3}::running();\n"
          "  {4} value = module.value_{5};\n  waitpoint::genom::copy_c(value.{6}, {7});\n"
          "  return {0}PosterWrite(poster, &value);\n}}\n",
          name, capitalised(item.name), c_pointer(*item.type, item.name), module_, type, poster.name.text, item.name,
          is_array ? fmt::format("*reinterpret_cast<decltype(value.{0})*>({0})", item.name) : "*" + item.name);
    }
    return text;
  }

  std::string posters_input() const {
    std::vector<std::string> types;
    for (const Request& request : of_.requests)
      types.insert(types.end(), request.posters_input.begin(), request.posters_input.end());
    for (const ExecTask& task : of_.tasks)
      types.insert(types.end(), task.posters_input.begin(), task.posters_input.end());
    std::sort(types.begin(), types.end());
    types.erase(std::unique(types.begin(), types.end()), types.end());
    std::string text;
    for (const std::string& type : types) {
      std::string name = type;
      std::replace(name.begin(), name.end(), ' ', '_');
      text += fmt::format(
          "STATUS {0}{1}PosterFind(char *name, POSTER_ID *poster) {{\n  *poster = "
          "genom_{0}::running().find_poster(name);\n"
          "  return *poster != nullptr ? OK : ERROR;\n}}\n"
          "STATUS {0}{1}PosterRead(POSTER_ID poster, {2} *value) {{\n"
          "  return static_cast<waitpoint::genom::PosterBase*>(poster)->read_c(value, sizeof *value) ? OK : "
          "ERROR;\n}}\n",
          module_, name, type);
    }
    return text;
  }

  const Description& of_;
  const std::string& module_;
};

}  // namespace

std::string module_header(const Description& description) {
  return generated_line(description, "//") +
         fmt::format(
             "#pragma once\n\n#include <waitpoint/modules/genom/module_type.hpp>\n\nnamespace genom_{0} {{\n\n"
             "/// The type `{0}` of modules, for waitpoint::main().\nwaitpoint::genom::ModuleType module_type();\n\n"
             "}}  // namespace genom_{0}\n",
             description.name.text);
}

std::string module_source(const Description& description) {
  return generated_line(description, "//") + ModuleSource(description).text();
}

std::string main_source(const Description& description) {
  return generated_line(description, "//") +
         fmt::format(
             "#include <waitpoint/modules/genom/module.hpp>\n#include <waitpoint/tools/main.hpp>\n\n"
             "#include \"{0}Module.hpp\"\n\n"
             "int main(int argc, char **argv) {{ return waitpoint::main(argc, argv, {{genom_{0}::module_type()}}); "
             "}}\n",
             description.name.text);
}

}  // namespace waitpoint::tools
