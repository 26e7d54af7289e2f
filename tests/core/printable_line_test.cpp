// SPDX-License-Identifier: BSD-3-Clause
#include "core/printable_line.hpp"

#include <gtest/gtest.h>

namespace waitpoint {
namespace {

TEST(PrintableLine, HasNoControlCharacterOfAsciiOrUnicode) {
  EXPECT_EQ(printable_line("a\n\x1b]0;b\a\x7f"), "a??]0;b??");
  EXPECT_EQ(printable_line("\xc2\x80 \xc2\x9b"
                           "31m \xc2\x9f"),
            "? ?31m ?");
}

TEST(PrintableLine, HasNoOverrideOfTheDirectionOfWriting) {
  for (const char* override : {"\xe2\x80\xaa", "\xe2\x80\xae", "\xe2\x81\xa6", "\xe2\x81\xa9", "\xe2\x80\xa8"})
    EXPECT_EQ(printable_line(std::string("a") + override + "b"), "a?b");
}

TEST(PrintableLine, KeepsLettersOfAllLanguages) {
  for (const char* text : {"pas trouv\xc3\xa9", "\xc2\xa0", "\xe2\x82\xac", "\xe6\x9d\xb1", "\xf0\x9f\xa4\x96"}) {
    EXPECT_EQ(printable_line(text), text);
    EXPECT_TRUE(is_printable_line(text)) << text;
  }
}

TEST(PrintableLine, ReplacesBytesThatAreNoUtf8) {
  EXPECT_EQ(printable_line("a\x9b"
                           "31m"),
            "a?31m");
  EXPECT_EQ(printable_line("\xc3"), "?");
  EXPECT_EQ(printable_line("\xe0\x82\x9b"), "???") << "a control character, written longer than needed";
  EXPECT_FALSE(is_printable_line("\xff"));
}

TEST(PrintableMessage, CutWithinALetterIsStillPrintable) {
  const std::string message = printable_message("found '" + std::string(79, 'x') +
                                                "\xc3\xa9"
                                                "yyy'");
  EXPECT_EQ(message, "found '" + std::string(79, 'x') + "?...'");
}

}  // namespace
}  // namespace waitpoint
