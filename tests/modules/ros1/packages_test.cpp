// SPDX-License-Identifier: BSD-3-Clause
// Packages and their executables in folders as Debian, catkin's installations and workspaces have them.
#include <gtest/gtest.h>

#include "modules/ros1/packages.hpp"
#include "tests/modules/scenario/scenario_text.hpp"

namespace waitpoint::ros1 {
namespace {

namespace fs = std::filesystem;

class PackageFolders : public ::testing::Test {
 protected:
  fs::path package(const std::string& path, const std::string& name) const {
    return folder_.write(path + "/package.xml", "<package format=\"2\">\n <name> " + name + "\n</name></package>")
        .parent_path();
  }
  fs::path program(const std::string& path) const {
    fs::path file = folder_.write(path, "#!/bin/sh\n");
    fs::permissions(file, fs::perms::owner_exec, fs::perm_options::add);
    return file;
  }
  fs::path in(const std::string& path) const { return folder_.path() / path; }

  scenario::TemporaryFolder folder_;
};

TEST_F(PackageFolders, FindsExecutablesOfInstalledPackagesInLib) {
  package("usr/share/nav", "nav");
  const fs::path amcl = program("usr/lib/nav/amcl"), script = program("usr/share/nav/scripts/plot.py");
  Packages packages({in("usr/share")});
  EXPECT_EQ(packages.folder("nav"), in("usr/share/nav"));
  EXPECT_EQ(packages.executable("nav", "amcl"), amcl);
  EXPECT_EQ(packages.executable("nav", "plot.py"), script);
  EXPECT_EQ(packages.executable("nav", "none"), std::nullopt);
  EXPECT_EQ(packages.folder("map"), std::nullopt);
  EXPECT_EQ(packages.executable("map", "amcl"), std::nullopt);
}

TEST_F(PackageFolders, SearchesWorkspacesByNamesInManifests) {
  const fs::path map = package("ws/src/navigation/folder_of_map", "map");
  package("ws/src/navigation/folder_of_map/inner", "inner");
  package("ws/src/old/folder", "ignored");
  folder_.write("ws/src/old/CATKIN_IGNORE", "");
  package("ws/src/.hidden/h", "hidden");
  package("ws/src/1/2/3/4/5/6", "deep");
  const fs::path server = program("ws/devel/lib/map/server");
  Packages packages({in("ws/src")});
  EXPECT_EQ(packages.folder("map"), map);
  EXPECT_EQ(packages.executable("map", "server"), server);
  for (const char* none : {"inner", "ignored", "hidden", "deep", "folder_of_map", "", ".", "..", "../src", "a/b"})
    EXPECT_EQ(packages.folder(none), std::nullopt) << none;
}

TEST_F(PackageFolders, PrefersTheFirstRootAndTheFirstByName) {
  package("one/b", "twice");
  const fs::path first = package("one/a", "twice");
  package("two/twice", "twice");
  EXPECT_EQ(Packages({in("one"), in("two")}).folder("twice"), first);
  EXPECT_EQ(Packages({in("none"), in("two"), in("one")}).folder("twice"), in("two/twice"));
}

TEST_F(PackageFolders, RequiresExecutablePermission) {
  package("src/p", "p");
  folder_.write("src/p/run", "no program");
  fs::create_directories(in("src/p/a/run"));
  const fs::path found = program("src/p/b/run");
  program("src/p/c/run");
  EXPECT_EQ(Packages({in("src")}).executable("p", "run"), found);
}

TEST_F(PackageFolders, IgnoresAManifestWithoutAName) {
  folder_.write("share/p/package.xml", "<package/>");
  folder_.write("share/q/package.xml", "no XML");
  EXPECT_EQ(Packages({in("share")}).folder("p"), std::nullopt);
  EXPECT_EQ(Packages({in("share")}).folder("q"), std::nullopt);
}

TEST_F(PackageFolders, TakesRootsFromTheEnvironmentAndDebian) {
  const auto roots_of = [](std::optional<std::string> listed) {
    return Packages::of([&](const std::string& name) { return name == "ROS_PACKAGE_PATH" ? listed : std::nullopt; })
        .roots();
  };
  EXPECT_EQ(roots_of("/a:/b::"), (std::vector<fs::path>{"/a", "/b", "/usr/share"}));
  EXPECT_EQ(roots_of("/usr/share:/c"), (std::vector<fs::path>{"/usr/share", "/c"}));
  EXPECT_EQ(roots_of(std::nullopt), (std::vector<fs::path>{"/usr/share"}));
}

}  // namespace
}  // namespace waitpoint::ros1
