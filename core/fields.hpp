// SPDX-License-Identifier: BSD-3-Clause
// The declared fields of a value: what the digest hashes, what a scenario may set, what a recorder writes.
//
// A type declares its fields once, in order, next to its members:
//
//   struct Battery {
//     Time date;
//     double volts = 0;
//     static void fields(auto field) {
//       field("date", &Battery::date);
//       field("volts", &Battery::volts);
//     }
//   };
//
// Fields are integers, enums, bool, double, Time, Duration, Point, Pose, std::array and Bounded of such, and other
// types with declared fields. Pointers are not allowed.
//
// A field added after runs with the type were published is declared after the others, as `added`: the digest hashes it,
// with its name, only if it is set, so that runs without it keep their digests.
//
//     field("temperature_c", &Battery::temperature_c, added);
//
// Further facts of a field, such as its range and a description, may follow the member: core/field_facts.hpp. The
// digest ignores them.
#pragma once

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <type_traits>

#include "core/digest.hpp"
#include "core/error.hpp"
#include "core/field_facts.hpp"
#include "core/pose.hpp"
#include "core/time.hpp"

namespace waitpoint {

/// A visitor that accepts every field.
struct FieldProbe {
  void operator()(std::string_view, auto, auto...) const {}
};

template <class T>
concept HasFields = requires {
  T::fields(FieldProbe());
};

/// An array of at most `Capacity` elements in place, for values without pointers. Only the first size() elements are
/// constructed and copied: the cost is that of the content, not of the capacity.
template <class T, std::size_t Capacity>
class Bounded {
 public:
  Bounded() {}
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic push
// g++ 14 takes elements beyond the size for copied ones.
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif
  Bounded(const Bounded& other) : size_(other.size_) { std::copy(other.begin(), other.end(), begin()); }
  Bounded& operator=(const Bounded& other) {
    if (this == &other) return *this;
    size_ = other.size_;
    std::copy(other.begin(), other.end(), begin());
    return *this;
  }
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic pop
#endif
  ~Bounded() = default;

  static constexpr std::size_t capacity() { return Capacity; }
  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  bool full() const { return size_ == Capacity; }
  void clear() { size_ = 0; }
  /// The new elements are value-initialised; a size above the capacity is a bug.
  void resize(std::size_t n) {
    WAITPOINT_CHECK(n <= Capacity, "more elements than a bounded array holds");
    for (std::size_t i = size_; i < n; ++i) items_[i] = T{};
    size_ = static_cast<std::uint32_t>(n);
  }
  /// Appending to a full array is a bug.
  void push_back(const T& item) {
    WAITPOINT_CHECK(size_ < Capacity, "more elements than a bounded array holds");
    items_[size_++] = item;
  }
  T& operator[](std::size_t i) { return items_[i]; }
  const T& operator[](std::size_t i) const { return items_[i]; }
  T* begin() { return items_.data(); }
  T* end() { return items_.data() + size_; }
  const T* begin() const { return items_.data(); }
  const T* end() const { return items_.data() + size_; }

 private:
  std::uint32_t size_ = 0;
  std::array<T, Capacity> items_;
};

/// Calls `visit(name, member)` for every declared field, in order.
template <HasFields T, class Visit>
void for_each_field(T& value, Visit&& visit) {
  std::remove_const_t<T>::fields([&](std::string_view name, auto member, auto...) { visit(name, value.*member); });
}

template <class T>
void add_value(Digest& digest, const T& value);

template <class T, std::size_t N>
void add_elements(Digest& digest, const std::array<T, N>& items) {
  for (const T& item : items) add_value(digest, item);
}
template <class T, std::size_t N>
void add_elements(Digest& digest, const Bounded<T, N>& items) {
  digest.add(static_cast<std::uint64_t>(items.size()));
  for (const T& item : items) add_value(digest, item);
}

/// True if `value` differs from a default-constructed one.
template <std::equality_comparable T>
bool is_set(const T& value) {
  return value != T{};
}
template <class T, std::size_t N>
bool is_set(const Bounded<T, N>& items) {
  return !items.empty();
}

/// The visitor that hashes the fields of `value`.
template <class T>
struct FieldHash {
  Digest& digest;
  const T& value;

  template <class... Facts>
  void operator()(std::string_view name, auto member, const Facts&...) const {
    if constexpr ((std::is_same_v<Facts, Added> || ...)) {
      if (!is_set(value.*member)) return;
      digest.add(name);
    }
    add_value(digest, value.*member);
  }
};

/// Adds a value by its declared fields, recursively.
template <class T>
void add_value(Digest& digest, const T& value) {
  if constexpr (HasFields<T>) {
    T::fields(FieldHash<T>{digest, value});
  } else if constexpr (std::is_enum_v<T> || std::is_integral_v<T>) {
    digest.add(static_cast<std::uint64_t>(value));
  } else if constexpr (std::is_floating_point_v<T>) {
    digest.add(static_cast<double>(value));
  } else if constexpr (std::is_same_v<T, Time> || std::is_same_v<T, Duration>) {
    digest.add(static_cast<std::uint64_t>(value.ns()));
  } else if constexpr (std::is_same_v<T, Point>) {
    digest.add(value.x);
    digest.add(value.y);
  } else if constexpr (std::is_same_v<T, Pose>) {
    digest.add(value.x);
    digest.add(value.y);
    digest.add(value.heading);
  } else {
    add_elements(digest, value);
  }
}

}  // namespace waitpoint
