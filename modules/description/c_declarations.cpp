// SPDX-License-Identifier: BSD-3-Clause
#include "modules/description/c_declarations.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include "core/nearest_name.hpp"
#include "modules/description/constant_expression.hpp"

namespace waitpoint::description {
namespace {

constexpr int nesting_max = 32;
constexpr std::size_t dimensions_max = 8;

constexpr std::array number_words =
    std::to_array<std::string_view>({"char", "short", "int", "long", "signed", "unsigned", "float", "double", "_Bool"});
constexpr std::array storage_words = std::to_array<std::string_view>(
    {"const", "volatile", "extern", "static", "register", "inline", "__inline", "auto"});

template <std::size_t N>
bool one_of(const Token& token, const std::array<std::string_view, N>& words) {
  return std::any_of(words.begin(), words.end(), [&](std::string_view word) { return is(token, word); });
}

void skip_storage(TokenStream& tokens) {
  while (one_of(tokens.peek(), storage_words)) tokens.take();
}

// True before a prototype or a function: a parenthesis comes before any brace.
bool is_function(const TokenStream& tokens) {
  for (std::size_t ahead = 0;; ++ahead) {
    const Token& token = tokens.peek(ahead);
    if (is(token, "(")) return true;
    if (is(token, "{") || is(token, ";") || is(token, "=") || token.kind == TokenKind::end) return false;
  }
}

// Skips to the end of a declaration, or of a function's body.
void skip_declaration(TokenStream& tokens) {
  int depth = 0;
  while (!tokens.at_end()) {
    const Token token = tokens.take();
    if (is(token, "{")) ++depth;
    if (is(token, "}") && --depth <= 0) return void(tokens.accept(";"));
    if (is(token, ";") && depth == 0) return;
  }
  tokens.fail("expected ';' at the end of a declaration");
}

}  // namespace

CDeclarations::CDeclarations() {
  const std::pair<const char*, Scalar> known[] = {
      {"bool", Scalar::boolean}, {"int8_t", Scalar::i8},   {"uint8_t", Scalar::u8},   {"int16_t", Scalar::i16},
      {"uint16_t", Scalar::u16}, {"int32_t", Scalar::i32}, {"uint32_t", Scalar::u32}, {"int64_t", Scalar::i64},
      {"uint64_t", Scalar::u64}, {"size_t", Scalar::u64},  {"STATUS", Scalar::i32},   {"BOOL", Scalar::i32}};
  for (const auto& [name, scalar] : known) typedefs_[name] = scalar_type(scalar, name);
}

void CDeclarations::declare(TokenStream& tokens) {
  if (tokens.accept(";")) return;
  const bool defines = tokens.accept("typedef");
  if (!defines && is_function(tokens)) return skip_declaration(tokens);
  skip_storage(tokens);
  const TypeRef base = specifier(tokens, 0);
  skip_storage(tokens);
  if (defines) return define_typedefs(tokens, base);
  // A struct or enum alone, or a variable, which concerns the compiler.
  if (!tokens.accept(";")) skip_declaration(tokens);
}

void CDeclarations::define_typedefs(TokenStream& tokens, const TypeRef& base) {
  do {
    const SourcePlace place = tokens.peek().place;
    const Field defined = declarator(tokens, base, "the name of a type");
    const TypeRef before = find_type(defined.name);
    if (before != nullptr && structure(*before) != structure(*defined.type))
      reject(place, "expected one definition of '" + defined.name + "', found another");
    typedefs_[defined.name] = renamed(*defined.type, defined.name);
  } while (tokens.accept(","));
  tokens.expect(";", "at the end of a typedef");
}

TypeRef CDeclarations::type_name(TokenStream& tokens) { return specifier(tokens, 0); }

std::int64_t CDeclarations::constant(TokenStream& tokens) const {
  return constant_expression(tokens, [this](TokenStream& rest, const Token& name) -> std::optional<std::int64_t> {
    if (is(name, "sizeof")) {
      rest.expect("(", "behind 'sizeof'");
      CDeclarations copy = *this;  // a type named here is not declared for others
      const TypeRef type = copy.type_name(rest);
      rest.expect(")", "behind the type of 'sizeof'");
      return static_cast<std::int64_t>(type->size);
    }
    const auto found = enumerators_.find(name.text);
    return found == enumerators_.end() ? std::nullopt : std::optional(found->second);
  });
}

TypeRef CDeclarations::find_type(const std::string& name) const {
  const auto found = typedefs_.find(name);
  return found == typedefs_.end() ? nullptr : found->second;
}

TypeRef CDeclarations::specifier(TokenStream& tokens, int depth) {
  if (depth > nesting_max) tokens.fail("expected structs nested at most 32 deep");
  skip_storage(tokens);
  if (tokens.next_is("struct")) return struct_specifier(tokens, depth);
  if (tokens.next_is("enum")) return enum_specifier(tokens);
  if (tokens.next_is("union"))
    tokens.fail("expected a struct, an enum or a number (a union's content is unknown to others)");
  if (one_of(tokens.peek(), number_words)) return number_specifier(tokens);
  const Token name = tokens.expect_name("a type");
  if (TypeRef found = find_type(name.text)) return found;
  std::vector<std::string_view> known;
  for (const auto& [known_name, type] : typedefs_) known.push_back(known_name);
  reject(name.place, "expected a type, found the unknown name '" + name.text + "'" + did_you_mean(name.text, known));
}

TypeRef CDeclarations::number_specifier(TokenStream& tokens) {
  const SourcePlace place = tokens.peek().place;
  std::map<std::string, int> words;
  std::string spelling;
  while (one_of(tokens.peek(), number_words) || tokens.next_is("const") || tokens.next_is("volatile")) {
    const Token word = tokens.take();
    if (!one_of(word, number_words)) continue;
    ++words[word.text];
    spelling += (spelling.empty() ? "" : " ") + word.text;
  }
  const auto has = [&](const char* word) { return words.contains(word); };
  const auto only = [&](std::initializer_list<const char*> allowed) {
    for (const auto& word : words) {
      const bool known = std::any_of(allowed.begin(), allowed.end(), [&](const char* w) { return word.first == w; });
      if (!known || word.second > (word.first == "long" ? 2 : 1))
        reject(place, "expected a number of C (no long double), found '" + spelling + "'");
    }
  };
  const bool is_unsigned = has("unsigned");
  if (has("signed") && is_unsigned) reject(place, "expected a number of C, found '" + spelling + "'");
  if (has("_Bool")) return only({"_Bool"}), scalar_type(Scalar::boolean, spelling);
  if (has("float")) return only({"float"}), scalar_type(Scalar::f32, spelling);
  if (has("double")) return only({"double"}), scalar_type(Scalar::f64, spelling);
  if (has("char")) {
    only({"char", "signed", "unsigned"});
    if (!is_unsigned && !has("signed")) return scalar_type(Scalar::character, spelling);
    return scalar_type(is_unsigned ? Scalar::u8 : Scalar::i8, spelling);
  }
  if (has("short")) {
    only({"short", "int", "signed", "unsigned"});
    return scalar_type(is_unsigned ? Scalar::u16 : Scalar::i16, spelling);
  }
  only({"long", "int", "signed", "unsigned"});
  if (has("long")) return scalar_type(is_unsigned ? Scalar::u64 : Scalar::i64, spelling);
  return scalar_type(is_unsigned ? Scalar::u32 : Scalar::i32, spelling);
}

TypeRef CDeclarations::struct_specifier(TokenStream& tokens, int depth) {
  const SourcePlace place = tokens.take().place;
  const std::string name =
      tokens.peek().kind == TokenKind::name ? "struct " + tokens.expect_declared_name("the name of a struct").text : "";
  if (!tokens.next_is("{")) {
    const auto found = tags_.find(name);
    if (found == tags_.end())
      tokens.fail(name.empty() ? "expected '{' behind 'struct'" : "expected '{': '" + name + "' is not defined yet");
    return found->second;
  }
  tokens.take();
  std::vector<Field> fields;
  while (!tokens.accept("}")) {
    const TypeRef base = specifier(tokens, depth + 1);
    do {
      const SourcePlace at = tokens.peek().place;
      Field field = declarator(tokens, base, "the name of a member");
      for (const Field& other : fields)
        if (other.name == field.name)
          reject(at, "expected members of different names, found '" + field.name + "' again");
      if (tokens.next_is(":")) tokens.fail("expected a member without a width (a bit-field has no address)");
      fields.push_back(std::move(field));
    } while (tokens.accept(","));
    tokens.expect(";", "behind a member of a struct");
  }
  if (fields.empty()) reject(place, "expected a struct with members");
  TypeRef type = struct_type(std::move(fields), name, place);
  if (!name.empty() && !tags_.emplace(name, type).second) reject(place, "expected one definition of '" + name + "'");
  return type;
}

TypeRef CDeclarations::enum_specifier(TokenStream& tokens) {
  const SourcePlace place = tokens.take().place;
  const std::string name =
      tokens.peek().kind == TokenKind::name ? "enum " + tokens.expect_declared_name("the name of an enum").text : "";
  if (!tokens.next_is("{")) {
    const auto found = tags_.find(name);
    if (found == tags_.end()) tokens.fail("expected '{' behind 'enum'");
    return found->second;
  }
  tokens.take();
  std::vector<Enumerator> enumerators;
  std::int64_t next = 0;
  do {
    if (tokens.next_is("}")) break;  // C99 allows a comma there
    const Token enumerator = tokens.expect_declared_name("the name of an enumerator");
    if (tokens.accept("=")) next = constant(tokens);
    if (next < std::numeric_limits<std::int32_t>::min() || next > std::numeric_limits<std::int32_t>::max())
      reject(enumerator.place, "expected a value of 32 bits for '" + enumerator.text + "'");
    if (!enumerators_.emplace(enumerator.text, next).second)
      reject(enumerator.place, "expected enumerators of different names, found '" + enumerator.text + "' again");
    enumerators.push_back({enumerator.text, next++});
  } while (tokens.accept(","));
  tokens.expect("}", "behind the enumerators");
  if (enumerators.empty()) reject(place, "expected an enum with enumerators");
  TypeRef type = enum_type(std::move(enumerators), name);
  if (!name.empty() && !tags_.emplace(name, type).second) reject(place, "expected one definition of '" + name + "'");
  return type;
}

Field CDeclarations::declarator(TokenStream& tokens, const TypeRef& base, const char* what) {
  if (tokens.next_is("*") || tokens.next_is("("))
    tokens.fail("expected " + std::string(what) + " (pointers and functions mean nothing in another process)");
  Field field{tokens.expect_declared_name(what).text, base};
  std::vector<std::pair<std::size_t, SourcePlace>> dimensions;
  while (tokens.next_is("[")) {
    const SourcePlace place = tokens.take().place;
    if (dimensions.size() == dimensions_max) reject(place, "expected at most 8 dimensions");
    const std::int64_t count = constant(tokens);
    if (count < 1) reject(place, "expected an array of at least 1 element, found " + std::to_string(count));
    dimensions.emplace_back(static_cast<std::size_t>(count), place);
    tokens.expect("]", "behind the size of an array");
  }
  for (; !dimensions.empty(); dimensions.pop_back())
    field.type = array_type(std::move(field.type), dimensions.back().first, dimensions.back().second);
  return field;
}

}  // namespace waitpoint::description
