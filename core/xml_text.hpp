// SPDX-License-Identifier: BSD-3-Clause
// Text within XML.
#pragma once

#include <string>
#include <string_view>

namespace waitpoint {

/// Text with characters reserved in XML escaped, and disallowed ones removed.
std::string xml_escaped(std::string_view text);

}  // namespace waitpoint
