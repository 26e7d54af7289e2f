// SPDX-License-Identifier: BSD-3-Clause
#include "core/confinement.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

#include "core/error.hpp"

namespace waitpoint {
namespace {

namespace fs = std::filesystem;

class ConfinementTest : public testing::Test {
 protected:
  ConfinementTest() {
    std::string pattern = fs::temp_directory_path() / "confinement-XXXXXX";
    top_ = mkdtemp(pattern.data());
    for (const char* folder : {"own", "own/maps", "own-too", "other"}) fs::create_directory(top_ / folder);
    for (const char* file : {"own/a", "own/maps/b", "own-too/c", "other/d"}) std::ofstream(top_ / file) << "x";
  }
  ~ConfinementTest() override { fs::remove_all(top_); }

  fs::path top_;
};

TEST_F(ConfinementTest, WithoutOneEveryFileIsAllowed) {
  EXPECT_FALSE(Confinement::exists());
  EXPECT_TRUE(Confinement::allows("/etc/passwd"));
}

TEST_F(ConfinementTest, AllowsFilesInItsFoldersAndBelowUntilItsEnd) {
  {
    const Confinement confinement(std::vector{top_ / "own"});
    EXPECT_TRUE(Confinement::exists());
    for (const char* inside : {"own/a", "own/maps/b", "own/maps/../a", "own/new", "other/../own/a"})
      EXPECT_TRUE(Confinement::allows(top_ / inside)) << inside;
    for (const char* outside : {"own-too/c", "other/d", "own/../other/d", "own/maps/../../other/d", "gone"})
      EXPECT_FALSE(Confinement::allows(top_ / outside)) << outside;
  }
  EXPECT_TRUE(Confinement::allows(top_ / "other/d"));
}

TEST_F(ConfinementTest, FollowsSymbolicLinks) {
  fs::create_symlink(top_ / "other", top_ / "own/way-out");
  fs::create_symlink(top_ / "other/d", top_ / "own/file-out");
  fs::create_symlink(top_ / "own/a", top_ / "own/stays");
  const Confinement confinement(std::vector{top_ / "own"});
  EXPECT_FALSE(Confinement::allows(top_ / "own/way-out/d"));
  EXPECT_FALSE(Confinement::allows(top_ / "own/file-out"));
  EXPECT_TRUE(Confinement::allows(top_ / "own/stays"));
}

TEST_F(ConfinementTest, TellsNeitherContentNorExistenceOfARefusedFile) {
  const Confinement confinement(std::vector{top_ / "own"});
  const auto complaint = [&](const char* file) {
    try {
      Confinement::require_allowed(top_ / file);
    } catch (const BadInput& bad) {
      return std::string(bad.what()).substr((top_ / file).string().size());
    }
    return std::string();
  };
  EXPECT_EQ(complaint("other/d"), ": lies outside of the folders that --confined allows");
  EXPECT_EQ(complaint("other/d"), complaint("other/g"));
}

TEST_F(ConfinementTest, NeedsFoldersThatExist) {
  EXPECT_THROW(const Confinement confinement(std::vector{top_ / "gone"}), BadInput);
  EXPECT_THROW(const Confinement confinement(std::vector{top_ / "own/a"}), BadInput);
  EXPECT_FALSE(Confinement::exists());
}

}  // namespace
}  // namespace waitpoint
