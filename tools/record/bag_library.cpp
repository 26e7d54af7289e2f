// SPDX-License-Identifier: BSD-3-Clause
#include <dlfcn.h>

#include "core/error.hpp"
#include "core/missing_part.hpp"
#include "tools/command/installed_part.hpp"
#include "tools/record/ros_bag_file.hpp"

namespace waitpoint::tools {
namespace {

std::string library_for(const std::string& bag) {
  try {
    return find_part(BagLibrary::file).string();
  } catch (const BadInput&) {
    throw BadInput(bag, std::string("bags of ROS cannot be written by this waitpoint: ") + missing_part::bags);
  }
}

}  // namespace

const BagLibrary& bag_library(const std::string& bag) {
  void* const object = dlopen(library_for(bag).c_str(), RTLD_NOW | RTLD_LOCAL);
  if (object == nullptr) throw BadInput(bag, std::string("the library for bags of ROS cannot be loaded: ") + dlerror());
  const auto* const loaded = static_cast<const BagLibrary*>(dlsym(object, BagLibrary::symbol));
  if (loaded == nullptr) throw BadInput(bag, "the library for bags of ROS is of another version");
  return *loaded;
}

}  // namespace waitpoint::tools
