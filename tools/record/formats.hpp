// SPDX-License-Identifier: BSD-3-Clause
// The formats of --record, by file name extension.
#pragma once

#include <filesystem>
#include <memory>

#include "modules/scenario/scenario.hpp"
#include "tools/record/recording.hpp"

namespace waitpoint::tools {

/// Chosen by the file's extension; BadInput for an unknown one, or if the file cannot be written.
std::unique_ptr<Recording> make_recording(const std::filesystem::path& path, const scenario::Scenario& scenario);

}  // namespace waitpoint::tools
