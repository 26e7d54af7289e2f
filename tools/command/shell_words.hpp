// SPDX-License-Identifier: BSD-3-Clause
// Shell quoting of command words.
#pragma once

#include <string>
#include <vector>

namespace waitpoint::tools {

/// The word in quotation marks.
std::string in_quotation_marks(const std::string& word);

/// The word, in quotation marks if a shell would not read it back unchanged.
std::string quoted(const std::string& word);

/// All words, each with a leading space.
std::string quoted(const std::vector<std::string>& words);

}  // namespace waitpoint::tools
