// SPDX-License-Identifier: BSD-3-Clause
// load_yaml() and parse_yaml() of yaml_tree.hpp, by yaml-cpp's parser.
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/parser.h>

#include <optional>
#include <sstream>

#include "core/confinement.hpp"
#include "core/file_contents.hpp"
#include "modules/scenario/yaml_builder.hpp"

namespace waitpoint::scenario {
namespace {

constexpr std::size_t bytes_max = std::size_t{64} << 20;

/// The start of a second document, if any, after the first one that `parser` has handled. Not by YAML::LoadAll, which
/// loops forever where its parser makes no progress: it takes text it cannot parse, such as ",1", for empty documents.
std::optional<YAML::Mark> second_document(YAML::Parser& parser) {
  FurtherDocument further;
  if (!parser.HandleNextDocument(further)) return std::nullopt;
  const YAML::Mark second = further.begin;
  if (further.empty && !parser.HandleNextDocument(further)) return std::nullopt;
  return second;
}

}  // namespace

YamlNode load_yaml(const std::filesystem::path& file) {
  Confinement::require_allowed(file);
  return parse_yaml(given_file_contents(file, bytes_max), file.string());
}

YamlNode parse_yaml(const std::string& text, const std::string& file, bool file_has_lines) {
  YamlBuilder builder(file, file_has_lines, text.size());
  try {
    std::istringstream stream(text);
    YAML::Parser parser(stream);
    if (parser.HandleNextDocument(builder)) {
      if (const std::optional<YAML::Mark> second = second_document(parser))
        throw builder.location(*second).bad("expected one YAML document, found a second");
    }
  } catch (const YAML::Exception& error) {
    throw builder.location(error.mark).bad("this is not valid YAML: " + error.msg);
  }
  return builder.take();
}

}  // namespace waitpoint::scenario
