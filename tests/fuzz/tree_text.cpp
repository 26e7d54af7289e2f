// SPDX-License-Identifier: BSD-3-Clause
#include "tests/fuzz/tree_text.hpp"

#include <algorithm>
#include <string_view>

namespace waitpoint::fuzz {
namespace {

using scenario::YamlEntry;
using scenario::YamlNode;

bool is_plain(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
         std::string_view("._-+/").find(c) != std::string_view::npos;
}

bool is_plain(const std::string& text) {
  return !text.empty() && text != "-" && text != "null" &&
         std::all_of(text.begin(), text.end(), [](char c) { return is_plain(c); });
}

std::string quoted(const std::string& text) {
  constexpr std::string_view digits = "0123456789abcdef";
  std::string result = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte >= ' ' && byte < 0x7F && c != '"' && c != '\\') {
      result += c;
    } else {
      result += "\\x";
      result += digits[byte >> 4U];
      result += digits[byte & 15U];
    }
  }
  return result + "\"";
}

void append(const YamlNode& node, std::string& text) {
  switch (node.kind) {
    case YamlNode::Kind::null: text += "~"; break;
    case YamlNode::Kind::scalar: text += node.quoted || !is_plain(node.text) ? quoted(node.text) : node.text; break;
    case YamlNode::Kind::list:
      text += "[";
      for (const YamlNode& item : node.items) {
        if (text.back() != '[') text += ", ";
        append(item, text);
      }
      text += "]";
      break;
    case YamlNode::Kind::map:
      text += "{";
      for (const YamlEntry& entry : node.entries) {
        if (text.back() != '{') text += ", ";
        text += (is_plain(entry.key) ? entry.key : quoted(entry.key)) + ": ";
        append(entry.value, text);
      }
      text += "}";
      break;
  }
}

}  // namespace

std::string text_of(const YamlNode& root) {
  std::string text;
  if (root.kind != YamlNode::Kind::map) {
    append(root, text);
    return text + "\n";
  }
  for (const YamlEntry& entry : root.entries) {
    text += (is_plain(entry.key) ? entry.key : quoted(entry.key)) + ": ";
    append(entry.value, text);
    text += "\n";
  }
  return text;
}

}  // namespace waitpoint::fuzz
