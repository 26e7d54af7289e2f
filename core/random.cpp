// SPDX-License-Identifier: BSD-3-Clause
#include "core/random.hpp"

#include <cmath>

#include "core/digest.hpp"
#include "core/error.hpp"
#include "core/exact_math.hpp"

namespace waitpoint {
namespace {

constexpr double two_to_minus_53 = 1.0 / 9007199254740992.0;

std::uint64_t word(std::uint32_t low, std::uint32_t high) { return low | static_cast<std::uint64_t>(high) << 32; }
double unit_interval(std::uint64_t bits) { return static_cast<double>(bits >> 11) * two_to_minus_53; }

}  // namespace

std::array<std::uint32_t, 4> philox_4x32_10(std::array<std::uint32_t, 4> c, std::array<std::uint32_t, 2> k) {
  for (int round = 0; round < 10; ++round) {
    const std::uint64_t p0 = std::uint64_t{0xD2511F53u} * c[0];
    const std::uint64_t p1 = std::uint64_t{0xCD9E8D57u} * c[2];
    c = {static_cast<std::uint32_t>(p1 >> 32) ^ c[1] ^ k[0], static_cast<std::uint32_t>(p1),
         static_cast<std::uint32_t>(p0 >> 32) ^ c[3] ^ k[1], static_cast<std::uint32_t>(p0)};
    k[0] += 0x9E3779B9u;
    k[1] += 0xBB67AE85u;
  }
  return c;
}

RandomStream::RandomStream(std::uint64_t seed, std::string_view robot, std::string_view source) {
  Digest name;
  name.add(seed);
  name.add(robot);
  name.add(source);
  const std::uint64_t key = name.value();
  key_ = {static_cast<std::uint32_t>(key), static_cast<std::uint32_t>(key >> 32)};
}

std::array<std::uint32_t, 4> RandomStream::block(std::uint64_t tick, std::uint64_t index) const {
  return philox_4x32_10({static_cast<std::uint32_t>(tick), static_cast<std::uint32_t>(tick >> 32),
                         static_cast<std::uint32_t>(index), static_cast<std::uint32_t>(index >> 32)},
                        key_);
}

double RandomStream::uniform(std::uint64_t tick, std::uint64_t index) const {
  const auto b = block(tick, index);
  return unit_interval(word(b[0], b[1]));
}

std::array<double, 2> RandomStream::uniform_pair(std::uint64_t tick, std::uint64_t index) const {
  const auto b = block(tick, index);
  return {unit_interval(word(b[0], b[1])), unit_interval(word(b[2], b[3]))};
}

std::uint64_t RandomStream::below(std::uint64_t bound, std::uint64_t tick, std::uint64_t index) const {
  WAITPOINT_CHECK(bound > 0, "the bound of a random integer must be positive");
  const auto b = block(tick, index);
  return static_cast<std::uint64_t>(static_cast<unsigned __int128>(word(b[0], b[1])) * bound >> 64);
}

std::array<double, 2> RandomStream::normal_pair(std::uint64_t tick, std::uint64_t index) const {
  const auto [u, v] = uniform_pair(tick, index);
  const double radius = std::sqrt(-2.0 * exact::log(1.0 - u));  // 1 - u is in (0, 1]
  const auto [sine, cosine] = exact::sincos(2.0 * exact::pi * v);
  return {radius * cosine, radius * sine};
}

}  // namespace waitpoint
