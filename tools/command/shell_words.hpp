// SPDX-License-Identifier: BSD-3-Clause
// Words of a command as a shell reads them back.
#pragma once

#include <string>
#include <vector>

namespace waitpoint::tools {

/// The word as it is, or in quotation marks where a shell would make something else of it.
std::string quoted(const std::string& word);

/// All of them, each with a space in front.
std::string quoted(const std::vector<std::string>& words);

}  // namespace waitpoint::tools
