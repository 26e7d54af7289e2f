// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/status_line.hpp"

#include <gtest/gtest.h>

#include <string>

namespace waitpoint::bench {
namespace {

std::string written(bool is_terminal) {
  std::FILE* const file = std::tmpfile();
  {
    StatusLine line(is_terminal, file);
    line.show("first case");
    line.show("second");
  }
  std::string text(static_cast<std::size_t>(std::ftell(file)), '\0');
  std::rewind(file);
  text.resize(std::fread(text.data(), 1, text.size(), file));
  std::fclose(file);
  return text;
}

TEST(StatusLine, IsWrittenOverAndRemovedOnATerminal) { EXPECT_EQ(written(true), "\rfirst case\rsecond    \r      \r"); }

TEST(StatusLine, LeavesNothingInAFile) { EXPECT_EQ(written(false), ""); }

}  // namespace
}  // namespace waitpoint::bench
