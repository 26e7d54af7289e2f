// SPDX-License-Identifier: BSD-3-Clause
#include "modules/logs/decompression.hpp"

#include <zlib.h>

#include <algorithm>
#include <memory>
#include <vector>

#ifdef WAITPOINT_BZ2
#include <bzlib.h>
#endif
#ifdef WAITPOINT_LZ4
#include <lz4frame.h>
#endif
#ifdef WAITPOINT_ZSTD
#include <zstd.h>
#endif

#include "core/error.hpp"
#include "core/printable_line.hpp"

namespace waitpoint::logs {
namespace {

/// Appends block after block of decompressed data until `next(block, used)` says that the data is complete.
class Output {
 public:
  explicit Output(const std::string& name) : name_(name), block_(std::size_t{1} << 18) {}

  char* block() { return block_.data(); }
  std::size_t size() const { return block_.size(); }
  void add(std::size_t used) {
    if (contents_.size() + used > log_bytes_max) throw BadInput(name_, "expected at most 2 GiB when decompressed");
    contents_.append(block_.data(), used);
  }
  std::string finish(const char* method, bool is_whole) {
    if (!is_whole)
      throw BadInput(name_, std::string("expected whole ") + method + " data, found damaged or cut off data");
    return std::move(contents_);
  }

 private:
  const std::string& name_;
  std::vector<char> block_;
  std::string contents_;
};

unsigned limited(std::size_t size) { return static_cast<unsigned>(std::min(size, log_bytes_max)); }

// A file may be several compressed ones, one after another.
std::string from_gzip(const std::string& name, std::string_view bytes) {
  z_stream stream{};
  constexpr int any_window_of_gzip = 15 + 16;
  WAITPOINT_CHECK(inflateInit2(&stream, any_window_of_gzip) == Z_OK, "zlib does not begin");
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = limited(bytes.size());
  Output output(name);
  int state = Z_OK;
  while (state == Z_OK) {
    stream.next_out = reinterpret_cast<Bytef*>(output.block());
    stream.avail_out = limited(output.size());
    state = inflate(&stream, Z_NO_FLUSH);
    const std::size_t used = output.size() - stream.avail_out;
    if (state == Z_STREAM_END && stream.avail_in > 0) state = inflateReset(&stream);
    try {
      output.add(used);
    } catch (...) {
      inflateEnd(&stream);
      throw;
    }
  }
  inflateEnd(&stream);
  return output.finish("gzip", state == Z_STREAM_END);
}

#ifdef WAITPOINT_BZ2
std::string from_bzip2(const std::string& name, std::string_view bytes) {
  bz_stream stream{};
  WAITPOINT_CHECK(BZ2_bzDecompressInit(&stream, 0, 0) == BZ_OK, "bzip2 does not begin");
  stream.next_in = const_cast<char*>(bytes.data());
  stream.avail_in = limited(bytes.size());
  Output output(name);
  int state = BZ_OK;
  try {
    for (bool moves = true; state == BZ_OK && moves;) {
      stream.next_out = output.block();
      stream.avail_out = limited(output.size());
      const unsigned left = stream.avail_in;
      state = BZ2_bzDecompress(&stream);
      const std::size_t used = output.size() - stream.avail_out;
      moves = used > 0 || stream.avail_in < left;
      output.add(used);
    }
  } catch (...) {
    BZ2_bzDecompressEnd(&stream);
    throw;
  }
  BZ2_bzDecompressEnd(&stream);
  return output.finish("bz2", state == BZ_STREAM_END);
}
#endif

#ifdef WAITPOINT_LZ4
std::string from_lz4(const std::string& name, std::string_view bytes) {
  LZ4F_dctx* context = nullptr;
  WAITPOINT_CHECK(LZ4F_isError(LZ4F_createDecompressionContext(&context, LZ4F_VERSION)) == 0, "lz4 does not begin");
  const std::unique_ptr<LZ4F_dctx, decltype(&LZ4F_freeDecompressionContext)> owner(context,
                                                                                   &LZ4F_freeDecompressionContext);
  Output output(name);
  std::size_t wanted = 1;
  bool moves = true;
  while (wanted > 0 && moves) {
    std::size_t used = output.size(), read = bytes.size();
    wanted = LZ4F_decompress(context, output.block(), &used, bytes.data(), &read, nullptr);
    if (LZ4F_isError(wanted) != 0) break;
    bytes.remove_prefix(read);
    output.add(used);
    moves = used > 0 || read > 0;
  }
  return output.finish("lz4", wanted == 0);
}
#endif

#ifdef WAITPOINT_ZSTD
std::string from_zstd(const std::string& name, std::string_view bytes) {
  const std::unique_ptr<ZSTD_DCtx, decltype(&ZSTD_freeDCtx)> context(ZSTD_createDCtx(), &ZSTD_freeDCtx);
  WAITPOINT_CHECK(context != nullptr, "zstd does not begin");
  Output output(name);
  ZSTD_inBuffer input{bytes.data(), bytes.size(), 0};
  std::size_t wanted = 1;
  bool moves = true;
  while (wanted > 0 && moves) {
    ZSTD_outBuffer block{output.block(), output.size(), 0};
    const std::size_t before = input.pos;
    wanted = ZSTD_decompressStream(context.get(), &block, &input);
    if (ZSTD_isError(wanted) != 0) break;
    output.add(block.pos);
    moves = block.pos > 0 || input.pos > before;
  }
  return output.finish("zstd", wanted == 0);
}
#endif

}  // namespace

bool is_gzip(std::string_view bytes) { return bytes.starts_with("\x1f\x8b"); }

std::string decompressed(const std::string& name, std::string_view method, std::string_view bytes) {
  if (method == "gzip") return from_gzip(name, bytes);
#ifdef WAITPOINT_BZ2
  if (method == "bz2") return from_bzip2(name, bytes);
#endif
#ifdef WAITPOINT_LZ4
  if (method == "lz4") return from_lz4(name, bytes);
#endif
#ifdef WAITPOINT_ZSTD
  if (method == "zstd") return from_zstd(name, bytes);
#endif
  const bool is_known = method == "bz2" || method == "lz4" || method == "zstd";
  throw BadInput(name, "has chunks compressed by '" + printable_line(method.substr(0, 20)) + "', " +
                           (is_known ? "which this program was built without" : "expected bz2, lz4 or zstd"));
}

}  // namespace waitpoint::logs
