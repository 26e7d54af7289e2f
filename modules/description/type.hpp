// SPDX-License-Identifier: BSD-3-Clause
// C types of values without pointers, laid out as by the System V ABI of x86-64: a member is aligned to its own size
// up to 8 bytes, a struct to its most aligned member.
//
//   struct { char c; double d[2]; short s; }     c.......dddddddddddddddd ss......   32 bytes, aligned to 8
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "modules/description/place.hpp"

namespace waitpoint::description {

enum class Scalar : std::uint8_t { boolean, character, i8, u8, i16, u16, i32, u32, i64, u64, f32, f64 };

std::size_t size_of(Scalar scalar);
/// "i32", "f64", "bool", "char".
const char* name(Scalar scalar);

struct Type;
using TypeRef = std::shared_ptr<const Type>;

struct Enumerator {
  std::string name;
  std::int64_t value = 0;
};

/// A member of a struct.
struct Field {
  std::string name;
  TypeRef type;
  std::size_t offset = 0;
};

enum class TypeKind : std::uint8_t { scalar, enumeration, structure, array };

struct Type {
  TypeKind kind = TypeKind::scalar;
  std::string name;                     ///< as C writes it, "double", "DEMO_STR", "struct demo"; "" without a name
  Scalar scalar = Scalar::i32;          ///< of scalars; of enums: u32, or i32 if a value is negative
  std::vector<Enumerator> enumerators;  ///< of enums
  std::vector<Field> fields;            ///< of structs, in order
  TypeRef element;                      ///< of arrays
  std::size_t count = 0;                ///< of arrays: number of elements, at least 1
  std::size_t size = 0, alignment = 1;
};

TypeRef scalar_type(Scalar scalar, std::string name);
TypeRef enum_type(std::vector<Enumerator> enumerators, std::string name);
/// Lays out the fields. BadInput at `place` for a type of more than 1 GiB.
TypeRef struct_type(std::vector<Field> fields, std::string name, const SourcePlace& place);
TypeRef array_type(TypeRef element, std::size_t count, const SourcePlace& place);
/// The same type under the name of a typedef.
TypeRef renamed(const Type& type, std::string name);

/// Null if the struct has no such member.
const Field* find_field(const Type& type, const std::string& name);

/// An array of char is a text, up to its first NUL.
inline bool is_text(const Type& type) {
  return type.kind == TypeKind::array && type.element->kind == TypeKind::scalar &&
         type.element->scalar == Scalar::character;
}

/// The structure apart from names of types: "{x: f64, y: f64}", "[3]i32", "text[16]", "enum(u32)".
std::string structure(const Type& type);

}  // namespace waitpoint::description
