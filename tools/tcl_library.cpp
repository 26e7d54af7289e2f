// SPDX-License-Identifier: BSD-3-Clause
#include "tools/tcl_library.hpp"

#include "core/error.hpp"
#include "modules/tcl/interpreter.hpp"
#include "tools/command/installed_part.hpp"

namespace waitpoint::tools {

void find_tcl() {
  try {
    tcl::set_library_path(find_part(tcl::Library::file).string());
  } catch (const BadInput&) {
  }
}

}  // namespace waitpoint::tools
