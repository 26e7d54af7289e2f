// SPDX-License-Identifier: BSD-3-Clause
// Decompression of whole files and of the chunks of recordings.
#pragma once

#include <string>
#include <string_view>

namespace waitpoint::logs {

/// The greatest size of a decompressed log.
inline constexpr std::size_t log_bytes_max = std::size_t{2} << 30;

bool is_gzip(std::string_view bytes);

/// The contents; `name` is the file, for messages. `method`: gzip, bz2, lz4 (its frame format) or zstd. BadInput for
/// another method, for one that this program was built without, and for damaged or cut off data.
std::string decompressed(const std::string& name, std::string_view method, std::string_view bytes);

}  // namespace waitpoint::logs
