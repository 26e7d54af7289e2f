// SPDX-License-Identifier: BSD-3-Clause
//
// In builds without a disassembler.
#include "core/error.hpp"
#include "core/missing_part.hpp"
#include "tools/exec/access_instructions.hpp"

namespace waitpoint::tools {

bool has_disassembler() { return false; }

std::vector<posix::AccessInstruction> access_instructions(const std::filesystem::path&, std::size_t) {
  throw BadInput("--switch-at", std::string("accesses cannot be found by this program: ") + missing_part::accesses);
}

}  // namespace waitpoint::tools
