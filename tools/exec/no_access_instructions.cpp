// SPDX-License-Identifier: BSD-3-Clause
//
// In builds without a disassembler.
#include "core/error.hpp"
#include "tools/exec/access_instructions.hpp"

namespace waitpoint::tools {

bool has_disassembler() { return false; }

std::vector<posix::AccessInstruction> access_instructions(const std::filesystem::path&) {
  throw BadInput("--switch-at", "this waitpoint was built without Zydis, which finds accesses (Debian's libzydis-dev)");
}

}  // namespace waitpoint::tools
