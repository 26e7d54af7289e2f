// SPDX-License-Identifier: BSD-3-Clause
#include "modules/tcl/library/input.hpp"

#include <algorithm>
#include <string_view>

namespace waitpoint::tcl {
namespace {

const FieldShape* part_of(const FieldShape& shape, std::string_view name) {
  const auto found =
      std::find_if(shape.parts.begin(), shape.parts.end(), [&](auto& part) { return part.name == name; });
  return found != shape.parts.end() ? &*found : nullptr;
}

/// The field with the key `path`, such as "via.0.x"; null if there is none.
const FieldShape* field_at(const FieldShape& shape, std::string_view path) {
  const FieldShape* at = &shape;
  while (at != nullptr && !path.empty()) {
    const std::string_view name = path.substr(0, path.find('.'));
    path.remove_prefix(std::min(path.size(), name.size() + 1));
    at = at->kind == FieldShape::Kind::list ? &at->parts.front() : part_of(*at, name);
  }
  return at;
}

class Reader {
 public:
  Reader(Tcl_Interp* tcl, std::vector<Setting>& settings) : tcl_(tcl), settings_(settings) {}

  bool read(const FieldShape& shape, const std::string& key, Tcl_Obj* value) {
    if (shape.kind == FieldShape::Kind::value) {
      settings_.push_back({key, Tcl_GetString(value), "the request", 0});
      return true;
    }
    int count = 0;
    Tcl_Obj** items = nullptr;
    if (Tcl_ListObjGetElements(tcl_, value, &count, &items) != TCL_OK) return false;
    const std::span<Tcl_Obj* const> all(items, static_cast<std::size_t>(count));
    return shape.kind == FieldShape::Kind::list ? read_list(shape, key, all) : read_record(shape, key, all);
  }

 private:
  bool read_list(const FieldShape& shape, const std::string& key, std::span<Tcl_Obj* const> items) {
    for (std::size_t i = 0; i < items.size(); ++i)
      if (!read(shape.parts.front(), key + "." + std::to_string(i), items[i])) return false;
    return true;
  }

  bool read_record(const FieldShape& shape, const std::string& key, std::span<Tcl_Obj* const> items) {
    const bool is_dictionary = items.size() % 2 == 0 && !items.empty() && part_of(shape, Tcl_GetString(items[0]));
    if (!is_dictionary && items.size() > shape.parts.size()) {
      Tcl_SetObjResult(
          tcl_, Tcl_ObjPrintf("expected at most %d values for '%s', found %d", static_cast<int>(shape.parts.size()),
                              key.c_str(), static_cast<int>(items.size())));
      return false;
    }
    const std::size_t step = is_dictionary ? 2 : 1;
    for (std::size_t i = 0; i < items.size(); i += step) {
      const FieldShape* const part = is_dictionary ? part_of(shape, Tcl_GetString(items[i])) : &shape.parts[i];
      if (part == nullptr) {
        Tcl_SetObjResult(tcl_, Tcl_ObjPrintf("'%s' has no field '%s'", key.c_str(), Tcl_GetString(items[i])));
        return false;
      }
      if (!read(*part, key + "." + part->name, items[i + step - 1])) return false;
    }
    return true;
  }

  Tcl_Interp* tcl_;
  std::vector<Setting>& settings_;
};

}  // namespace

bool read_input(Tcl_Interp* tcl, const FieldShape& input, std::span<Tcl_Obj* const> words,
                std::vector<Setting>& settings) {
  Reader reader(tcl, settings);
  std::size_t place = 0;
  for (Tcl_Obj* word : words) {
    const std::string_view text = Tcl_GetString(word);
    const std::size_t equals = text.find('=');
    if (equals != std::string_view::npos) {
      const std::string key(text.substr(0, equals)), value(text.substr(equals + 1));
      const FieldShape* const field = field_at(input, key);
      // An unknown key is reported with the known ones by the request's own check.
      static const FieldShape any;
      Tcl_Obj* const part = Tcl_NewStringObj(value.data(), static_cast<int>(value.size()));
      Tcl_IncrRefCount(part);
      const bool is_good = reader.read(field != nullptr ? *field : any, key, part);
      Tcl_DecrRefCount(part);
      if (!is_good) return false;
      continue;
    }
    if (place == input.parts.size()) {
      Tcl_SetObjResult(tcl, Tcl_ObjPrintf("expected at most %d arguments, found '%s'",
                                          static_cast<int>(input.parts.size()), Tcl_GetString(word)));
      return false;
    }
    const FieldShape& field = input.parts[place++];
    if (!reader.read(field, field.name, word)) return false;
  }
  return true;
}

}  // namespace waitpoint::tcl
