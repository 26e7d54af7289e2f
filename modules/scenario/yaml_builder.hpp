// SPDX-License-Identifier: BSD-3-Clause
// Builds the values of a YAML document while its text is parsed, in one pass: time and memory are linear in the number
// of values. Aliases become copies of their anchors, and the key `<<` of YAML 1.1 is carried out: the map of its alias,
// or each of a list of maps, gives the keys that its own map does not have.
//
// Bounds: 32 levels; and for a text of n bytes 20 000 + 8 n values, at most 16 million, since anchors can multiply a
// short text without limit ("billion laughs").
#pragma once

#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/mark.h>

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "modules/scenario/yaml_tree.hpp"

namespace waitpoint::scenario {

/// Throws BadInput at the value that exceeds a bound, and for a key that is given twice.
class YamlBuilder : public YAML::EventHandler {
 public:
  /// `size`: of the text, in bytes.
  YamlBuilder(const std::string& file, bool file_has_lines, std::size_t size);

  Location location(const YAML::Mark& mark) const;
  /// The finished document, after all events; null if the text has none. BadInput if it has a key that is no word.
  YamlNode take();

  void OnDocumentStart(const YAML::Mark&) override {}
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override;
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) override;
  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                const std::string& text) override;
  void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value style) override;
  void OnSequenceEnd() override { close(); }
  void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value style) override;
  void OnMapEnd() override { close(); }

 private:
  /// A list or map whose end is not yet read.
  struct Open {
    YamlNode node;
    YAML::anchor_t anchor = 0;
    std::size_t first = 0;  ///< number of the values before it
    int height = 0;         ///< levels of its elements so far
    bool has_key = false;   ///< of a map: the value of the last entry, or of `<<`, is next
    bool merges = false;    ///< that value is the one of `<<`
    std::vector<YamlNode> merged;
    std::set<std::string, std::less<>> keys;  ///< of a map of many entries, to find one given twice
  };
  struct Anchored {
    YamlNode node;
    std::size_t values = 0;
    int height = 0;
  };

  void open(YamlNode::Kind kind, const YAML::Mark& mark, YAML::anchor_t anchor);
  void close();
  /// Counts values that are read or copied at a place, `height` levels of them.
  void count(std::size_t values, int height, const Location& written);
  void add(YamlNode node, int height);
  void add_key(const YamlNode& key);
  void keep(YAML::anchor_t anchor, const YamlNode& node, std::size_t values, int height);

  FileName file_;
  bool file_has_lines_;
  std::size_t count_max_;
  std::size_t count_ = 0;
  std::vector<Open> open_;
  std::map<YAML::anchor_t, Anchored> anchors_;
  std::optional<Location> no_word_;  // the first key that is none
  YamlNode root_;
};

/// The start of a second document, as an event handler for it: an empty one at the end of a text does not count.
class FurtherDocument : public YAML::EventHandler {
 public:
  YAML::Mark begin;
  bool empty = true;

  void OnDocumentStart(const YAML::Mark& mark) override;
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark&, YAML::anchor_t) override {}
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t) override { fill(mark); }
  void OnScalar(const YAML::Mark& mark, const std::string&, YAML::anchor_t, const std::string&) override { fill(mark); }
  void OnSequenceStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t, YAML::EmitterStyle::value) override {
    fill(mark);
  }
  void OnSequenceEnd() override {}
  void OnMapStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t, YAML::EmitterStyle::value) override {
    fill(mark);
  }
  void OnMapEnd() override {}

 private:
  void fill(const YAML::Mark& mark);
};

}  // namespace waitpoint::scenario
