// SPDX-License-Identifier: BSD-3-Clause
#include "modules/description/type.hpp"

#include <algorithm>

namespace waitpoint::description {
namespace {

constexpr std::size_t size_max = std::size_t{1} << 30;

std::size_t aligned(std::size_t offset, std::size_t alignment) {
  return (offset + alignment - 1) / alignment * alignment;
}

}  // namespace

std::size_t size_of(Scalar scalar) {
  constexpr std::size_t sizes[] = {1, 1, 1, 1, 2, 2, 4, 4, 8, 8, 4, 8};
  return sizes[static_cast<std::size_t>(scalar)];
}

const char* name(Scalar scalar) {
  constexpr const char* names[] = {"bool", "char", "i8", "u8", "i16", "u16", "i32", "u32", "i64", "u64", "f32", "f64"};
  return names[static_cast<std::size_t>(scalar)];
}

TypeRef scalar_type(Scalar scalar, std::string name) {
  Type type;
  type.scalar = scalar;
  type.name = std::move(name);
  type.size = type.alignment = size_of(scalar);
  return std::make_shared<const Type>(std::move(type));
}

TypeRef enum_type(std::vector<Enumerator> enumerators, std::string name) {
  Type type;
  type.kind = TypeKind::enumeration;
  const bool negative = std::any_of(enumerators.begin(), enumerators.end(), [](auto& e) { return e.value < 0; });
  type.scalar = negative ? Scalar::i32 : Scalar::u32;
  type.name = std::move(name);
  type.enumerators = std::move(enumerators);
  type.size = type.alignment = size_of(type.scalar);
  return std::make_shared<const Type>(std::move(type));
}

TypeRef struct_type(std::vector<Field> fields, std::string name, const SourcePlace& place) {
  Type type;
  type.kind = TypeKind::structure;
  type.name = std::move(name);
  for (Field& field : fields) {
    field.offset = aligned(type.size, field.type->alignment);
    type.size = field.offset + field.type->size;
    type.alignment = std::max(type.alignment, field.type->alignment);
    if (type.size > size_max) reject(place, "expected a type of at most 1 GiB");
  }
  type.size = aligned(type.size, type.alignment);
  type.fields = std::move(fields);
  return std::make_shared<const Type>(std::move(type));
}

TypeRef array_type(TypeRef element, std::size_t count, const SourcePlace& place) {
  if (count == 0 || count > size_max / std::max<std::size_t>(element->size, 1))
    reject(place, "expected an array of 1 element to 1 GiB");
  Type type;
  type.kind = TypeKind::array;
  type.size = element->size * count;
  type.alignment = element->alignment;
  type.element = std::move(element);
  type.count = count;
  return std::make_shared<const Type>(std::move(type));
}

TypeRef renamed(const Type& type, std::string name) {
  Type copy = type;
  copy.name = std::move(name);
  return std::make_shared<const Type>(std::move(copy));
}

const Field* find_field(const Type& type, const std::string& name) {
  for (const Field& field : type.fields)
    if (field.name == name) return &field;
  return nullptr;
}

std::string structure(const Type& type) {
  switch (type.kind) {
    case TypeKind::scalar: return name(type.scalar);
    case TypeKind::enumeration: return std::string("enum(") + name(type.scalar) + ")";
    case TypeKind::array:
      if (is_text(type)) return "text[" + std::to_string(type.count) + "]";
      return "[" + std::to_string(type.count) + "]" + structure(*type.element);
    case TypeKind::structure: break;
  }
  std::string text;
  for (const Field& field : type.fields)
    text += (text.empty() ? "" : ", ") + field.name + ": " + structure(*field.type);
  return "{" + text + "}";
}

}  // namespace waitpoint::description
