// SPDX-License-Identifier: BSD-3-Clause
#include "modules/logs/log_file.hpp"

#include <zlib.h>

#include <algorithm>

#include "core/error.hpp"
#include "core/file_contents.hpp"
#include "modules/logs/carmen_log.hpp"

namespace waitpoint::logs {
namespace {

constexpr std::size_t bytes_max = std::size_t{2} << 30;

bool is_compressed(const std::string& contents) { return contents.starts_with("\x1f\x8b"); }

// A file may be several compressed ones, one after another.
std::string decompressed(const std::string& name, const std::string& compressed) {
  z_stream stream{};
  constexpr int any_window_of_gzip = 15 + 16;
  WAITPOINT_CHECK(inflateInit2(&stream, any_window_of_gzip) == Z_OK, "zlib does not begin");
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(compressed.data()));
  stream.avail_in = static_cast<uInt>(std::min(compressed.size(), bytes_max));
  std::string contents;
  std::vector<char> block(std::size_t{1} << 18);
  int state = Z_OK;
  while (state == Z_OK && contents.size() <= bytes_max) {
    stream.next_out = reinterpret_cast<Bytef*>(block.data());
    stream.avail_out = static_cast<uInt>(block.size());
    state = inflate(&stream, Z_NO_FLUSH);
    contents.append(block.data(), block.size() - stream.avail_out);
    if (state == Z_STREAM_END && stream.avail_in > 0) state = inflateReset(&stream);
  }
  inflateEnd(&stream);
  if (contents.size() > bytes_max) throw BadInput(name, "expected at most 2 GiB when decompressed");
  if (state != Z_STREAM_END) throw BadInput(name, "expected whole gzip data, found damaged or cut off data");
  return contents;
}

}  // namespace

SensorLog parse_log(const std::string& name, std::string contents, const LogChoice& choice) {
  if (is_compressed(contents)) contents = decompressed(name, contents);
  SensorLog log = parse_carmen_log(name, contents, choice);
  log.file = name;
  return log;
}

SensorLog read_log(const std::filesystem::path& file, const LogChoice& choice) {
  return parse_log(file.string(), given_file_contents(file, bytes_max), choice);
}

}  // namespace waitpoint::logs
