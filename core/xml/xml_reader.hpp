// SPDX-License-Identifier: BSD-3-Clause
// Values of XML elements, read strictly: anything unexpected is BadInput at the element's line.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <string>

namespace tinyxml2 {
class XMLDocument;
class XMLElement;
}  // namespace tinyxml2

namespace waitpoint {

/// Owns the parsed document; `file` is its name, for messages.
class XmlReader {
 public:
  using Element = tinyxml2::XMLElement;
  static constexpr double number_max = 1e5;  ///< metres, mostly

  /// BadInput for malformed XML, or a root element with another name than `root`.
  XmlReader(const std::string& contents, const std::string& file, const char* root);
  ~XmlReader();
  XmlReader(const XmlReader&) = delete;
  XmlReader& operator=(const XmlReader&) = delete;

  const std::string& file() const { return file_; }
  const Element& root() const;

  [[noreturn]] void fail(const Element& at, const std::string& message) const;
  const Element& required(const Element& holder, const char* name) const;

  /// The element's text without the blanks at both ends; may be empty.
  static std::string text_or_nothing(const Element& element);
  std::string text(const Element& element) const;
  /// "true", "1", "false" or "0".
  bool flag(const Element& element) const;
  /// Exactly `count` numbers, none beyond number_max.
  template <std::size_t count>
  std::array<double, count> numbers(const Element& element) const {
    std::array<double, count> values{};
    read_numbers(element, text_or_nothing(element), "", values);
    return values;
  }
  /// Above 0, at most number_max.
  double positive(const Element& element) const;

  /// The same of an attribute.
  std::string text(const Element& element, const char* attribute) const;
  template <std::size_t count>
  std::array<double, count> numbers(const Element& element, const char* attribute) const {
    std::array<double, count> values{};
    read_numbers(element, text(element, attribute), attribute, values);
    return values;
  }
  double positive(const Element& element, const char* attribute) const;
  /// Three factors, none of them 0; without an attribute of the element's own text.
  std::array<double, 3> scale(const Element& element, const char* attribute = "") const;

 private:
  // `attribute` is the source of the text; empty: the element's own text.
  static std::string source(const Element& element, const std::string& attribute);
  void read_numbers(const Element& element, const std::string& text, const std::string& attribute,
                    std::span<double> values) const;

  std::string file_;
  std::unique_ptr<tinyxml2::XMLDocument> document_;
};

}  // namespace waitpoint
