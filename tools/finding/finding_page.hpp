// SPDX-License-Identifier: BSD-3-Clause
// A finding (fibers/explore/report/finding_file.hpp) as a page that opens offline.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace waitpoint::tools {

/// The file's text. Throws BadInput, naming the file, unless it is a whole finding of a format that is known.
std::string read_finding(const std::filesystem::path& file);

/// The page of a finding's text.
std::string page_of_finding(std::string_view finding);

}  // namespace waitpoint::tools
