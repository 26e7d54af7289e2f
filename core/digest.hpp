// SPDX-License-Identifier: BSD-3-Clause
// A running 64-bit hash of what a run did.
//
// Every step maps (state, word) to a state, and is a bijection of the state for a given word and of the word for a
// given state. So two sequences of equal length that differ in exactly one word always have different digests: no
// single changed bit can be lost. Against several independent changes it is a 64-bit hash (2^-64). It is no
// cryptographic hash: it guards against accidents, not against an adversary.
//
// What is added is defined by value, not by memory: integers as they are, doubles by their bits with every NaN made one
// and -0 kept, text by its length and bytes. No padding and no pointer can get in.
#pragma once

#include <bit>
#include <cstdint>
#include <string>
#include <string_view>

namespace waitpoint {

class Digest {
 public:
  constexpr Digest() = default;
  explicit constexpr Digest(std::uint64_t start) : state_(start) {}

  constexpr void add(std::uint64_t word) {
    // Odd multipliers are invertible modulo 2^64, rotations and xor-shifts too.
    state_ = (std::rotl(state_, 29) ^ word) * 0x9E3779B97F4A7C15u;
    state_ ^= state_ >> 32;
  }
  constexpr void add(double value) { add(value != value ? canonical_nan : std::bit_cast<std::uint64_t>(value)); }
  void add(std::string_view text);

  constexpr std::uint64_t value() const { return mix(state_); }
  friend constexpr bool operator==(const Digest&, const Digest&) = default;

  /// Scatters the bits of a word; a bijection. (The finaliser of splitmix64: Steele, Lea, Flood 2014.)
  static constexpr std::uint64_t mix(std::uint64_t x) {
    x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9u;
    x = (x ^ (x >> 27)) * 0x94D049BB133111EBu;
    return x ^ (x >> 31);
  }

 private:
  static constexpr std::uint64_t canonical_nan = 0x7FF8000000000000u;
  std::uint64_t state_ = 0x77616974706F696Eu;  // "waitpoin"
};

/// A hash of a sequence of pairs of words that may be long and must be quick: each pair is hashed with its place in the
/// sequence, by one multiplication to 128 bits, and the hashes are added, so that none waits for the one before it. A
/// changed word is lost with a chance of 2^-64.
class PairDigest {
 public:
  [[gnu::always_inline]] constexpr void add(std::uint64_t first, std::uint64_t second) {
    std::uint64_t key = last_key_ += key_step;
    key ^= key >> 32;  // else the keys would be an arithmetic progression, and sums over it
    const Product product = static_cast<Product>(first ^ key) * (second + std::rotl(key, 19));
    sum_ += static_cast<std::uint64_t>(product) ^ static_cast<std::uint64_t>(product >> 64);
  }

  constexpr std::uint64_t pairs() const { return last_key_ * inverse_of_step; }
  /// Of all pairs so far, and how many they are.
  constexpr Digest digest() const {
    Digest digest;
    digest.add(pairs());
    digest.add(sum_);
    return digest;
  }
  constexpr std::uint64_t value() const { return digest().value(); }

 private:
  __extension__ using Product = unsigned __int128;

  // Each pair's key is that of the one before it and a step more, which is odd: so keys count pairs, modulo 2^64.
  static constexpr std::uint64_t key_step = 0x9E3779B97F4A7C15u;
  static constexpr std::uint64_t inverse_of_step = 0xF1DE83E19937733Du;
  static_assert(key_step * inverse_of_step == 1);

  std::uint64_t sum_ = 0;
  std::uint64_t last_key_ = 0;
};

/// The printed form: "wp1:" and 16 hexadecimal digits. The prefix changes when the definition of what is hashed does.
std::string to_string(const Digest& digest);

}  // namespace waitpoint
