// SPDX-License-Identifier: BSD-3-Clause
#include "world/formats/world_file.hpp"

#include <gtest/gtest.h>

#include "tests/world/formats/files.hpp"

namespace waitpoint::world {
namespace {

TEST(WorldFile, ItsFirstWordsTellItsKind) {
  EXPECT_EQ(format_of("<?xml version='1.0'?><sdf/>"), WorldFormat::sdf);
  EXPECT_EQ(format_of("\n  <sdf version='1.6'>"), WorldFormat::sdf);
  EXPECT_EQ(format_of("# walls\n-1.5 0 3 0\n"), WorldFormat::segments);
  EXPECT_EQ(format_of(".5 0 3 0"), WorldFormat::segments);
  EXPECT_EQ(format_of("# a map\r\n\r\nimage: map.pgm\n"), WorldFormat::map_server);
  EXPECT_EQ(format_of("\xEF\xBB\xBFimage: map.pgm\n"), WorldFormat::map_server);
  EXPECT_EQ(format_of("---\nimage: map.pgm\n"), WorldFormat::map_server);
  EXPECT_EQ(format_of("{image: map.pgm}"), WorldFormat::map_server);
  EXPECT_EQ(format_of("# simple.world\ninclude \"map.inc\"\n"), WorldFormat::stage);
  EXPECT_EQ(format_of("floorplan( size [1 1 1] )"), WorldFormat::stage);
}

TEST(WorldFile, RefusesUnknownFormats) {
  const Folder folder;
  const auto refuses = [&](const std::string& contents) {
    const std::string file = folder.write("some", contents);
    return complains([&] { read_world_file(file, 2); }, file, "expected a world: a map_server YAML file");
  };
  EXPECT_TRUE(refuses(""));
  EXPECT_TRUE(refuses("# nothing but this\n"));
  EXPECT_TRUE(refuses("\x89PNG\r\n\x1a\n"));
  EXPECT_TRUE(refuses(std::string(1000, '\0')));
  EXPECT_TRUE(complains([&] { read_world_file(folder.path("."), 2); }, folder.path("."), "found no regular file"));
  EXPECT_TRUE(complains([&] { read_world_file(folder.path("none"), 2); }, folder.path("none"), "found no file"));
}

TEST(WorldFile, AFileThatIsTooLargeIsRefused) {
  const Folder folder;
  const std::string file = folder.write("large", "0 0 1 1\n");
  std::filesystem::resize_file(file, (std::uintmax_t{1} << 26) + 1);
  EXPECT_TRUE(complains([&] { read_world_file(file, 2); }, file, "of at most 64 MiB"));
}

TEST(WorldFile, AFileWithoutEndIsRefused) {
  if (!std::filesystem::exists("/dev/zero")) GTEST_SKIP() << "no /dev/zero";
  EXPECT_TRUE(complains([] { read_world_file("/dev/zero", 2); }, "/dev/zero: ", "found no regular file"));
}

TEST(WorldFile, AMapOfCellsKeepsItsCells) {
  const Folder folder;
  folder.write("map.pgm", std::string("P5 3 1 255\n") + '\0' + '\0' + '\xFF');
  const WorldFile world =
      read_world_file(folder.write("map.yaml", "image: map.pgm\nresolution: 0.5\norigin: [1, 2, 0]\n"), 1.25);
  ASSERT_TRUE(world.grid.has_value());
  EXPECT_EQ(world.grid->width(), 3);
  ASSERT_EQ(world.obstacles.size(), 1u);
  EXPECT_EQ(world.obstacles[0].shape.pose, (Pose{1.5, 2.25, 0}));
  EXPECT_EQ(world.obstacles[0].shape.z_high_m, 1.25);
}

}  // namespace
}  // namespace waitpoint::world
