// SPDX-License-Identifier: BSD-3-Clause
#include "tools/output/output_file.hpp"

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "tests/tools/folder.hpp"

namespace waitpoint::tools {
namespace {

namespace fs = std::filesystem;

TEST(OutputFile, takes_its_name_only_when_it_is_whole) {
  const Folder folder;
  OutputFile file(folder / "out.txt");
  file.write("one\n");
  EXPECT_FALSE(fs::exists(folder / "out.txt"));
  file.write("two\n");
  file.commit();
  EXPECT_EQ(folder.read("out.txt"), "one\ntwo\n");
  EXPECT_EQ(folder.count(), 1u) << "no temporary file is left";
}

TEST(OutputFile, that_is_given_up_leaves_what_was_there) {
  const Folder folder;
  folder.write("out.txt", "old");
  {
    OutputFile file(folder / "out.txt");
    file.write("new");
  }
  EXPECT_EQ(folder.read("out.txt"), "old");
  EXPECT_EQ(folder.count(), 1u);
}

TEST(OutputFile, replaces_what_was_there) {
  const Folder folder;
  folder.write("out.txt", "a longer old text");
  OutputFile file(folder / "out.txt");
  file.write("new");
  file.commit();
  EXPECT_EQ(folder.read("out.txt"), "new");
}

TEST(OutputFile, writes_to_what_a_link_points_to) {
  const Folder folder;
  folder.write("real.txt", "old");
  fs::create_symlink("real.txt", folder / "link.txt");
  OutputFile file(folder / "link.txt");
  file.write("new");
  file.commit();
  EXPECT_TRUE(fs::is_symlink(folder / "link.txt"));
  EXPECT_EQ(folder.read("real.txt"), "new");
}

TEST(OutputFile, leaves_a_device_a_device) {
  OutputFile file("/dev/null");
  file.write("gone");
  file.commit();
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

TEST(OutputFile, that_cannot_be_written_is_told_at_once) {
  const Folder folder;
  const auto message = [&](const fs::path& path) -> std::string {
    try {
      OutputFile file(path);
    } catch (const BadInput& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(message(folder / "no/such/out.txt"),
            (folder / "no/such/out.txt").string() + ": cannot be written: No such file or directory");
  EXPECT_EQ(message(folder / "."), (folder / ".").string() + ": cannot be written: it is a folder");
}

TEST(OutputFile, on_a_full_medium_is_told) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  OutputFile file("/dev/full");
  file.write("x");
  EXPECT_THROW(file.commit(), BadInput);
}

}  // namespace
}  // namespace waitpoint::tools
