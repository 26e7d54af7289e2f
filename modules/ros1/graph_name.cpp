// SPDX-License-Identifier: BSD-3-Clause
#include "modules/ros1/graph_name.hpp"

#include <algorithm>

namespace waitpoint::ros1 {
namespace {

bool is_ascii_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
bool fits_in_word(char c) { return is_ascii_letter(c) || (c >= '0' && c <= '9') || c == '_'; }

}  // namespace

bool is_base_name(std::string_view name) {
  return !name.empty() && is_ascii_letter(name.front()) && std::all_of(name.begin(), name.end(), fits_in_word);
}

bool is_graph_name(std::string_view name) {
  if (name == "/") return true;
  const bool has_mark = name.starts_with('/') || name.starts_with('~');
  if (name.starts_with("~/")) name.remove_prefix(1);
  if (has_mark) name.remove_prefix(1);
  if (name.empty() || !is_ascii_letter(name.front()) || name.back() == '/') return false;
  if (name.find("//") != name.npos) return false;
  return std::all_of(name.begin(), name.end(), [](char c) { return c == '/' || fits_in_word(c); });
}

std::string without_extra_slashes(std::string_view name) {
  std::string result;
  for (const char c : name)
    if (c != '/' || !result.ends_with('/')) result += c;
  if (result.size() > 1 && result.ends_with('/')) result.pop_back();
  return result;
}

std::string resolved(std::string_view name, std::string_view ns) {
  if (name.starts_with('/')) return without_extra_slashes(name);
  return without_extra_slashes(std::string(ns) + "/" + std::string(name));
}

std::string resolved(std::string_view name, std::string_view ns, std::string_view node) {
  return name.starts_with('~') ? resolved(name.substr(1).substr(name.starts_with("~/") ? 1 : 0), node)
                               : resolved(name, ns);
}

}  // namespace waitpoint::ros1
