// SPDX-License-Identifier: BSD-3-Clause
#include "world/formats/pgm.hpp"

#include <cstddef>

#include "core/error.hpp"
#include "core/occupancy_grid.hpp"

namespace waitpoint::world {
namespace {

constexpr std::int64_t number_max = 1'000'000'000;

class Reader {
 public:
  Reader(std::string_view contents, const std::string& file) : rest_(contents), file_(file) {}

  [[noreturn]] void fail(const std::string& message) const { throw BadInput(file_, message); }

  std::string_view take(std::size_t count) {
    const std::string_view taken = rest_.substr(0, count);
    rest_.remove_prefix(taken.size());
    return taken;
  }

  // The next decimal number, after white space and comments; -1 at the end of the file.
  std::int64_t number(const char* what) {
    skip_space();
    if (rest_.empty()) return -1;
    std::int64_t value = 0;
    bool any = false;
    while (!rest_.empty() && rest_[0] >= '0' && rest_[0] <= '9' && value < number_max) {
      value = 10 * value + (rest_[0] - '0');
      rest_.remove_prefix(1);
      any = true;
    }
    if (!any) fail(std::string("expected ") + what + " as a decimal number");
    return value;
  }

  std::size_t left() const { return rest_.size(); }

 private:
  static bool is_space(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

  void skip_space() {
    while (!rest_.empty()) {
      if (rest_[0] == '#') {
        while (!rest_.empty() && rest_[0] != '\n') rest_.remove_prefix(1);
      } else if (is_space(rest_[0])) {
        rest_.remove_prefix(1);
      } else {
        return;
      }
    }
  }

  std::string_view rest_;
  const std::string& file_;
};

// Scales a value from 0 ... `value_max` to 0 ... 255, rounded.
std::uint8_t scaled(std::int64_t value, std::int64_t value_max) {
  return static_cast<std::uint8_t>((510 * value + value_max) / (2 * value_max));
}

[[noreturn]] void refuse_pixel(const Reader& in, std::int64_t value, std::int64_t value_max) {
  in.fail("expected pixels from 0 to " + std::to_string(value_max) + ", found " + std::to_string(value));
}

void read_raw(Reader& in, std::size_t count, std::int64_t value_max, std::vector<std::uint8_t>& grey) {
  in.take(1);  // the single white space after the head
  const std::size_t bytes = value_max > 255 ? 2 * count : count;
  if (in.left() < bytes) {
    in.fail("the image is cut short: expected " + std::to_string(bytes) + " bytes of pixels, found " +
            std::to_string(in.left()));
  }
  const auto byte = [](char c) { return std::int64_t{static_cast<std::uint8_t>(c)}; };
  const std::string_view pixels = in.take(bytes);
  for (std::size_t i = 0; i < count; ++i) {
    const std::int64_t value = value_max > 255 ? 256 * byte(pixels[2 * i]) + byte(pixels[2 * i + 1]) : byte(pixels[i]);
    if (value > value_max) refuse_pixel(in, value, value_max);
    grey.push_back(scaled(value, value_max));
  }
}

void read_plain(Reader& in, std::size_t count, std::int64_t value_max, std::vector<std::uint8_t>& grey) {
  for (std::size_t i = 0; i < count; ++i) {
    const std::int64_t value = in.number("a pixel");
    if (value < 0) {
      in.fail("the image is cut short: expected " + std::to_string(count) + " pixels, found " + std::to_string(i));
    }
    if (value > value_max) refuse_pixel(in, value, value_max);
    grey.push_back(scaled(value, value_max));
  }
}

}  // namespace

GreyImage parse_pgm(std::string_view contents, const std::string& file) {
  Reader in(contents, file);
  const std::string_view magic = in.take(2);
  if (magic != "P5" && magic != "P2") in.fail("expected a PGM image, which starts with P5 or P2");
  const std::int64_t width = in.number("the width"), height = in.number("the height");
  const std::int64_t value_max = in.number("the greatest value");
  if (value_max < 0) in.fail("the image is cut short: expected width, height and greatest value");
  if (width < 1 || height < 1 || width > OccupancyGrid::cells_max / height) {
    in.fail("expected 1 to " + std::to_string(OccupancyGrid::cells_max) + " pixels, found " + std::to_string(width) +
            " x " + std::to_string(height));
  }
  if (value_max < 1 || value_max > 65535) {
    in.fail("expected a greatest value from 1 to 65535, found " + std::to_string(value_max));
  }
  GreyImage image = {static_cast<int>(width), static_cast<int>(height), {}, {}};
  const std::size_t count = static_cast<std::size_t>(width * height);
  // At most the file's size, since the header may be wrong.
  image.grey.reserve(count < contents.size() ? count : contents.size());
  if (magic == "P5") {
    read_raw(in, count, value_max, image.grey);
  } else {
    read_plain(in, count, value_max, image.grey);
  }
  return image;
}

}  // namespace waitpoint::world
