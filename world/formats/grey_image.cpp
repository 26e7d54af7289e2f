// SPDX-License-Identifier: BSD-3-Clause
#include "world/formats/grey_image.hpp"

#include <png.h>

#include <cstring>
#include <fstream>
#include <iterator>
#include <string_view>

#include "core/error.hpp"
#include "core/occupancy_grid.hpp"
#include "world/formats/pgm.hpp"

namespace waitpoint::world {
namespace {

constexpr std::string_view png_magic = "\x89PNG\r\n\x1a\n";

std::string contents_of(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  // A folder opens, but cannot be read.
  if (!in || in.peek() == std::ifstream::traits_type::eof()) {
    throw BadInput(file, "expected an image (PGM or PNG), found no file or an empty one");
  }
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

// libpng's simplified reader; what it holds is freed whether or not the image can be read.
class PngReader {
 public:
  PngReader(const std::string& contents, const std::string& file) : file_(file) {
    std::memset(&image_, 0, sizeof image_);
    image_.version = PNG_IMAGE_VERSION;
    png_image_begin_read_from_memory(&image_, contents.data(), contents.size());
    check();
  }
  ~PngReader() { png_image_free(&image_); }
  PngReader(const PngReader&) = delete;
  PngReader& operator=(const PngReader&) = delete;

  // The pixels as red, green, blue, opacity.
  std::vector<std::uint8_t> pixels() {
    if (std::uint64_t{image_.width} * image_.height > static_cast<std::uint64_t>(OccupancyGrid::cells_max)) {
      throw BadInput(file_, "expected at most " + std::to_string(OccupancyGrid::cells_max) + " pixels, found " +
                                std::to_string(image_.width) + " x " + std::to_string(image_.height));
    }
    if ((image_.format & PNG_FORMAT_FLAG_LINEAR) != 0) throw BadInput(file_, "expected an image of 8 bits, found 16");
    image_.format = PNG_FORMAT_RGBA;
    std::vector<std::uint8_t> pixels(PNG_IMAGE_SIZE(image_));
    png_image_finish_read(&image_, nullptr, pixels.data(), 0, nullptr);
    check();
    return pixels;
  }
  int width() const { return static_cast<int>(image_.width); }
  int height() const { return static_cast<int>(image_.height); }

 private:
  void check() const {
    if (PNG_IMAGE_FAILED(image_)) throw BadInput(file_, std::string("the PNG image cannot be read: ") + image_.message);
  }

  png_image image_;
  const std::string& file_;
};

GreyImage parse_png(const std::string& contents, const std::string& file) {
  PngReader reader(contents, file);
  const std::vector<std::uint8_t> pixels = reader.pixels();
  GreyImage image = {reader.width(), reader.height(), {}, {}};
  bool opaque = true;
  for (std::size_t i = 0; i < pixels.size(); i += 4) {
    image.grey.push_back(static_cast<std::uint8_t>((pixels[i] + pixels[i + 1] + pixels[i + 2]) / 3));
    image.transparency.push_back(pixels[i + 3] == 0 ? 255 : 0);
    opaque = opaque && pixels[i + 3] != 0;
  }
  if (opaque) image.transparency.clear();
  return image;
}

}  // namespace

GreyImage read_grey_image(const std::string& file) {
  const std::string contents = contents_of(file);
  const std::string_view view = contents;
  if (view.starts_with(png_magic)) return parse_png(contents, file);
  if (view.starts_with("P")) return parse_pgm(contents, file);
  throw BadInput(file, "expected a PGM image (P5 or P2) or a PNG image");
}

}  // namespace waitpoint::world
