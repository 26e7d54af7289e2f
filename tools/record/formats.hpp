// SPDX-License-Identifier: BSD-3-Clause
// The formats of --record, by the extensions of file names.
#pragma once

#include <filesystem>
#include <memory>

#include "tools/record/recording.hpp"

namespace waitpoint::tools {

/// Of the kind that the file's extension says; BadInput for another one, or where the file cannot be written.
std::unique_ptr<Recording> make_recording(const std::filesystem::path& path, const bridge::Scenario& scenario);

}  // namespace waitpoint::tools
