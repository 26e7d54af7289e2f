// SPDX-License-Identifier: BSD-3-Clause
#include "tools/output/progress.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <string>

namespace waitpoint::tools {
namespace {

using namespace std::chrono_literals;

double fake_now_s = 0;
double fake_clock() { return fake_now_s; }

/// The output of `shown` on the stream that it gets.
template <class Shown>
std::string output_of(Shown&& shown) {
  char* text = nullptr;
  std::size_t size = 0;
  std::FILE* const stream = open_memstream(&text, &size);
  shown(stream);
  std::fclose(stream);
  const std::string output(text, size);
  std::free(text);
  return output;
}

Time at(Duration d) { return Time() + d; }

TEST(Progress, PrintsNothingWithoutATerminal) {
  fake_now_s = 0;
  const std::string output = output_of([](std::FILE* stream) {
    Progress progress(stream, false, 10min, &fake_clock);
    for (; fake_now_s < 150; ++fake_now_s) progress.update(at(10s), 1, 3);
    progress.finish();
  });
  EXPECT_EQ(output, "");
}

TEST(Progress, PrintsNothingInTheFirstTwoSeconds) {
  fake_now_s = 100;
  const std::string output = output_of([](std::FILE* stream) {
    Progress progress(stream, true, 100s, &fake_clock);
    for (; fake_now_s < 102; fake_now_s += 0.125) progress.update(at(10s), 0, 0);
    progress.finish();
  });
  EXPECT_EQ(output, "");
}

TEST(Progress, RedrawsItsBarAtMostTenTimesASecond) {
  fake_now_s = 100;
  const std::string output = output_of([](std::FILE* stream) {
    Progress progress(stream, true, 100s, &fake_clock);
    fake_now_s += progress_after_s;
    for (int i = 0; i < 1000; ++i) {
      fake_now_s += 0.001;
      progress.update(at(i * Duration(50ms)), 0, 0);
    }
  });
  const auto draws = std::count(output.begin(), output.end(), '\r');
  EXPECT_GE(draws, 9);
  EXPECT_LE(draws, 11);
  EXPECT_EQ(output.find('\n'), std::string::npos);
  EXPECT_NE(output.find("x real time"), std::string::npos);
}

TEST(Progress, BarIsFullAtTheEnd) {
  fake_now_s = 0;
  const std::string output = output_of([](std::FILE* stream) {
    Progress progress(stream, true, 100s, &fake_clock);
    fake_now_s = 2;
    progress.update(at(100s), 3, 3);
  });
  EXPECT_EQ(output.find("░"), std::string::npos);
  EXPECT_NE(output.find("█ 100 s of 100 s  3 of 3 goals  50.0 x real time"), std::string::npos) << output;
}

TEST(Progress, MessageClearsTheBarAndHasTheVirtualTime) {
  fake_now_s = 0;
  const std::string output = output_of([](std::FILE* stream) {
    Progress progress(stream, true, 100s, &fake_clock);
    fake_now_s = progress_after_s;
    progress.update(at(10s), 0, 0);
    progress.log(at(10500ms), "rackham", "goal 1 reached");
  });
  EXPECT_TRUE(output.ends_with("\r\x1b[K    10.500 s  rackham: goal 1 reached\n")) << output;
}

}  // namespace
}  // namespace waitpoint::tools
