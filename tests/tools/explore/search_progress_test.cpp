// SPDX-License-Identifier: BSD-3-Clause
#include "tools/explore/search/search_progress.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

namespace waitpoint::tools {
namespace {

double fake_now_s = 0;
double fake_clock() { return fake_now_s; }

/// The output during a minute with 10 schedules a second.
std::string a_minute(bool terminal) {
  char* text = nullptr;
  std::size_t size = 0;
  std::FILE* const stream = open_memstream(&text, &size);
  fake_now_s = 100;
  SearchProgress progress(stream, terminal, &fake_clock);
  for (std::uint64_t i = 1; i <= 600; ++i) {
    fake_now_s += 0.1;
    progress.update(i, i / 2, i / 100);
  }
  progress.finish();
  std::fclose(stream);
  const std::string output(text, size);
  std::free(text);
  return output;
}

TEST(SearchProgress, PrintsNothingWithoutATerminal) { EXPECT_EQ(a_minute(false), ""); }

TEST(SearchProgress, ClearsItsLineOnATerminal) {
  const std::string output = a_minute(true);
  EXPECT_EQ(output.find('\n'), std::string::npos);
  EXPECT_GE(std::count(output.begin(), output.end(), '\r'), 100);
  EXPECT_NE(output.find(" schedules, 10.0 a second, "), std::string::npos) << output;
  EXPECT_TRUE(output.ends_with("\r\x1b[K"));
}

}  // namespace
}  // namespace waitpoint::tools
