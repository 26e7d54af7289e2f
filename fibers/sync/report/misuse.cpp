// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/sync/report/misuse.hpp"

#include "fibers/sync/report/object_names.hpp"

namespace waitpoint::sync {

const char* about(const kernel::Object& object, const char* message) {
  static thread_local std::string text;
  text = std::string(message) + ": " + describe(object);
  if (const std::string holders = describe_holders(object); !holders.empty()) text += ", " + holders;
  return text.c_str();
}

}  // namespace waitpoint::sync
