// SPDX-License-Identifier: BSD-3-Clause
#include "core/file_contents.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>
#include <functional>

#include "core/error.hpp"

namespace waitpoint {
namespace {

std::string complaint(const std::function<void()>& read) {
  try {
    read();
  } catch (const BadInput& bad) {
    return bad.what();
  }
  return "";
}

TEST(FileContents, RefusesAPipeNamedByInputWithoutOpeningIt) {
  std::string folder = std::filesystem::temp_directory_path() / "contents-XXXXXX";
  ASSERT_NE(mkdtemp(folder.data()), nullptr);
  const std::string pipe = folder + "/pipe";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_EQ(complaint([&] { file_contents(pipe, "a map", 10); }), pipe + ": expected a map, found no regular file");
  std::filesystem::remove_all(folder);
}

TEST(FileContents, ReadsAPipeNamedByTheUser) {
  int ends[2];
  ASSERT_EQ(pipe(ends), 0);
  ASSERT_EQ(write(ends[1], "text", 4), 4);
  close(ends[1]);
  EXPECT_EQ(given_file_contents("/dev/fd/" + std::to_string(ends[0]), 4), "text");
  close(ends[0]);
}

TEST(FileContents, AreLimited) {
  EXPECT_EQ(complaint([] { given_file_contents("/dev/zero", std::size_t{2} << 20); }),
            "/dev/zero: expected a file of at most 2 MiB");
  EXPECT_EQ(complaint([] { given_file_contents("/dev", 1); }), "/dev: is a folder, expected a file");
  EXPECT_EQ(complaint([] { given_file_contents("/dev/gone", 1); }),
            "/dev/gone: cannot be read: No such file or directory");
}

}  // namespace
}  // namespace waitpoint
