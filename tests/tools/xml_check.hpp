// SPDX-License-Identifier: BSD-3-Clause
// A check for well-formed XML, for the features that pictures use: elements, attributes in double quotes, text,
// entities.
#pragma once

#include <algorithm>
#include <cctype>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace waitpoint::tools {

class XmlCheck {
 public:
  explicit XmlCheck(std::string_view text) : text_(text) {
    while (at_ < text_.size() && problem_.empty()) text_[at_] == '<' ? read_tag() : read_text();
    if (problem_.empty() && !open_.empty()) fail("element " + open_.back() + " is not closed");
  }

  /// "" if the text is well-formed, else the error and its place.
  const std::string& problem() const { return problem_; }
  /// The number of elements of each name.
  std::size_t count(const std::string& element) const {
    const auto found = count_.find(element);
    return found == count_.end() ? 0 : found->second;
  }

 private:
  void fail(const std::string& what) { problem_ = what + " at byte " + std::to_string(at_); }
  bool take(char c) {
    if (at_ >= text_.size() || text_[at_] != c) return false;
    ++at_;
    return true;
  }
  void skip_space() {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_]))) ++at_;
  }
  std::string name() {
    const std::size_t begin = at_;
    while (at_ < text_.size() && (std::isalnum(static_cast<unsigned char>(text_[at_])) || text_[at_] == '-')) ++at_;
    return std::string(text_.substr(begin, at_ - begin));
  }

  void check_characters(std::string_view part) {
    for (std::size_t i = 0; i < part.size(); ++i) {
      if (part[i] == '<') return fail("a bare <");
      if (part[i] != '&') continue;
      const std::string_view entity = part.substr(i, part.find(';', i) - i + 1);
      const bool known = entity == "&amp;" || entity == "&lt;" || entity == "&gt;" || entity == "&quot;";
      if (!known) return fail("a bare &");
    }
  }

  void read_text() {
    const std::size_t end = std::min(text_.find('<', at_), text_.size());
    const std::string_view part = text_.substr(at_, end - at_);
    check_characters(part);
    if (open_.empty() && part.find_first_not_of(" \n") != std::string_view::npos) fail("text outside the root");
    at_ = end;
  }

  void read_tag() {
    take('<');
    if (take('/')) {
      const std::string closed = name();
      if (open_.empty() || open_.back() != closed || !take('>')) return fail("</" + closed + "> closes nothing");
      return open_.pop_back();
    }
    const std::string element = name();
    if (element.empty()) return fail("an element without a name");
    ++count_[element];
    std::map<std::string, int> attributes;
    for (skip_space(); at_ < text_.size() && text_[at_] != '>' && text_[at_] != '/'; skip_space()) {
      const std::string attribute = name();
      if (attribute.empty() || ++attributes[attribute] > 1) return fail("a bad attribute '" + attribute + "'");
      if (!take('=') || !take('"')) return fail("an attribute without a value");
      const std::size_t end = text_.find('"', at_);
      if (end == std::string_view::npos) return fail("an attribute without an end");
      check_characters(text_.substr(at_, end - at_));
      at_ = end + 1;
    }
    const bool is_empty = take('/');
    if (!take('>')) return fail("a tag without an end");
    if (!is_empty) open_.push_back(element);
  }

  std::string_view text_;
  std::size_t at_ = 0;
  std::vector<std::string> open_;
  std::map<std::string, std::size_t> count_;
  std::string problem_;
};

}  // namespace waitpoint::tools
