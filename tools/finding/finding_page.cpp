// SPDX-License-Identifier: BSD-3-Clause
#include "tools/finding/finding_page.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "core/file_contents.hpp"
#include "tools/view/compressed_text.hpp"
#include "tools/view/page.hpp"

namespace waitpoint::tools {
namespace {

using Json = nlohmann::json;

constexpr int known_format = 1;

bool is_schedule(const Json& schedule) {
  const auto events = schedule.find("events");
  return events != schedule.end() && events->is_object() && events->contains("t");
}

}  // namespace

std::string read_finding(const std::filesystem::path& file) {
  constexpr std::size_t bytes_max = std::size_t{1} << 30;
  const std::string expected = "expected a finding, as explore --finding writes it";
  std::string text = given_file_contents(file, bytes_max);
  if (text.empty()) throw BadInput(file.string(), expected + ", found nothing");
  const Json json = Json::parse(text, nullptr, false);
  if (json.is_discarded()) throw BadInput(file.string(), expected + ", found no whole JSON");
  if (!json.is_object() || !json.contains("finding") || !json["finding"].is_object() || !json.contains("header"))
    throw BadInput(file.string(), expected + ", found other JSON");
  if (const Json number = json["finding"].value("format", Json()); number != known_format)
    throw BadInput(file.string(), "expected a finding of format 1, found " + number.dump());
  const Json robots = json["header"].is_object() ? json["header"].value("robots", Json()) : Json();
  if (!robots.is_array()) throw BadInput(file.string(), expected + ", found no robots or processes in its header");
  for (const char* const list : {"marks", "frames"})
    if (json.contains(list) && !json[list].is_array() && !json[list].is_null())
      throw BadInput(file.string(), expected + ", found '" + list + "' that is no list");
  const Json others = json.value("others", Json::array());
  if (!is_schedule(json) || !others.is_array() || !std::ranges::all_of(others, is_schedule))
    throw BadInput(file.string(), expected + ", found one without events");
  return text;
}

std::string page_of_finding(std::string_view finding) {
  view::CompressedText compressed;
  compressed.append(finding);
  return view::page_of(view::base64(compressed.finish()));
}

}  // namespace waitpoint::tools
