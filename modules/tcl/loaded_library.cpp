// SPDX-License-Identifier: BSD-3-Clause
#include <dlfcn.h>

#include <filesystem>

#include "core/missing_part.hpp"
#include "core/process_state.hpp"
#include "modules/tcl/interpreter.hpp"

namespace waitpoint::tcl {
namespace {

std::string& library_path() {
  static std::string path;
  return path;
}

const Library& load(const std::string& where, int line) {
  const std::filesystem::path path =
      library_path().empty()
          ? std::filesystem::read_symlink("/proc/self/exe").parent_path().parent_path() / Library::file
          : std::filesystem::path(library_path());
  if (!std::filesystem::exists(path))
    throw BadInput(where, line, std::string("scripts in Tcl are not in this program: ") + missing_part::tcl);
  const ProcessStateKept surroundings("loading the library for Tcl");
  void* const object = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (object == nullptr) throw BadInput(where, line, std::string("the library for Tcl cannot be loaded: ") + dlerror());
  const auto* const loaded = static_cast<const Library*>(dlsym(object, Library::symbol));
  if (loaded == nullptr) throw BadInput(where, line, "the library for Tcl is of another version");
  return *loaded;
}

}  // namespace

void set_library_path(const std::string& path) { library_path() = path; }

const Library& library(const std::string& where, int line) {
  static const Library& loaded = load(where, line);
  return loaded;
}

const Library& library_for(const std::string& file, const std::string& script, const std::string& where, int line) {
  const Library& loaded = library(where, line);
  if (const auto error = loaded.check(script)) throw BadInput(file, error->line, error->text);
  return loaded;
}

}  // namespace waitpoint::tcl
