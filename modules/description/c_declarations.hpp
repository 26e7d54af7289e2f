// SPDX-License-Identifier: BSD-3-Clause
// C declarations of types, in the subset that GenoM's manual allows: typedefs, structs, enums and arrays of these and
// of numbers; no pointers, unions and bit-fields, which have no meaning outside the process or no address. Prototypes,
// inline functions and variables of included headers are skipped.
#pragma once

#include <map>
#include <string>

#include "modules/description/token_stream.hpp"
#include "modules/description/type.hpp"

namespace waitpoint::description {

class CDeclarations {
 public:
  /// Knows the numbers of C, <stdint.h>, <stdbool.h> and <stddef.h>.
  CDeclarations();

  /// Takes one declaration with its ';'. BadInput for anything else.
  void declare(TokenStream& tokens);
  /// Takes the name of a type: "unsigned long", "struct POINT", "DEMO_STR". BadInput for an unknown one.
  TypeRef type_name(TokenStream& tokens);
  /// Takes a constant expression, of which enumerators may be part.
  std::int64_t constant(TokenStream& tokens) const;

  /// Null if there is no such typedef.
  TypeRef find_type(const std::string& name) const;

 private:
  TypeRef specifier(TokenStream& tokens, int depth);
  TypeRef number_specifier(TokenStream& tokens);
  TypeRef struct_specifier(TokenStream& tokens, int depth);
  TypeRef enum_specifier(TokenStream& tokens);
  Field declarator(TokenStream& tokens, const TypeRef& base, const char* what);
  void define_typedefs(TokenStream& tokens, const TypeRef& base);

  std::map<std::string, TypeRef> typedefs_;
  std::map<std::string, TypeRef> tags_;  // "struct NAME", "enum NAME"
  std::map<std::string, std::int64_t> enumerators_;
};

}  // namespace waitpoint::description
