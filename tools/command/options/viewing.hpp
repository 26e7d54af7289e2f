// SPDX-License-Identifier: BSD-3-Clause
// Pages for browsers: --page writes one, --serve shows it at an address.
#pragma once

#include <optional>

#include "tools/command/command.hpp"
#include "tools/command/options/results.hpp"
#include "tools/command/serve_address.hpp"

namespace waitpoint::tools {

void declare_page(Command& command, OptionalFile& page, const char* description);
void declare_serve(Command& command, std::optional<ServeAddress>& serve, const char* description);

}  // namespace waitpoint::tools
