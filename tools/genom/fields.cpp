// SPDX-License-Identifier: BSD-3-Clause
// The values that stand for C's in the frame.
#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "tools/genom/c_text.hpp"
#include "tools/genom/generators.hpp"

namespace waitpoint::tools {

using description::Description;
using description::Field;
using description::Parameter;
using description::Poster;
using description::Request;
using description::Type;
using description::TypeKind;

namespace {

/// A member of a struct with fields: its declaration, its declared field, its conversions.
struct MemberText {
  std::string declarations, fields, from, to;

  void add(const Type& type, const std::string& name, const std::string& of, const std::string& initial = "{}") {
    declarations += fmt::format("  {} {}{};\n", frame_type(type, of + "_" + name), name, initial);
    fields += fmt::format("    field(\"{0}\", &{1}::{0});\n", name, of);
    from += fmt::format("    waitpoint::genom::from_c({0}, c_.{0});\n", name);
    to += fmt::format("    waitpoint::genom::to_c(c_.{0}, {0});\n", name);
  }
  std::string fields_function() const {
    return fmt::format("\n  static void fields(auto{}) {{\n{}  }}\n", fields.empty() ? "" : " field", fields);
  }
};

class FieldsHeader {
 public:
  explicit FieldsHeader(const Description& description) : description_(description) {}

  std::string text() {
    for (const Request& request : description_.requests)
      for (const auto* parameter : {&request.input, &request.output})
        if (*parameter) add_structs(*(*parameter)->type, "", "");
    for (const Poster& poster : description_.posters) add_structs(*poster_type(description_, poster), "", "");
    std::string letters;
    for (const Request& request : description_.requests) {
      if (request.input) letters += letter(request, *request.input, "Input");
      if (request.output) letters += letter(request, *request.output, "Output");
    }
    return fmt::format(
        "#pragma once\n\n#include <array>\n#include <cstdint>\n#include <type_traits>\n"
        "#include <waitpoint/core/fields.hpp>\n#include <waitpoint/modules/genom/c_values.hpp>\n\n"
        "#include \"{0}Type.h\"\n\n{1}namespace genom_{0} {{\n{2}\n}}  // namespace genom_{0}\n",
        description_.name.text, structs_, letters);
  }

 private:
  // The structs within a type, innermost first; each header guards them, since modules share types.
  void add_structs(const Type& type, const std::string& inside, const std::string& c_type) {
    if (type.kind == TypeKind::array) return add_structs(*type.element, inside, c_type);
    if (type.kind != TypeKind::structure) return;
    const std::string name = fields_name(type, inside);
    const std::string of_c = type.name.empty() ? c_type : "::" + type.name.substr(type.name.rfind(' ') + 1);
    if (!done_.insert(name).second) return;
    MemberText members;
    std::string checks;
    for (const Field& field : type.fields) {
      add_structs(*field.type, name + "_" + field.name,
                  fmt::format("std::remove_all_extents_t<decltype({}::{})>", of_c, field.name));
      members.add(*field.type, field.name, name);
      checks += fmt::format(" && offsetof({}, {}) == {}", type.name.empty() ? name + "::CType" : of_c, field.name,
                            field.offset);
    }
    structs_ += fmt::format(
        "#ifndef GENOM_FIELDS_{0}\n#define GENOM_FIELDS_{0}\nnamespace genom_fields {{\nstruct {0} {{\n"
        "  using CType = {1};\n{2}{3}  void from(const CType& c_) {{\n{4}  }}\n  void to(CType& c_) const {{\n{5}  "
        "}}\n}};\n"
        "// As the description lays it out.\nstatic_assert(sizeof({0}::CType) == {6}{7});\n"
        "}}  // namespace genom_fields\n#endif\n\n",
        name, of_c, members.declarations, members.fields_function(), members.from, members.to, type.size, checks);
  }

  // The input or output of a request: one field, with the name and default values that the description gives it.
  std::string letter(const Request& request, const Parameter& parameter, const char* what) const {
    const std::string name = request.name.text + what;
    std::size_t info = 0;
    const bool has_defaults = what[0] == 'I' && !request.input_infos.empty();
    MemberText member;
    member.add(*parameter.type, parameter.name, name,
               has_defaults ? " = " + default_value(*parameter.type, request, info) : "{}");
    return fmt::format("\n/// {} of {}.\nstruct {} {{\n{}{}}};\n", what, request.name.text, name, member.declarations,
                       member.fields_function());
  }

  static std::string default_value(const Type& type, const Request& request, std::size_t& info) {
    if (is_text(type)) {
      const std::string text = request.input_infos[info++].value;
      return fmt::format("std::to_array<char>({{{}}})", letters_of(text, type.count));
    }
    std::string values;
    const auto add = [&](const Type& part) {
      values += (values.empty() ? "" : ", ") + default_value(part, request, info);
    };
    if (type.kind == TypeKind::array)
      for (std::size_t i = 0; i < type.count; ++i) add(*type.element);
    else if (type.kind == TypeKind::structure)
      for (const Field& field : type.fields) add(*field.type);
    else
      return request.input_infos[info++].value;
    return type.kind == TypeKind::array ? "{{" + values + "}}" : "{" + values + "}";
  }
  static std::string letters_of(const std::string& text, std::size_t count) {
    std::string letters;
    for (std::size_t i = 0; i < count; ++i)
      letters +=
          (i == 0 ? "" : ", ") + std::to_string(i < text.size() && i + 1 < count ? static_cast<int>(text[i]) : 0);
    return letters;
  }

  const Description& description_;
  std::set<std::string> done_;
  std::string structs_;
};

}  // namespace

std::string fields_header(const Description& description) {
  return generated_line(description, "//") + FieldsHeader(description).text();
}

}  // namespace waitpoint::tools
