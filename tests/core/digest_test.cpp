// SPDX-License-Identifier: BSD-3-Clause
#include "core/digest.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>
#include <vector>

#include "core/random.hpp"

namespace waitpoint {
namespace {

std::uint64_t hash_words(const std::vector<std::uint64_t>& words) {
  Digest digest;
  for (const std::uint64_t word : words) digest.add(word);
  return digest.value();
}
std::uint64_t hash(std::string_view text) {
  Digest digest;
  digest.add(text);
  return digest.value();
}
std::uint64_t hash(double value) {
  Digest digest;
  digest.add(value);
  return digest.value();
}

TEST(Digest, EverySingleChangedBitChangesIt) {
  const RandomStream random(1, "", "words");
  std::vector<std::uint64_t> words(500);
  for (std::size_t i = 0; i < words.size(); ++i)
    words[i] = random.block(i)[0] | std::uint64_t{random.block(i)[1]} << 32;
  const std::uint64_t whole = hash_words(words);
  std::set<std::uint64_t> seen = {whole};
  for (std::uint64_t i = 0; i < 1000; ++i) {
    std::uint64_t& word = words[random.below(words.size(), i, 1)];
    const std::uint64_t bit = 1ull << random.below(64, i, 2);
    word ^= bit;
    seen.insert(hash_words(words));
    EXPECT_NE(hash_words(words), whole);
    word ^= bit;
  }
  EXPECT_GT(seen.size(), 980u);  // some bits are drawn twice
  EXPECT_EQ(hash_words(words), whole);
}

TEST(Digest, EveryBitOfAShortTextCounts) {
  std::string text = "a poster's name of some length";
  const std::uint64_t whole = hash(text);
  for (char& c : text)
    for (int bit = 0; bit < 8; ++bit) {
      c = static_cast<char>(c ^ 1 << bit);
      EXPECT_NE(hash(text), whole);
      c = static_cast<char>(c ^ 1 << bit);
    }
}

TEST(Digest, OrderAndNumberOfWordsCount) {
  EXPECT_NE(hash_words({1, 2}), hash_words({2, 1}));
  EXPECT_NE(hash_words({0}), hash_words(std::vector<std::uint64_t>{}));
  EXPECT_NE(hash_words({0, 0}), hash_words({0}));
}

TEST(Digest, TextCountsWithItsLength) {
  EXPECT_NE(hash(std::string_view("ab\0", 3)), hash(std::string_view("ab", 2)));
  Digest split, joined;
  split.add(std::string_view("ab")), split.add(std::string_view("c"));
  joined.add(std::string_view("a")), joined.add(std::string_view("bc"));
  EXPECT_NE(split, joined);
}

TEST(Digest, EveryNanIsOneAndTheZerosAreTwo) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(hash(nan), hash(-nan));
  EXPECT_EQ(hash(nan), hash(std::bit_cast<double>(0x7FF0000000000123ull)));
  EXPECT_NE(hash(0.0), hash(-0.0));
  EXPECT_NE(hash(1.0), hash(std::nextafter(1.0, 2.0)));
}

TEST(Digest, IsTheRecordedOne) {
  Digest digest;
  digest.add(std::uint64_t{42});
  digest.add(0.5);
  digest.add(std::string_view("waitpoint"));
  EXPECT_EQ(to_string(digest), "wp1:dc5c061e2c3a9a57");
  EXPECT_EQ(to_string(Digest()).size(), 20u);
}

TEST(PairDigest, EverySingleBitAndTheOrderCount) {
  const auto of = [](std::uint64_t a, std::uint64_t b, std::uint64_t c, std::uint64_t d) {
    PairDigest digest;
    digest.add(a, b);
    digest.add(c, d);
    return digest.value();
  };
  std::set<std::uint64_t> seen = {of(1, 2, 3, 4), of(3, 4, 1, 2), of(2, 1, 3, 4), of(1, 2, 4, 3)};
  for (int bit = 0; bit < 64; ++bit) {
    const std::uint64_t flip = std::uint64_t{1} << bit;
    for (const std::uint64_t value :
         {of(1 ^ flip, 2, 3, 4), of(1, 2 ^ flip, 3, 4), of(1, 2, 3 ^ flip, 4), of(1, 2, 3, 4 ^ flip)})
      seen.insert(value);
  }
  EXPECT_EQ(seen.size(), 4u + 4 * 64);
}

TEST(PairDigest, TheNumberOfPairsCounts) {
  PairDigest none, one;
  one.add(0, 0);
  EXPECT_NE(none.value(), one.value());
}

}  // namespace
}  // namespace waitpoint
