// SPDX-License-Identifier: BSD-3-Clause
#include "modules/scenario/yaml_tree.hpp"

#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <optional>
#include <sstream>

#include "core/digest.hpp"

namespace waitpoint::scenario {
namespace {

constexpr int depth_max = 32;
constexpr std::size_t node_count_max = 200'000;
// A text of many robots that share anchors has several values for each of its bytes.
constexpr std::size_t values_per_byte = 4;
constexpr std::size_t bytes_max = std::size_t{1} << 22;

/// Converts a document of yaml-cpp, where aliases share nodes, into values.
class Copier {
 public:
  /// `size`: of the text, in bytes.
  Copier(const std::string& file, bool file_has_lines, std::size_t size)
      : file_(file), file_has_lines_(file_has_lines), count_max_(std::max(node_count_max, values_per_byte * size)) {}

  YamlNode copy(const YAML::Node& source, int depth) {
    YamlNode node;
    node.written = location(source.Mark());
    if (++count_ > count_max_)
      throw node.written.bad("more than " + std::to_string(count_max_) + " values: an anchor that multiplies itself?");
    if (depth > depth_max) throw node.written.bad("values are nested more than 32 deep");
    if (source.IsScalar()) {
      copy_scalar(source, node);
    } else if (source.IsSequence()) {
      node.kind = YamlNode::Kind::list;
      for (const YAML::Node& item : source) node.items.push_back(copy(item, depth + 1));
    } else if (source.IsMap()) {
      copy_map(source, node, depth);
    }
    return node;
  }

  Location location(const YAML::Mark& mark) const { return {file_, file_has_lines_ ? std::max(mark.line, 0) + 1 : 0}; }

 private:
  static void copy_scalar(const YAML::Node& source, YamlNode& node) {
    node.kind = YamlNode::Kind::scalar;
    node.text = source.Scalar();
    node.quoted = source.Tag() == "!";
  }

  void copy_map(const YAML::Node& source, YamlNode& node, int depth) {
    node.kind = YamlNode::Kind::map;
    for (const auto& pair : source) {
      const Location written = location(pair.first.Mark());
      if (!pair.first.IsScalar()) throw written.bad("expected a word as key");
      const std::string& key = pair.first.Scalar();
      if (const YamlEntry* other = node.entry(key)) {
        throw written.bad("key '" + key + "' is given twice, first at " + other->written.text());
      }
      node.entries.push_back({key, written, copy(pair.second, depth + 1)});
      // An empty value has no mark of its own; it is located at its key.
      if (node.entries.back().value.is_null()) node.entries.back().value.written = written;
    }
  }

  std::string file_;
  bool file_has_lines_;
  std::size_t count_max_;
  std::size_t count_ = 0;
};

/// Finds the start of the last document, and records whether it has content.
class Documents : public YAML::EventHandler {
 public:
  YAML::Mark begin;
  bool empty = true;

  void OnDocumentStart(const YAML::Mark& mark) override {
    begin = mark;
    empty = true;
  }
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
  void fill(const YAML::Mark& mark) {
    if (empty) begin = mark;
    empty = false;
  }
};

/// The start of a second document, if any; an empty one at the end does not count. Not by YAML::LoadAll, which loops
/// forever where its parser makes no progress: it takes text it cannot parse, such as ",1", for empty documents.
std::optional<YAML::Mark> second_document(const std::string& text) {
  std::istringstream stream(text);
  YAML::Parser parser(stream);
  Documents documents;
  if (!parser.HandleNextDocument(documents) || !parser.HandleNextDocument(documents)) return std::nullopt;
  const YAML::Mark second = documents.begin;
  if (documents.empty && !parser.HandleNextDocument(documents)) return std::nullopt;
  return second;
}

std::string read_text(const std::filesystem::path& file) {
  if (std::filesystem::is_directory(file)) throw BadInput(file.string(), "is a folder, expected a file");
  errno = 0;
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw BadInput(file.string(), std::string("cannot be read: ") + std::strerror(errno));
  std::string text(bytes_max + 1, '\0');
  stream.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(stream.gcount()));
  if (text.size() > bytes_max) throw BadInput(file.string(), "expected a file of at most 4 MiB");
  return text;
}

}  // namespace

const YamlNode* YamlNode::find(std::string_view key) const {
  for (const YamlEntry& entry : entries) {
    if (entry.key == key) return entry.value.is_null() ? nullptr : &entry.value;
  }
  return nullptr;
}

YamlEntry* YamlNode::entry(std::string_view key) {
  for (YamlEntry& entry : entries) {
    if (entry.key == key) return &entry;
  }
  return nullptr;
}

std::string_view name_of(const YamlNode& node) {
  const YamlNode* name = node.find("name");
  return name != nullptr && name->kind == YamlNode::Kind::scalar ? std::string_view(name->text) : std::string_view();
}

std::uint64_t fingerprint(const YamlNode& node) {
  Digest digest;
  digest.add(static_cast<std::uint64_t>(node.kind));
  digest.add(std::string_view(node.text));
  for (const YamlNode& item : node.items) digest.add(fingerprint(item));
  for (const YamlEntry& entry : node.entries) {
    digest.add(std::string_view(entry.key));
    digest.add(fingerprint(entry.value));
  }
  return digest.value();
}

std::string described(const YamlNode& node) {
  switch (node.kind) {
    case YamlNode::Kind::null: return "nothing";
    case YamlNode::Kind::list: return "a list";
    case YamlNode::Kind::map: return "a map of keys";
    case YamlNode::Kind::scalar: break;
  }
  return "'" + node.text + "'";
}

YamlNode load_yaml(const std::filesystem::path& file) { return parse_yaml(read_text(file), file.string()); }

YamlNode parse_yaml(const std::string& text, const std::string& file, bool file_has_lines) {
  Copier copier(file, file_has_lines, text.size());
  try {
    if (const std::optional<YAML::Mark> second = second_document(text)) {
      throw copier.location(*second).bad("expected one YAML document, found a second");
    }
    return copier.copy(YAML::Load(text), 0);
  } catch (const YAML::Exception& error) {
    throw copier.location(error.mark).bad("this is not valid YAML: " + error.msg);
  }
}

}  // namespace waitpoint::scenario
