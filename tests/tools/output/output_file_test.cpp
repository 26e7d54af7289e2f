// SPDX-License-Identifier: BSD-3-Clause
#include "tools/output/output_file.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <thread>

#include "core/error.hpp"
#include "tests/tools/folder.hpp"

namespace waitpoint::tools {
namespace {

namespace fs = std::filesystem;

TEST(OutputFile, IsRenamedIntoPlaceWhenComplete) {
  const Folder folder;
  OutputFile file(folder / "out.txt");
  file.write("one\n");
  EXPECT_FALSE(fs::exists(folder / "out.txt"));
  file.write("two\n");
  file.commit();
  EXPECT_EQ(folder.read("out.txt"), "one\ntwo\n");
  EXPECT_EQ(folder.count(), 1u) << "no temporary file is left";
}

TEST(OutputFile, AbandonedKeepsTheOldFile) {
  const Folder folder;
  folder.write("out.txt", "old");
  {
    OutputFile file(folder / "out.txt");
    file.write("new");
  }
  EXPECT_EQ(folder.read("out.txt"), "old");
  EXPECT_EQ(folder.count(), 1u);
}

TEST(OutputFile, ReplacesAnExistingFile) {
  const Folder folder;
  folder.write("out.txt", "a longer old text");
  OutputFile file(folder / "out.txt");
  file.write("new");
  file.commit();
  EXPECT_EQ(folder.read("out.txt"), "new");
}

TEST(OutputFile, FollowsSymbolicLinks) {
  const Folder folder;
  folder.write("real.txt", "old");
  fs::create_symlink("real.txt", folder / "link.txt");
  OutputFile file(folder / "link.txt");
  file.write("new");
  file.commit();
  EXPECT_TRUE(fs::is_symlink(folder / "link.txt"));
  EXPECT_EQ(folder.read("real.txt"), "new");
}

TEST(OutputFile, WritesDevicesInPlace) {
  OutputFile file("/dev/null");
  file.write("gone");
  file.commit();
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

TEST(OutputFile, RefusesAnUnwritablePathAtOnce) {
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

TEST(OutputFile, HasThePermissionsOfANewFile) {
  const Folder folder;
  folder.write("usual", "");
  OutputFile file(folder / "out.txt");
  file.commit();
  EXPECT_EQ(fs::status(folder / "out.txt").permissions(), fs::status(folder / "usual").permissions());
}

TEST(OutputFile, IsVisibleToOtherProcessesAfterFlush) {
  const Folder folder;
  OutputFile file(folder / "out.txt");
  file.write("so far");
  file.flush();
  EXPECT_EQ(folder.read(file.written_to().filename()), "so far");
}

TEST(OutputFile, LastOfTwoWritersOfOneNameWins) {
  const Folder folder;
  OutputFile one(folder / "out.txt"), other(folder / "out.txt");
  one.write("one");
  other.write("other");
  one.commit();
  other.commit();
  EXPECT_EQ(folder.read("out.txt"), "other");
  EXPECT_EQ(folder.count(), 1u);
}

TEST(OutputFile, RemovesOnlyTemporaryFilesOfKilledProcesses) {
  const Folder folder;
  const std::vector<std::string> others = {"k.waitpoint-readme.txt", "k.waitpoint-1",    "k.waitpoint-1-",
                                           "k.waitpoint-1-2.txt",    "k.waitpoint--1-2", "other.waitpoint-1-2"};
  const auto write_old = [&](const std::string& name) {
    folder.write(name, "");
    fs::last_write_time(folder / name, fs::file_time_type::clock::now() - std::chrono::minutes(1));
  };
  for (const std::string& name : others) write_old(name);
  write_old("k.waitpoint-12-3");
  OutputFile(folder / "k").commit();
  EXPECT_FALSE(fs::exists(folder / "k.waitpoint-12-3"));
  for (const std::string& name : others) EXPECT_TRUE(fs::exists(folder / name)) << name;
}

/// The status of a forked copy of this process that calls the function; its exit handlers do not run.
template <class Function>
int status_of_copy(Function function) {
  const pid_t copy = fork();
  if (copy == 0) {
    function();
    _exit(0);
  }
  int status = -1;
  waitpid(copy, &status, 0);
  return status;
}

TEST(OutputFile, IgnoresForkedCopies) {
  const Folder folder;
  OutputFile written(folder / "written"), given_up(folder / "given_up");
  written.write("before ");
  ASSERT_EQ(status_of_copy([&] {
              OutputFile moved = std::move(given_up);
              written.write(std::string(100'000, 'x'));
              written.commit();
            }),
            0);
  EXPECT_FALSE(fs::exists(folder / "written"));
  for (OutputFile* file : {&written, &given_up}) {
    file->write("after");
    file->commit();
  }
  EXPECT_EQ(folder.read("written"), "before after");
  EXPECT_EQ(folder.read("given_up"), "after");
}

TEST(OutputFile, IsCompletedByAForkedCopyThatTakesItOver) {
  const Folder folder;
  OutputFile file(folder / "out.txt");
  file.write("one ");
  ASSERT_EQ(status_of_copy([&] {
              OutputFile::take_over();
              file.write("two");
              file.commit();
            }),
            0);
  EXPECT_EQ(folder.read("out.txt"), "one two");
}

TEST(OutputFile, ReportsAFullDisk) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  OutputFile file("/dev/full");
  file.write("x");
  EXPECT_THROW(file.commit(), BadInput);
}

/// A pipe that does not block its writer, in place of standard output.
class NonBlockingOutput {
 public:
  NonBlockingOutput() : saved_(dup(STDOUT_FILENO)) {
    EXPECT_EQ(pipe2(ends_, O_CLOEXEC), 0);
    EXPECT_EQ(fcntl(ends_[1], F_SETFL, O_NONBLOCK), 0);
    std::fflush(stdout);
    dup2(ends_[1], STDOUT_FILENO);
    close(ends_[1]);
  }
  ~NonBlockingOutput() {
    restore();
    close(ends_[0]);
  }
  void restore() {
    if (saved_ < 0) return;
    dup2(saved_, STDOUT_FILENO);
    close(std::exchange(saved_, -1));
  }
  /// Up to the end, after a while.
  std::string read_later() const {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    std::string text, block(4096, ' ');
    for (ssize_t size = 0; (size = ::read(ends_[0], block.data(), block.size())) > 0;)
      text.append(block, 0, static_cast<std::size_t>(size));
    return text;
  }

 private:
  int ends_[2] = {-1, -1};
  int saved_;
};

TEST(StandardOutput, WaitsForANonBlockingDescriptor) {
  const std::string text(1 << 20, 'x');
  std::string read, failure;
  NonBlockingOutput output;
  std::thread reader([&] { read = output.read_later(); });
  try {
    write_standard_output(text);
    OutputFile file("-");
    file.write(text);
    file.commit();
  } catch (const BadInput& error) {
    failure = error.what();
  }
  output.restore();
  reader.join();
  EXPECT_EQ(failure, "");
  EXPECT_TRUE(read == text + text) << read.size() << " bytes";
}

}  // namespace
}  // namespace waitpoint::tools
