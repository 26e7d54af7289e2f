// SPDX-License-Identifier: BSD-3-Clause
#include "core/file_list.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

#include "core/error.hpp"
#include "core/file_contents.hpp"

namespace waitpoint {
namespace {

namespace fs = std::filesystem;

class FileListTest : public testing::Test {
 protected:
  FileListTest() {
    std::string pattern = fs::temp_directory_path() / "file-list-XXXXXX";
    top_ = mkdtemp(pattern.data());
    for (const char* file : {"a", "b"}) std::ofstream(top_ / file) << "x";
    fs::create_symlink(top_ / "a", top_ / "link");
  }
  ~FileListTest() override { fs::remove_all(top_); }

  static std::string text() {
    std::string all;
    for (const ListedFile& file : FileList::files())
      all += std::string(to_string(file.use)) + " " + fs::path(file.name).filename().string() + "\n";
    return all;
  }
  static std::string complaint(const fs::path& output) {
    try {
      FileList::add_output(output);
    } catch (const BadInput& bad) {
      return std::string(bad.what()).substr(output.string().size());
    }
    return "";
  }

  fs::path top_;
};

TEST_F(FileListTest, NotesNothingWithoutAList) {
  FileList::add(top_ / "a", FileRole::read);
  EXPECT_NO_THROW(FileList::add_output(top_ / "a"));
  EXPECT_TRUE(FileList::files().empty());
}

TEST_F(FileListTest, HasEachFileOnceInTheOrderOfReading) {
  const FileList list;
  file_contents(top_ / "b", "a file", 10);
  given_file_contents(top_ / "link", 10);
  file_contents(top_ / "a", "a file", 10);
  FileList::add(top_ / "new", FileRole::written);
  FileList::add(top_, FileRole::folder);
  EXPECT_EQ(text(), "read b\nread link\nwritten new\nfolder " + top_.filename().string() + "\n");
}

TEST_F(FileListTest, ListWithinAnotherIsEmptyAndEndsByItself) {
  const FileList outer;
  FileList::add(top_ / "a", FileRole::read);
  {
    const FileList inner;
    EXPECT_EQ(text(), "");
    EXPECT_EQ(complaint(top_ / "a"), "");
  }
  EXPECT_EQ(text(), "read a\n");
}

TEST_F(FileListTest, RefusesAnOutputThatIsReadByAnyName) {
  const FileList list;
  FileList::add(top_ / "link", FileRole::read);
  FileList::add(top_ / "b", FileRole::executed);
  FileList::add(top_ / "new", FileRole::written);
  for (const fs::path& name : {top_ / "a", top_ / "link", top_ / "." / "a", top_ / "b"})
    EXPECT_EQ(complaint(name), ": cannot be an output: it is also read");
  EXPECT_EQ(complaint(top_ / "new"), ": cannot be an output: it is another output of the scenario");
  EXPECT_EQ(complaint(top_ / "other"), "");
}

TEST_F(FileListTest, RefusesToReadAnOutputAndThenTheOutputItself) {
  const FileList list;
  FileList::add_output(top_ / "a");
  FileList::add_output(top_ / "a");
  EXPECT_THROW(file_contents(top_ / "link", "a file", 10), BadInput);
  EXPECT_EQ(complaint(top_ / "a"), ": cannot be an output: it is also read");
}

TEST_F(FileListTest, AllowsOutputsBelowAFolderOfScriptsAndDevices) {
  const FileList list;
  FileList::add(top_, FileRole::folder);
  EXPECT_EQ(complaint(top_ / "a"), "");
  FileList::add("/dev/null", FileRole::read);
  EXPECT_EQ(complaint("/dev/null"), "");
}

}  // namespace
}  // namespace waitpoint
