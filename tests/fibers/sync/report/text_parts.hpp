// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace waitpoint {

/// True if `part` is somewhere in a report's text.
inline bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}  // namespace waitpoint
