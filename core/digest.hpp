// SPDX-License-Identifier: BSD-3-Clause
// A running 64-bit hash of a run's events, outputs and states.
//
// Every step maps (state, word) to a state, and is a bijection of the state for a given word and of the word for a
// given state. So two sequences of equal length that differ in exactly one word always have different digests: no
// single changed bit can be lost. Against several independent changes it is a 64-bit hash (2^-64). It is not a
// cryptographic hash: it guards against accidents, not against an adversary.
//
// Input is hashed by value, not by memory: integers as they are, doubles by their bits with one NaN for all and -0
// kept, text by its length and bytes. Padding and pointers are never hashed.
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

/// A hash for long sequences of pairs of words: each pair is hashed with its position by one multiplication to 128
/// bits, and the hashes are added, so that there is no dependency chain. A changed word is lost with a chance of 2^-64.
class PairDigest {
 public:
  [[gnu::always_inline]] constexpr void add(std::uint64_t first, std::uint64_t second) {
    std::uint64_t key = last_key_ += key_step;
    key ^= key >> 32;  // else the keys would be an arithmetic progression, and sums over it
    const Product product = static_cast<Product>(first ^ key) * (second + std::rotl(key, 19));
    sum_ += static_cast<std::uint64_t>(product) ^ static_cast<std::uint64_t>(product >> 64);
  }

  constexpr std::uint64_t pairs() const { return last_key_ * inverse_of_step; }
  /// The hash of all pairs so far and of their number.
  constexpr Digest digest() const {
    Digest digest;
    digest.add(pairs());
    digest.add(sum_);
    return digest;
  }
  constexpr std::uint64_t value() const { return digest().value(); }

 private:
  __extension__ using Product = unsigned __int128;

  // The key grows by an odd step per pair, so it also counts pairs, modulo 2^64.
  static constexpr std::uint64_t key_step = 0x9E3779B97F4A7C15u;
  static constexpr std::uint64_t inverse_of_step = 0xF1DE83E19937733Du;
  static_assert(key_step * inverse_of_step == 1);

  std::uint64_t sum_ = 0;
  std::uint64_t last_key_ = 0;
};

/// The hash of a text alone, of names for example.
inline std::uint64_t text_hash(std::string_view text) {
  Digest digest;
  digest.add(text);
  return digest.value();
}

/// The printed form: "wp1:" and 16 hexadecimal digits. The prefix changes with the definition of the hashed input.
std::string to_string(const Digest& digest);

}  // namespace waitpoint
