// SPDX-License-Identifier: BSD-3-Clause
#include "tools/genom/genom.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <utility>

#include "core/error.hpp"
#include "core/number_text.hpp"
#include "modules/description/parser.hpp"
#include "tools/command/option_values.hpp"
#include "tools/genom/c_text.hpp"
#include "tools/genom/generators.hpp"
#include "tools/output/json_document.hpp"
#include "tools/output/output_file.hpp"

namespace waitpoint::tools {
namespace {

namespace fs = std::filesystem;
using description::Description;
using Json = nlohmann::ordered_json;

struct Generated {
  std::string name;
  std::string text;
};

std::vector<Generated> server_files(const Description& module) {
  const std::string server = "server/" + module.name.text;
  return {{server + "Type.h", type_header(module)},       {server + "Error.h", error_header(module)},
          {server + "Header.h", codel_header(module)},    {server + "MsgLib.h", client_header(module)},
          {server + "MsgLib.cpp", client_source(module)}, {server + "Fields.hpp", fields_header(module)},
          {server + "Module.hpp", module_header(module)}, {server + "Module.cpp", module_source(module)},
          {server + "Main.cpp", main_source(module)},     {module.name.text + ".md", documentation(module)}};
}

std::vector<Generated> users_files(const Description& module, const std::vector<std::string>& include_folders) {
  const std::string& name = module.name.text;
  const char* suffix = module.cxx_codels ? "Codels.cc" : "Codels.c";
  std::vector<Generated> files;
  if (!control_codels(module).empty())
    files.push_back({"codels/" + name + "CntrlTask" + suffix, control_stubs(module)});
  for (std::size_t i = 0; i < module.tasks.size(); ++i)
    files.push_back({"codels/" + name + module.tasks[i].name.text + suffix, task_stubs(module, i)});
  files.push_back({name + ".yaml", scenario(module)});
  files.push_back({"Makefile", makefile(module, include_folders)});
  return files;
}

void write(const fs::path& path, const std::string& text) {
  std::error_code error;
  fs::create_directories(path.parent_path(), error);
  if (error) throw BadInput(path.parent_path().string(), "cannot be made: " + error.message());
  OutputFile file(path);
  file.write(text);
  file.commit();
}

Json json_of(const GenomOptions& options, const Description& module) {
  return {{"description", options.file},
          {"module", module.name.text},
          {"requests", module.requests.size()},
          {"posters", module.posters.size()},
          {"tasks", module.tasks.size()}};
}

int tell(const GenomOptions& options, const std::string& text, const Json& json) {
  write_text(text, options.json);
  return options.json ? end_with_json("genom", 0, json.dump(-1, ' ', false, Json::error_handler_t::replace)) : 0;
}

}  // namespace

void declare(Command& command, GenomOptions& options) {
  command.description = "Generates a module from its description in GenoM's language (docs/laas-gen.md).";
  command.examples = {"mast.gen --out mast"};
  command.add("FILE", text(options.file, ""), "the description: NAME.gen", {.is_required = true});
  command.add("--out", text(options.out, "FOLDER"), "folder of the generated files", {.usual = "that of FILE"});
  command.add("--include", texts(options.folders, "FOLDER"),
              "where included files are searched, beside FILE's folder; may be repeated");
  command.add("--check", flag(options.check_only), "validate the description, and write nothing");
  command.add("--documentation", flag(options.documentation_only),
              "write its page of requests and posters to standard output");
  command.json(options.json);
}

int genom(const GenomOptions& options) {
  const Description module = description::read_description(options.file, options.folders);
  if (options.documentation_only && options.json)
    throw BadInput("--json", "cannot be used together with --documentation");
  if (options.documentation_only) return write_standard_output(documentation(module)), 0;
  Json json = json_of(options, module);
  if (options.check_only)
    return tell(options,
                fmt::format("{}: good: module {}, {}, {}, {}\n", options.file, module.name.text,
                            counted(module.requests.size(), "request"), counted(module.posters.size(), "poster"),
                            counted(module.tasks.size(), "task")),
                json);
  const fs::path beside = fs::path(options.file).parent_path();
  const fs::path out = options.out.empty() ? (beside.empty() ? fs::path(".") : beside) : fs::path(options.out);
  // As the compiler finds them from the folder of the Makefile.
  std::vector<std::string> include_folders;
  std::vector<fs::path> folders = {beside.empty() ? fs::path(".") : beside};
  folders.insert(folders.end(), options.folders.begin(), options.folders.end());
  include_folders.reserve(folders.size());
  for (const fs::path& folder : folders)
    include_folders.push_back(
        fs::absolute(folder).lexically_normal().lexically_relative(fs::absolute(out).lexically_normal()).string());
  std::string told;
  json["folder"] = out.string();
  json["written"] = json["kept"] = Json::array();
  for (const Generated& file : server_files(module)) {
    write(out / file.name, file.text);
    told += fmt::format("  {}\n", file.name);
    json["written"].push_back(file.name);
  }
  for (const Generated& file : users_files(module, include_folders)) {
    const bool exists = fs::exists(out / file.name);
    if (!exists) write(out / file.name, file.text);
    told += fmt::format("  {}{}\n", file.name, exists ? " (kept)" : "");
    json[exists ? "kept" : "written"].push_back(file.name);
  }
  return tell(
      options,
      fmt::format("module {} in {}:\n{}build: make -C {}\nrun:   {} run {}\n", module.name.text, out.string(), told,
                  out.string(), (out / module.name.text).string(), (out / (module.name.text + ".yaml")).string()),
      json);
}

}  // namespace waitpoint::tools
