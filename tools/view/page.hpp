// SPDX-License-Identifier: BSD-3-Clause
// The viewer's page (tools/view/page), which is part of the program.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace waitpoint::tools::view {

/// Its bytes, as assembled at build.
std::span<const unsigned char> page_file();

/// The page that connects to the server it comes from.
std::string_view page();

/// The page of a recorded run: base64 of the compressed JSON.
std::string page_of(std::string_view run);

}  // namespace waitpoint::tools::view
