// SPDX-License-Identifier: BSD-3-Clause
// The files that a script reads and writes: those of its folders.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "tests/modules/tcl/scripted_robot.hpp"

namespace waitpoint::tcl {
namespace {

namespace fs = std::filesystem;

class ScriptFilesTest : public testing::Test {
 protected:
  ScriptFilesTest() {
    std::string pattern = testing::TempDir() + "waitpoint-XXXXXX";
    root_ = mkdtemp(pattern.data());
    fs::create_directories(root_ / "own/below");
    fs::create_directories(root_ / "other");
    std::ofstream(root_ / "own/a.txt") << "of a";
    std::ofstream(root_ / "other/b.txt") << "of b";
    fs::create_symlink(root_ / "other", root_ / "own/link");
    robot_.folders = {(root_ / "own").string()};
  }

  ~ScriptFilesTest() override { fs::remove_all(root_); }

  std::string other(const std::string& name) const { return (root_ / "other" / name).string(); }
  bool fails(const std::string& script) { return !robot_.run(script).ok; }
  static std::string contents(const fs::path& file) {
    std::ostringstream text;
    text << std::ifstream(file).rdbuf();
    return text.str();
  }

  fs::path root_;
  ScriptedRobot robot_;
};

TEST_F(ScriptFilesTest, RelativeNamesAreInItsFirstFolder) {
  EXPECT_EQ(robot_.run("set f [open a.txt]; set text [read $f]; close $f; set text").text, "of a");
  EXPECT_EQ(robot_.run("list [file exists a.txt] [file size a.txt] [file isdirectory below] [glob *.txt]").text,
            "1 4 1 a.txt");
  EXPECT_TRUE(robot_.run("file mkdir new; set f [open new/c.txt w]; puts $f hello; close $f").ok);
  EXPECT_EQ(contents(root_ / "own/new/c.txt"), "hello\n");
  EXPECT_TRUE(robot_.run("file copy a.txt d.txt; file rename d.txt e.txt; file delete a.txt").ok);
  EXPECT_EQ(contents(root_ / "own/e.txt"), "of a");
  EXPECT_FALSE(fs::exists(root_ / "own/a.txt"));
}

TEST_F(ScriptFilesTest, NoFileElsewhereIsReadWrittenOrListed) {
  for (const std::string& name : {other("b.txt"), std::string("../other/b.txt"), std::string("link/b.txt"),
                                  std::string("below/../../other/b.txt"), std::string("/etc/passwd")})
    for (const char* command :
         {"open %", "open % w", "open % r+", "source %", "file size %", "file delete %", "file copy % c.txt",
          "file copy a.txt %", "file rename % c.txt", "file rename a.txt %", "file mkdir %", "file normalize %",
          "file type %", "glob %", "glob -directory % *", "glob -path % *", "fcopy [open %] [open c.txt w]"}) {
      std::string script = command;
      script.replace(script.find('%'), 1, name);
      EXPECT_TRUE(fails(script)) << script;
    }
  EXPECT_EQ(robot_.run("file exists /etc/passwd").text, "0");
  EXPECT_TRUE(fails("glob link/*"));
  EXPECT_TRUE(fails("glob {{a,../other/b}.txt}"));
  EXPECT_TRUE(fails("glob -directory below ../../other/*"));
  EXPECT_TRUE(fails("open {|ls}"));
  EXPECT_EQ(contents(other("b.txt")), "of b");
  EXPECT_EQ(contents(root_ / "own/a.txt"), "of a");
}

TEST_F(ScriptFilesTest, FurtherFoldersMayBeAllowed) {
  robot_.folders.push_back((root_ / "other").string());
  EXPECT_EQ(robot_.run("set f [open " + other("b.txt") + "]; read $f").text, "of b");
}

TEST_F(ScriptFilesTest, NoneWithoutFolders) {
  robot_.folders.clear();
  EXPECT_TRUE(fails("open a.txt w"));
  EXPECT_TRUE(fails("glob *"));
}

TEST_F(ScriptFilesTest, PackagesOfTclAreReadAndNotWritten) {
  EXPECT_TRUE(robot_.run("package require msgcat").ok);
  EXPECT_TRUE(fails("open [file join $::tcl_library init.tcl] a"));
}

TEST(Puts, WritesPrintableLines) {
  ScriptedRobot robot;
  robot.run("puts \"a\\u001b\\[31m b\\rc\"");
  EXPECT_EQ(robot.said, std::vector<std::string>{"a?[31m b?c"});
}

}  // namespace
}  // namespace waitpoint::tcl
