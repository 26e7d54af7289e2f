// SPDX-License-Identifier: BSD-3-Clause
#include "tools/command/options/viewing.hpp"

#include "tools/command/option_values.hpp"

namespace waitpoint::tools {

void declare_page(Command& command, OptionalFile& page, const char* description) {
  command.add("--page", written_file(page, "FILE.html"), description);
}

void declare_serve(Command& command, std::optional<ServeAddress>& serve, const char* description) {
  OptionValue value{.placeholder = "ADDRESS:PORT", .omitted = "127.0.0.1:0"};
  value.take = [&serve](const std::string&, const std::string& text) { serve = serve_address(text); };
  command.add("--serve", std::move(value), description, {.usual = "a free port"});
}

}  // namespace waitpoint::tools
