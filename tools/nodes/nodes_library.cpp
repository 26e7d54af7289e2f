// SPDX-License-Identifier: BSD-3-Clause
#include "tools/nodes/nodes_library.hpp"

#include <dlfcn.h>

#include <filesystem>
#include <string>

#include "core/missing_part.hpp"
#include "tools/command/installed_part.hpp"

namespace waitpoint::tools {
namespace {

std::filesystem::path path_of_library(const Location& written) {
  try {
    return find_part(nodes::Library::file);
  } catch (const BadInput&) {
    throw written.bad(std::string("ROS nodes are not in this program: ") + missing_part::nodes);
  }
}

}  // namespace

void check_library(const Location& written) { (void)path_of_library(written); }

const nodes::Library& library_of_nodes(const Location& written) {
  void* const object = dlopen(path_of_library(written).c_str(), RTLD_NOW | RTLD_LOCAL);
  if (object == nullptr) throw written.bad(std::string("the library for ROS nodes cannot be loaded: ") + dlerror());
  const auto* const loaded = static_cast<const nodes::Library*>(dlsym(object, nodes::Library::symbol));
  if (loaded == nullptr) throw written.bad("the library for ROS nodes is of another version");
  return *loaded;
}

}  // namespace waitpoint::tools
