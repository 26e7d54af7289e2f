// SPDX-License-Identifier: BSD-3-Clause
// An element of a launch file, read strictly: its attributes are known ones, with all substitutions carried out.
#pragma once

#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "modules/ros1/launch_scope.hpp"
#include "modules/ros1/substitution.hpp"

namespace tinyxml2 {
class XMLElement;
}

namespace waitpoint::ros1 {

class LaunchElement {
 public:
  /// BadInput for an attribute that is neither among `attributes` nor `if` or `unless`. Must not outlive what it is
  /// given.
  LaunchElement(const tinyxml2::XMLElement& element, LaunchScope& scope, Substitution& substitution,
                std::initializer_list<std::string_view> attributes);

  const tinyxml2::XMLElement& xml() const { return element_; }
  std::string name() const;
  Location written() const;
  BadInput bad(const std::string& message) const { return written().bad(message); }

  /// By its `if` or `unless`.
  bool applies() const;

  /// None without the attribute.
  std::optional<std::string> find(const char* attribute) const;
  /// BadInput if the attribute is missing or empty.
  std::string require(const char* attribute) const;
  /// "true" or "false", in letters of any case.
  bool truth(const char* attribute, bool otherwise) const;
  /// The index of the attribute's value in `words`.
  std::size_t one_of(const char* attribute, std::span<const std::string_view> words, std::size_t otherwise) const;

  /// The element's own text, without comments, after as many line ends that its lines have the numbers of the file's.
  std::string text_at_its_lines() const;

 private:
  const tinyxml2::XMLElement& element_;
  LaunchScope& scope_;
  Substitution& substitution_;
};

/// "<node>", for messages.
std::string in_brackets(std::string_view element);

/// BadInput for an element that is not among `known`, in the element `holder`.
void require_known(const LaunchScope& scope, const tinyxml2::XMLElement& element, std::string_view holder,
                   std::span<const std::string_view> known);

}  // namespace waitpoint::ros1
