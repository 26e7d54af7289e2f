// SPDX-License-Identifier: BSD-3-Clause
#include "world/formats/map_server.hpp"

#include <gtest/gtest.h>
#include <png.h>

#include <cstdio>
#include <cstring>
#include <vector>

#include "core/file_contents.hpp"
#include "tests/world/formats/files.hpp"

namespace waitpoint::world {
namespace {

const std::string head = "image: map.pgm\nresolution: 0.5\norigin: [1, 2, 0]\n";

std::string pgm(const std::string& pixels, const std::string& size = "3 2") {
  return "P5\n" + size + "\n255\n" + pixels;
}

// The cells row by row from the top, as in the image: '.' free, '#' occupied, '?' unknown.
std::string drawn(const OccupancyGrid& grid) {
  std::string text;
  for (int y = grid.height() - 1; y >= 0; --y) {
    for (int x = 0; x < grid.width(); ++x) text += ".#?"[static_cast<int>(grid[{x, y}])];
    if (y > 0) text += '/';
  }
  return text;
}

void write_png(const std::string& file, std::uint32_t format, std::uint32_t width, std::uint32_t height,
               const std::vector<std::uint8_t>& pixels) {
  png_image image;
  std::memset(&image, 0, sizeof image);
  image.version = PNG_IMAGE_VERSION;
  image.width = width;
  image.height = height;
  image.format = format;
  ASSERT_NE(png_image_write_to_file(&image, file.c_str(), 0, pixels.data(), 0, nullptr), 0);
}

testing::AssertionResult rejects_map(const std::string& yaml, const std::string& where, const std::string& what) {
  return complains([&] { read_map_server_map(yaml); }, where, what);
}

TEST(MapServer, ReadsRawPgmFromTheTop) {
  const Folder folder;
  const std::string yaml = folder.write("map.yaml", head);
  folder.write("map.pgm", pgm(std::string("\xFE\x00\xCD\x00\xFE\xFE", 6)));
  const OccupancyGrid grid = read_map_server_map(yaml);
  EXPECT_EQ(drawn(grid), ".#?/#..");
  EXPECT_EQ(grid.resolution_m(), 0.5);
  EXPECT_EQ(grid.origin(), (Pose{1, 2, 0}));
  EXPECT_EQ(grid.cell_at({1.2, 2.2}), (CellIndex{0, 0})) << "the origin is the lower left corner";
}

TEST(MapServer, ReadsPlainPgmWithCommentsAnywhere) {
  const Folder folder;
  const std::string yaml = folder.write("map.yaml", head);
  folder.write("map.pgm", "P2 # made by hand\n# GIMP\n3 # wide\n2\n255\n254 0 205 # first row\n0 254\t254\n");
  EXPECT_EQ(drawn(read_map_server_map(yaml)), ".#?/#..");
}

TEST(MapServer, APixelThatLooksLikeACommentIsAPixel) {
  const Folder folder;
  const std::string yaml = folder.write("map.yaml", head);
  folder.write("map.pgm", "P5\n# comment\n3 2\n255\n##\n\n##");
  EXPECT_EQ(drawn(read_map_server_map(yaml)), "###/###");
}

TEST(MapServer, ReadsPngGreyAndColourAndTransparency) {
  const Folder folder;
  const std::string yaml =
      folder.write("map.yaml", "image: map.png\nresolution: 0.5\norigin: [1, 2, 0]\nmode: scale\n");
  write_png(folder.path("map.png"), PNG_FORMAT_GRAY, 3, 2, {254, 0, 205, 0, 254, 254});
  EXPECT_EQ(drawn(read_map_server_map(yaml)), ".#?/#..");
  write_png(folder.path("map.png"), PNG_FORMAT_RGB, 3, 1, {254, 254, 254, 0, 0, 0, 255, 180, 180});
  EXPECT_EQ(drawn(read_map_server_map(yaml)), ".#?");
  write_png(folder.path("map.png"), PNG_FORMAT_RGBA, 3, 1, {254, 254, 254, 255, 0, 0, 0, 255, 0, 0, 0, 0});
  EXPECT_EQ(drawn(read_map_server_map(yaml)), ".#?");
}

TEST(MapServer, ThresholdsNegateAndModes) {
  const Folder folder;
  folder.write("map.pgm", pgm(std::string("\x00\x1E\x50\x64\x80\xFF", 6), "6 1"));  // 0 30 80 100 128 255
  const auto read = [&](const std::string& more) {
    return drawn(read_map_server_map(folder.write("m.yaml", head + more)));
  };
  EXPECT_EQ(read(""), "###??.");
  EXPECT_EQ(read("negate: 1"), "..???#");
  EXPECT_EQ(read("occupied_thresh: 0.45\nfree_thresh: 0.3"), "#####.");
  EXPECT_EQ(read("mode: scale"), read("mode: trinary"));
  EXPECT_EQ(read("mode: raw"), ".?##??");
}

TEST(MapServer, OtherPeoplesKeysAreLeftOutAndTold) {
  const Folder folder;
  folder.write("map.pgm", pgm(std::string("\x00\x80\xFF", 3), "3 1"));
  const std::string yaml =
      folder.write("m.yaml", head + "type: occupancy_grid\nlayers: [1, {a: b}]\nocupied_thresh: 0.2\n");
  LeftOut left_out;
  EXPECT_EQ(drawn(parse_map_server_map(file_contents(yaml, "a map", 1000), yaml, left_out)), "#?.");
  EXPECT_EQ(left_out.warnings(), (std::vector<std::string>{
                                     yaml + ":4: the key 'type' is left out",
                                     yaml + ":5: the key 'layers' is left out",
                                     yaml + ":6: the key 'ocupied_thresh' is left out, did you mean 'occupied_thresh'?",
                                 }));
}

TEST(MapServer, AFreeThresholdAboveTheOccupiedOneIsTold) {
  const Folder folder;
  folder.write("map.pgm", pgm(std::string("\x00\x80\xF9\xFF", 4), "4 1"));
  const std::string yaml = folder.write("m.yaml", head + "occupied_thresh: 0.05\n");
  LeftOut left_out;
  EXPECT_EQ(drawn(parse_map_server_map(file_contents(yaml, "a map", 1000), yaml, left_out)), "##..");
  EXPECT_EQ(left_out.warnings(),
            std::vector<std::string>{yaml + ":4: 'free_thresh' above 'occupied_thresh' leaves no cell unknown"});
}

TEST(MapServer, AnImageThatIsNotThereIsReadFromBesideTheMap) {
  const Folder folder;
  const std::string pixels = pgm(std::string("\x00\xFF", 2), "2 1"), place = "\nresolution: 0.5\norigin: [0, 0, 0]\n";
  folder.write("floor.pgm", pixels);
  const std::string yaml = folder.write("m.yaml", "image: /nowhere/maps/floor.pgm" + place);
  LeftOut left_out;
  EXPECT_EQ(drawn(parse_map_server_map(file_contents(yaml, "a map", 1000), yaml, left_out)), "#.");
  EXPECT_EQ(left_out.warnings(),
            std::vector<std::string>{yaml +
                                     ":1: '/nowhere/maps/floor.pgm', which is not there, is read from beside the map"});
  EXPECT_TRUE(rejects_map(folder.write("n.yaml", "image: /nowhere/maps/cellar.pgm" + place),
                          "/nowhere/maps/cellar.pgm: ", "no file"));
}

TEST(MapServer, ATurnedOriginTurnsTheMap) {
  const Folder folder;
  folder.write("map.pgm", pgm(std::string("\xFE\x00\xCD\x00\xFE\xFE", 6)));
  const OccupancyGrid grid = read_map_server_map(
      folder.write("map.yaml", "image: map.pgm\nresolution: 0.5\norigin: [1, 2, 1.5707963267948966]\n"));
  EXPECT_NEAR(grid.centre({2, 0}).x, 1 - 0.25, 1e-12);
  EXPECT_NEAR(grid.centre({2, 0}).y, 2 + 1.25, 1e-12);
}

TEST(MapServer, APgmOfAnyDepthIsRead) {
  const Folder folder;
  const std::string yaml = folder.write("map.yaml", head);
  const auto read = [&](const std::string& image) {
    folder.write("map.pgm", image);
    return drawn(read_map_server_map(yaml));
  };
  const std::string shallow = read("P2 4 1 255  0 80 140 255");
  EXPECT_EQ(shallow, "##?.");
  EXPECT_EQ(read("P5 4 1 65535\n" + std::string("\0\0\x50\x50\x8c\x8c\xff\xff", 8)), shallow);
  EXPECT_EQ(read("P2 4 1 65535  0 20560 35980 65535"), shallow);
  EXPECT_EQ(read("P5 4 1 100\n" + std::string("\0\x1f\x37\x64", 4)), shallow);
  EXPECT_EQ(read("P2 4 1 1  0 0 1 1"), "##..");
}

// A PNG written line by line, of any depth and kind.
void write_any_png(const std::string& file, png_uint_32 width, int depth, int colour_type, int interlacing,
                   std::vector<std::uint8_t> row) {
  std::FILE* out = std::fopen(file.c_str(), "wb");
  ASSERT_NE(out, nullptr);
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);
  png_init_io(png, out);
  png_set_IHDR(png, info, width, 2, depth, colour_type, interlacing, PNG_COMPRESSION_TYPE_DEFAULT,
               PNG_FILTER_TYPE_DEFAULT);
  const png_color palette[] = {{0, 0, 0}, {80, 80, 80}, {140, 140, 140}, {255, 255, 255}};
  if (colour_type == PNG_COLOR_TYPE_PALETTE) png_set_PLTE(png, info, palette, 4);
  png_write_info(png, info);
  png_bytep rows[] = {row.data(), row.data()};
  png_write_image(png, rows);
  png_write_end(png, nullptr);
  png_destroy_write_struct(&png, &info);
  std::fclose(out);
}

TEST(MapServer, APngOfAnyKindIsRead) {
  const Folder folder;
  const std::string yaml = folder.write("map.yaml", "image: map.png\nresolution: 0.5\norigin: [1, 2, 0]\n");
  const auto read = [&](int depth, int colour_type, const std::vector<std::uint8_t>& row, png_uint_32 width = 4) {
    std::string both;
    for (const int interlacing : {PNG_INTERLACE_NONE, PNG_INTERLACE_ADAM7}) {
      write_any_png(folder.path("map.png"), width, depth, colour_type, interlacing, row);
      both += drawn(read_map_server_map(yaml)) + (interlacing == PNG_INTERLACE_NONE ? " " : "");
    }
    return both;
  };
  const std::string expected = "##?./##?. ##?./##?.";
  EXPECT_EQ(read(8, PNG_COLOR_TYPE_GRAY, {0, 80, 140, 255}), expected);
  EXPECT_EQ(read(16, PNG_COLOR_TYPE_GRAY, {0, 0, 80, 80, 140, 140, 255, 255}), expected);
  EXPECT_EQ(read(16, PNG_COLOR_TYPE_RGB, {0,   0,   0,   0,   0,   0,   80,  80,  80,  80,  80,  80,
                                          140, 140, 140, 140, 140, 140, 255, 255, 255, 255, 255, 255}),
            expected);
  EXPECT_EQ(read(8, PNG_COLOR_TYPE_PALETTE, {0, 1, 2, 3}), expected);
  EXPECT_EQ(read(2, PNG_COLOR_TYPE_PALETTE, {0b00011011}), expected);
  EXPECT_EQ(read(1, PNG_COLOR_TYPE_GRAY, {0b00110000}), "##../##.. ##../##..");
  EXPECT_EQ(read(4, PNG_COLOR_TYPE_GRAY, {0x05, 0x8f}), expected);
}

// The checksum of a chunk: CRC-32 of its type and data.
std::uint32_t png_checksum(const std::string& chunk) {
  std::uint32_t crc = 0xFFFFFFFF;
  for (const char c : chunk) {
    crc ^= static_cast<std::uint8_t>(c);
    for (int bit = 0; bit < 8; ++bit) crc = (crc & 1) != 0 ? (crc >> 1) ^ 0xEDB88320 : crc >> 1;
  }
  return ~crc;
}

TEST(MapServer, APngThatPromisesMoreThanItHoldsTakesNoMemory) {
  const Folder folder;
  const std::string yaml = folder.write("map.yaml", "image: map.png\nresolution: 0.5\norigin: [1, 2, 0]\n");
  write_any_png(folder.path("map.png"), 16000, 8, PNG_COLOR_TYPE_GRAY, PNG_INTERLACE_NONE,
                std::vector<std::uint8_t>(16000));
  std::fstream file(folder.path("map.png"), std::ios::in | std::ios::out | std::ios::binary);
  // The height becomes 16 000, with the checksum of the first chunk to match.
  std::string head(33, ' ');
  file.read(head.data(), 33);
  head[22] = '\x3e';
  head[23] = '\x80';
  const std::uint32_t crc = png_checksum(head.substr(12, 17));
  for (int i = 0; i < 4; ++i) head[29 + static_cast<std::size_t>(i)] = static_cast<char>(crc >> (24 - 8 * i));
  file.seekp(0);
  file.write(head.data(), 33);
  file.close();
  EXPECT_TRUE(rejects_map(yaml, folder.path("map.png") + ": ", "the PNG image is cut short"));
}

struct BadYaml {
  const char* contents;
  int line;
  const char* says;
};

TEST(MapServer, EveryBadYamlIsNamedByFileAndLine) {
  const Folder folder;
  folder.write("map.pgm", pgm(std::string(6, '\0')));
  const std::vector<BadYaml> cases = {
      {"image: map.pgm\nresolution: 0.05\n", 1, "expected the key 'origin'"},
      {"resolution: 0.05\norigin: [0, 0, 0]\n", 1, "expected the key 'image'"},
      {"image: map.pgm\norigin: [0, 0, 0]\n", 1, "expected the key 'resolution'"},
      {"image: map.pgm\nresolution: 0.05\nresolution: 0.06\norigin: [0, 0, 0]\n", 3, "twice"},
      {"image: map.pgm\nresolution: -0.05\norigin: [0, 0, 0]\n", 2, "from 0.0001 to 1000"},
      {"image: map.pgm\nresolution: 1e-300\norigin: [0, 0, 0]\n", 2, "from 0.0001 to 1000"},
      {"image: map.pgm\nresolution: 1e300\norigin: [0, 0, 0]\n", 2, "from 0.0001 to 1000"},
      {"image: map.pgm\nresolution: 0.05\norigin: [1e308, 0, 0]\n", 3, "within 10000 km"},
      {"image: map.pgm\nresolution: five\norigin: [0, 0, 0]\n", 2, "expected a number"},
      {"image: map.pgm\nresolution: .nan\norigin: [0, 0, 0]\n", 2, "expected a number"},
      {"image: map.pgm\nresolution: 0.05\norigin: [0, 0]\n", 3, "[x, y, yaw]"},
      {"image: map.pgm\nresolution: 0.05\norigin: [0, zero, 0]\n", 3, "expected a number"},
      {"image: map.pgm\nresolution: 0.05\norigin: [0, 0, 0]\nnegate: maybe\n", 4, "0 or 1"},
      {"image: map.pgm\nresolution: 0.05\norigin: [0, 0, 0]\nfree_thresh: 1.2\n", 4, "from 0 to 1"},
      {"image: map.pgm\nresolution: 0.05\norigin: [0, 0, 0]\nmode: binary\n", 4, "trinary, scale or raw"},
      {"image: [a, b]\nresolution: 0.05\norigin: [0, 0, 0]\n", 1, "expected a text"},
      {"- image\n- resolution\n", 1, "expected a map's keys"},
      {"image: map.pgm\nresolution: 0.05\norigin: &a [*a, 0, 0]\n", 3, "expected"},
      {"&a image: map.pgm\nresolution: 0.05\norigin: [0, 0, *a]\n", 1, "expected a number"},
      {"image: map.pgm\nresolution: [0.05\norigin: 3\n", 3, "expected YAML"},
      {"image: map.pgm\n  resolution: 0.05\n", 2, "expected YAML"},
  };
  for (const BadYaml& bad : cases) {
    const std::string yaml = folder.write("map.yaml", bad.contents);
    EXPECT_TRUE(rejects_map(yaml, yaml + ":" + std::to_string(bad.line) + ": ", bad.says)) << bad.contents;
  }
  const std::string none = folder.path("none.yaml");
  EXPECT_TRUE(rejects_map(none, none + ": ", "no file"));
  const std::string empty = folder.write("empty.yaml", "");
  EXPECT_TRUE(rejects_map(empty, empty + ": ", "an empty one"));
  const std::string deep = folder.write("deep.yaml", "origin: " + std::string(100000, '['));
  EXPECT_TRUE(rejects_map(deep, deep + ":1: ", "expected YAML"));
  const std::string large = folder.write("large.yaml", head + std::string(2 << 20, '#'));
  EXPECT_TRUE(rejects_map(large, large + ": ", "of at most 1 MiB"));
}

struct BadImage {
  std::string contents;
  const char* says;
};

TEST(MapServer, EveryBadImageIsNamed) {
  const Folder folder;
  const std::string yaml = folder.write("map.yaml", head), image = folder.path("map.pgm");
  EXPECT_TRUE(rejects_map(yaml, image + ": ", "no file"));
  const std::vector<BadImage> cases = {
      {"", "no file or an empty one"},
      {"GIF89a", "expected a PGM image (P5 or P2) or a PNG image"},
      {"P6\n3 2\n255\nxxxxxx", "P5 or P2"},
      {"P", "P5 or P2"},
      {"P5", "cut short"},
      {"P5\n3 2\n", "cut short"},
      {"P5\nthree 2\n255\n", "expected the width"},
      {"P5\n-3 2\n255\n", "expected the width"},
      {"P5\n0 2\n255\n", "pixels, found 0 x 2"},
      {"P5\n3 2\n65536\n" + std::string(24, 'x'), "greatest value from 1 to 65535, found 65536"},
      {"P5\n3 2\n0\nxxxxxx", "greatest value from 1 to 65535, found 0"},
      {"P5\n3 2\n65535\n" + std::string(11, 'x'), "expected 12 bytes of pixels, found 11"},
      {"P5\n3 2\n100\nxxxxxx", "from 0 to 100, found 120"},
      {"P5\n3 2\n255\nxxxxx", "expected 6 bytes of pixels, found 5"},
      {"P5\n100000 100000\n255\nxxxxx", "pixels, found 100000 x 100000"},
      {"P5\n99999999999999999999 1\n255\nxxxxx", "expected"},
      {"P5\n16384 16384\n255\nxxxxx", "cut short"},
      {"P2\n3 2\n255\n1 2 3 4 5", "expected 6 pixels, found 5"},
      {"P2\n3 2\n255\n1 2 3 4 5 256", "from 0 to 255, found 256"},
      {"P2\n3 2\n255\n1 2 3 4 5 x", "expected a pixel"},
      {std::string("\x89PNG\r\n\x1a\n") + "nothing", "PNG"},
  };
  for (const BadImage& bad : cases) {
    folder.write("map.pgm", bad.contents);
    EXPECT_TRUE(rejects_map(yaml, image + ": ", bad.says)) << bad.contents;
  }
}

TEST(MapServer, ATruncatedPngIsNamed) {
  const Folder folder;
  const std::string yaml = folder.write("map.yaml", "image: map.png\nresolution: 0.5\norigin: [1, 2, 0]\n");
  std::vector<std::uint8_t> pixels(10'000);
  for (std::size_t i = 0; i < pixels.size(); ++i) pixels[i] = static_cast<std::uint8_t>(i * i * 7 >> 3);
  write_png(folder.path("map.png"), PNG_FORMAT_GRAY, 100, 100, pixels);
  const auto size = std::filesystem::file_size(folder.path("map.png"));
  for (const auto left : {size / 2, size / 10, std::uintmax_t{20}}) {
    std::filesystem::resize_file(folder.path("map.png"), left);
    EXPECT_TRUE(rejects_map(yaml, folder.path("map.png") + ": ", "PNG"));
  }
}

TEST(MapServer, AFolderIsNoMap) {
  const Folder folder;
  EXPECT_TRUE(rejects_map(folder.path(""), folder.path(""), "found no regular file"));
}

}  // namespace
}  // namespace waitpoint::world
