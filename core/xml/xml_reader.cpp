// SPDX-License-Identifier: BSD-3-Clause
#include "core/xml/xml_reader.hpp"

#include <tinyxml2.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "core/error.hpp"
#include "core/number_text.hpp"

namespace waitpoint {
namespace {

constexpr std::size_t bytes_max = 16 << 20;
constexpr std::string_view xml_blanks = " \t\r\n";

std::string in_brackets(const char* name) { return "<" + std::string(name) + ">"; }

}  // namespace

XmlReader::XmlReader(const std::string& contents, const std::string& file, const char* root)
    : file_(file), document_(std::make_unique<tinyxml2::XMLDocument>()) {
  if (contents.size() > bytes_max) {
    throw BadInput(file, "expected XML of at most " + std::to_string(bytes_max >> 20) + " MiB");
  }
  // To tinyxml2, a zero byte ends the text.
  if (contents.find('\0') != std::string::npos) throw BadInput(file, 1, "expected XML, found a zero byte");
  if (document_->Parse(contents.data(), contents.size()) != tinyxml2::XML_SUCCESS) {
    throw BadInput(file, std::max(document_->ErrorLineNum(), 1),
                   std::string("expected XML, found ") + document_->ErrorName());
  }
  const Element* outermost = document_->RootElement();
  if (outermost == nullptr || std::string_view(outermost->Name()) != root) {
    throw BadInput(file, outermost == nullptr ? 1 : outermost->GetLineNum(),
                   "expected the outermost element to be " + in_brackets(root));
  }
}

XmlReader::~XmlReader() = default;

const XmlReader::Element& XmlReader::root() const { return *document_->RootElement(); }

void XmlReader::fail(const Element& at, const std::string& message) const {
  throw BadInput(file_, at.GetLineNum(), message);
}

const XmlReader::Element& XmlReader::required(const Element& holder, const char* name) const {
  const Element* element = holder.FirstChildElement(name);
  if (element == nullptr) fail(holder, "expected " + in_brackets(name) + " in " + in_brackets(holder.Name()));
  return *element;
}

std::string XmlReader::text_or_nothing(const Element& element) {
  const char* given = element.GetText();
  const std::string_view view = given == nullptr ? "" : given;
  const std::size_t first = view.find_first_not_of(xml_blanks);
  if (first == view.npos) return "";
  return std::string(view.substr(first, view.find_last_not_of(xml_blanks) + 1 - first));
}

std::string XmlReader::text(const Element& element) const {
  std::string found = text_or_nothing(element);
  if (found.empty()) fail(element, "expected a text in " + in_brackets(element.Name()));
  return found;
}

bool XmlReader::flag(const Element& element) const {
  const std::string value = text(element);
  if (value == "1" || value == "true") return true;
  if (value == "0" || value == "false") return false;
  fail(element, "expected " + in_brackets(element.Name()) + " to be true or false");
}

double XmlReader::positive(const Element& element) const {
  const double number = numbers<1>(element)[0];
  if (!(number > 0)) fail(element, "expected " + in_brackets(element.Name()) + " to be positive");
  return number;
}

std::string XmlReader::text(const Element& element, const char* attribute) const {
  const char* found = element.Attribute(attribute);
  if (found == nullptr || *found == '\0') {
    fail(element, "expected " + in_brackets(element.Name()) + " to have '" + attribute + "'");
  }
  return found;
}

double XmlReader::positive(const Element& element, const char* attribute) const {
  const double number = numbers<1>(element, attribute)[0];
  if (!(number > 0)) fail(element, "expected " + source(element, attribute) + " to be positive");
  return number;
}

std::array<double, 3> XmlReader::scale(const Element& element, const char* attribute) const {
  std::array<double, 3> factors{};
  read_numbers(element, *attribute == '\0' ? text_or_nothing(element) : text(element, attribute), attribute, factors);
  if (std::ranges::count(factors, 0) > 0) fail(element, "expected " + source(element, attribute) + " not to be zero");
  return factors;
}

std::string XmlReader::source(const Element& element, const std::string& attribute) {
  return (attribute.empty() ? "" : "'" + attribute + "' of ") + in_brackets(element.Name());
}

void XmlReader::read_numbers(const Element& element, const std::string& text, const std::string& attribute,
                             std::span<double> values) const {
  std::string_view rest = text;
  const auto next_word = [&] {
    rest.remove_prefix(std::min(rest.find_first_not_of(xml_blanks), rest.size()));
    const std::string_view word = rest.substr(0, rest.find_first_of(xml_blanks));
    rest.remove_prefix(word.size());
    return word;
  };
  bool good = true;
  for (double& value : values) {
    std::string_view word = next_word();
    if (word.starts_with('+')) word.remove_prefix(1);
    good = good && parse_number(word, value) && std::fabs(value) <= number_max;
  }
  if (good && next_word().empty()) return;
  fail(element, "expected " + counted(values.size(), "number") + " within 100 km in " + source(element, attribute));
}

}  // namespace waitpoint
