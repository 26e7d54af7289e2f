// SPDX-License-Identifier: BSD-3-Clause
// The input of a request or the output of a reply: a small plain struct with declared fields, carried by letters.
#pragma once

#include <cstddef>
#include <new>
#include <string>
#include <type_traits>

#include "core/field_path.hpp"
#include "core/field_text.hpp"
#include "core/fields.hpp"

namespace waitpoint::genom {

inline constexpr std::size_t payload_bytes_max = 1024;

/// For requests without input or output.
struct Nothing {
  static void fields(auto) {}
};

class Payload {
 public:
  Payload() : Payload(Nothing{}) {}
  template <HasFields T>
  explicit Payload(const T& value) : type_(type_of<T>()) {
    static_assert(std::is_trivially_destructible_v<T> && sizeof(T) <= payload_bytes_max && alignof(T) <= alignment,
                  "the input or output of a request is a small plain struct");
    new (bytes_) T(value);
  }
  Payload(const Payload& other) : type_(other.type_) { type_->copy(bytes_, other); }
  Payload& operator=(const Payload& other) {
    if (this == &other) return *this;
    type_ = other.type_;
    type_->copy(bytes_, other);
    return *this;
  }
  ~Payload() = default;

  template <HasFields T>
  bool holds() const {
    return type_ == type_of<T>();
  }
  /// The value; a type other than the stored one is a bug.
  template <HasFields T>
  T as() const {
    WAITPOINT_CHECK(holds<T>(), "a request's input or output is taken for another type");
    return held<T>();
  }
  /// The number at a field's path of the value: core/field_path.hpp.
  FieldOutcome read(std::string_view path, double& number) const { return type_->read(*this, path, number); }
  /// Adds the value to a digest by its declared fields.
  void add_to(Digest& digest) const { type_->add(digest, *this); }
  /// The value as text by its declared fields: see core/field_text.hpp.
  std::string text() const { return type_->text(*this); }

 private:
  static constexpr std::size_t alignment = 8;

  struct Type {
    void (*copy)(std::byte* to, const Payload& payload);
    void (*add)(Digest& digest, const Payload& payload);
    FieldOutcome (*read)(const Payload& payload, std::string_view path, double& number);
    std::string (*text)(const Payload& payload);
  };
  template <class T>
  const T& held() const {
    return *std::launder(reinterpret_cast<const T*>(bytes_));
  }
  template <class T>
  static const Type* type_of() {
    static constexpr Type type{[](std::byte* to, const Payload& payload) { new (to) T(payload.held<T>()); },
                               [](Digest& digest, const Payload& payload) { add_value(digest, payload.held<T>()); },
                               [](const Payload& payload, std::string_view path, double& number) {
                                 return read_number(payload.held<T>(), path, number);
                               },
                               [](const Payload& payload) { return text_of(payload.held<T>()); }};
    return &type;
  }

  const Type* type_;
  alignas(alignment) std::byte bytes_[payload_bytes_max];
};

}  // namespace waitpoint::genom
