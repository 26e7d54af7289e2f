// SPDX-License-Identifier: BSD-3-Clause
#include "tools/explore/replay/schedule_file.hpp"

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "tests/tools/folder.hpp"

namespace waitpoint::tools {
namespace {

using kernel::Choice;

StoredSchedule sample() {
  return {0x9f3a2c1b00112233,
          "pct:3",
          7,
          1234,
          Time() + Duration(std::chrono::milliseconds(1500)),
          0x123456789abcdef,
          {{Choice::task, {0xaa, 12}, {0xbb, 7}}, {Choice::computing, {0xaa, 13}, {62, 0}}}};
}

const std::string sample_text =
    "waitpoint schedule 1\n"
    "scenario 9f3a2c1b00112233\n"
    "drawn pct:3 7 1234\n"
    "from 1.500000000\n"
    "digest wp1:0123456789abcdef\n"
    "task 00000000000000aa 12 00000000000000bb 7\n"
    "computing 00000000000000aa 13 62\n";

TEST(ScheduleFile, ReadsBackAsWritten) {
  EXPECT_EQ(to_text(sample()), sample_text);
  const Folder folder;
  folder.write("s", sample_text);
  const StoredSchedule schedule = read_schedule(folder / "s");
  EXPECT_EQ(to_text(schedule), sample_text);
  EXPECT_EQ(schedule.switches, sample().switches);
  StoredSchedule trailed = sample();
  trailed.trail = {4, {0x123, 0xabc}};
  folder.write("t", to_text(trailed));
  EXPECT_EQ(read_schedule(folder / "t").trail, trailed.trail);
}

// The error, without the file's name, if `from` in the sample is replaced by `to`.
std::string message(const std::string& from, const std::string& to) {
  const Folder folder;
  std::string text = sample_text;
  text.replace(text.find(from), from.size(), to);
  folder.write("s", text);
  try {
    (void)read_schedule(folder / "s");
  } catch (const BadInput& error) {
    EXPECT_EQ(error.file(), (folder / "s").string());
    return std::string(error.what()).substr(error.file().size());
  }
  return "";
}

TEST(ScheduleFile, RefusesOtherFilesWithTheirLine) {
  EXPECT_EQ(message("schedule 1", "schedule 2"), ":1: expected 'waitpoint schedule 1'");
  EXPECT_EQ(message("waitpoint", "robots:"), ":1: expected 'waitpoint schedule 1'");
  EXPECT_EQ(message("scenario 9", "scenario x"), ":2: expected the scenario's digest as hexadecimal digits");
  EXPECT_EQ(message("7 1234", "7"), ":3: expected 'drawn', a strategy, a seed and a number");
  EXPECT_EQ(message("from 1.5", "from -1"), ":4: expected 'from' and a time in seconds");
  EXPECT_EQ(message("0123456789abcdef\n", "01234567\n"), ":5: expected sixteen digits of a digest after wp1:");
  EXPECT_EQ(message("0123456789abcdef\n", "0123456789abcdef 4a!\n"),
            ":5: expected 'digest', the digest of the run, and its trail if known");
  EXPECT_EQ(message("wp1:", "wp2:"), ":5: expected a digest that begins with wp1:");
  for (const auto& [from, to] : {std::pair("task ", "tusk "), {" 12 ", " "}, {"bb 7", "bb x"}})
    EXPECT_TRUE(message(from, to).starts_with(":6: expected a switch such as 'task ")) << to;
  EXPECT_TRUE(message("13 62", "13").starts_with(":7: expected a switch such as 'task "));
  EXPECT_EQ(message(sample_text, "waitpoint schedule 1\n"), ":2: expected 'scenario' and the digest of the scenario");
}

TEST(ScheduleFile, MissingIsBadInput) { EXPECT_THROW((void)read_schedule("no such file"), BadInput); }

}  // namespace
}  // namespace waitpoint::tools
