// SPDX-License-Identifier: BSD-3-Clause
#include "world/formats/image_file.hpp"

#include <png.h>

#include <cstring>
#include <string_view>

#include "core/error.hpp"
#include "core/file_contents.hpp"
#include "core/occupancy_grid.hpp"
#include "world/formats/limits.hpp"
#include "world/formats/pgm.hpp"

namespace waitpoint::world {
namespace {

// The greatest ratio of PNG's compression.
constexpr std::uint64_t deflate_ratio_max = 1032;
constexpr std::string_view png_magic = "\x89PNG\r\n\x1a\n";

// libpng's simplified reader; frees libpng's memory also if the image cannot be read.
class PngReader {
 public:
  PngReader(const std::string& contents, const std::string& file) : contents_(contents), file_(file) {
    std::memset(&image_, 0, sizeof image_);
    image_.version = PNG_IMAGE_VERSION;
    png_image_begin_read_from_memory(&image_, contents.data(), contents.size());
    check();
  }
  ~PngReader() { png_image_free(&image_); }
  PngReader(const PngReader&) = delete;
  PngReader& operator=(const PngReader&) = delete;

  // The pixels as grey and opacity, or for a colour image as red, green, blue and opacity.
  std::vector<std::uint8_t> pixels() {
    if (std::uint64_t{image_.width} * image_.height > static_cast<std::uint64_t>(OccupancyGrid::cells_max)) {
      throw BadInput(file_, "expected at most " + std::to_string(OccupancyGrid::cells_max) + " pixels, found " +
                                std::to_string(image_.width) + " x " + std::to_string(image_.height));
    }
    if (bytes_least() > deflate_ratio_max * contents_.size()) throw BadInput(file_, "the PNG image is cut short");
    // By default libpng takes 16-bit images as linear, and 8-bit images as sRGB.
    image_.flags |= PNG_IMAGE_FLAG_16BIT_sRGB;
    image_.format = has_colours() ? PNG_FORMAT_RGBA : PNG_FORMAT_GA;
    const std::size_t channels = has_colours() ? 4 : 2;
    std::vector<std::uint8_t> pixels(channels * image_.width * image_.height);
    png_image_finish_read(&image_, nullptr, pixels.data(), 0, nullptr);
    check();
    return pixels;
  }
  bool has_colours() const { return (image_.format & PNG_FORMAT_FLAG_COLOR) != 0; }
  int width() const { return static_cast<int>(image_.width); }
  int height() const { return static_cast<int>(image_.height); }

 private:
  // A lower bound of the uncompressed size of the pixels, from the file's first chunk.
  std::uint64_t bytes_least() const {
    constexpr std::size_t at_depth = 24;  // behind magic, length, type, width and height; the colour type is next
    const auto byte = [&](std::size_t i) { return static_cast<std::uint8_t>(contents_[i]); };
    if (contents_.size() <= at_depth + 1) return 0;
    const std::uint64_t channels = byte(at_depth + 1) == 2 ? 3 : byte(at_depth + 1) == 6 ? 4 : 1;
    return (image_.width * channels * byte(at_depth) + 7) / 8 * image_.height;
  }

  void check() const {
    if (PNG_IMAGE_FAILED(image_)) throw BadInput(file_, std::string("the PNG image cannot be read: ") + image_.message);
  }

  png_image image_;
  const std::string& contents_;
  const std::string& file_;
};

GreyImage parse_png(const std::string& contents, const std::string& file) {
  PngReader reader(contents, file);
  const std::vector<std::uint8_t> pixels = reader.pixels();
  GreyImage image = {reader.width(), reader.height(), {}, {}};
  const std::size_t channels = reader.has_colours() ? 4 : 2;
  const std::size_t count = pixels.size() / channels;
  image.grey.reserve(count);
  image.transparency.reserve(count);
  bool opaque = true;
  for (std::size_t i = 0; i < pixels.size(); i += channels) {
    const int sum = channels == 4 ? pixels[i] + pixels[i + 1] + pixels[i + 2] : 3 * pixels[i];
    const bool hidden = pixels[i + channels - 1] == 0;
    image.grey.push_back(static_cast<std::uint8_t>(sum / 3));
    image.transparency.push_back(hidden ? 255 : 0);
    opaque = opaque && !hidden;
  }
  if (opaque) image.transparency.clear();
  return image;
}

}  // namespace

GreyImage read_grey_image(const std::string& file) {
  return parse_grey_image(file_contents(file, "an image (PGM or PNG)", image_bytes_max), file);
}

GreyImage parse_grey_image(const std::string& contents, const std::string& file) {
  const std::string_view view = contents;
  if (view.starts_with(png_magic)) return parse_png(contents, file);
  if (view.starts_with("P")) return parse_pgm(contents, file);
  throw BadInput(file, "expected a PGM image (P5 or P2) or a PNG image");
}

}  // namespace waitpoint::world
