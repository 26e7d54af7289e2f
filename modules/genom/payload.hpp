// SPDX-License-Identifier: BSD-3-Clause
// The input of a request or the output of a reply: a plain value of some type with declared fields, carried by letters.
#pragma once

#include <array>
#include <cstddef>
#include <cstring>
#include <type_traits>

#include "core/fields.hpp"

namespace waitpoint::genom {

inline constexpr std::size_t payload_bytes_max = 1024;

/// For requests without input or output.
struct Nothing {
  static constexpr auto fields() { return std::tuple(); }
};

class Payload {
 public:
  Payload() : Payload(Nothing{}) {}
  template <HasFields T>
  explicit Payload(const T& value) : type_(type_of<T>()) {
    static_assert(std::is_trivially_copyable_v<T> && sizeof(T) <= payload_bytes_max,
                  "the input or output of a request is a small plain struct");
    std::memcpy(bytes_.data(), &value, sizeof value);
  }

  template <HasFields T>
  bool holds() const {
    return type_ == type_of<T>();
  }
  /// The value; asking for another type than was put in is a bug.
  template <HasFields T>
  T as() const {
    WAITPOINT_CHECK(holds<T>(), "a request's input or output is taken for another type");
    T value;
    std::memcpy(static_cast<void*>(&value), bytes_.data(), sizeof value);
    return value;
  }
  /// Adds the value to a digest by its declared fields.
  void add_to(Digest& digest) const { type_->add(digest, *this); }

 private:
  struct Type {
    void (*add)(Digest& digest, const Payload& payload);
  };
  template <class T>
  static const Type* type_of() {
    static constexpr Type type{[](Digest& digest, const Payload& payload) { add_value(digest, payload.as<T>()); }};
    return &type;
  }

  const Type* type_;
  alignas(8) std::array<std::byte, payload_bytes_max> bytes_{};
};

}  // namespace waitpoint::genom
