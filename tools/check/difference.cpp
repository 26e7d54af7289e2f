// SPDX-License-Identifier: BSD-3-Clause
#include "tools/check/difference.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace waitpoint::tools {
namespace {

using Json = nlohmann::ordered_json;

std::string what_differs(const LoggedEvent& expected, const LoggedEvent& found) {
  std::string fields;
  const auto note = [&](const char* name, bool differs) {
    if (differs) fields += (fields.empty() ? "" : ", ") + std::string(name);
  };
  note("time", expected.time != found.time);
  note("robot", expected.robot != found.robot);
  note("task", expected.task != found.task);
  note("operation", expected.operation != found.operation);
  note("object", expected.object != found.object);
  // The digest of an event that differs anyway adds nothing.
  return fields.empty() ? "values recorded by the robot since its previous event" : fields;
}

std::string shown(const std::optional<LoggedEvent>& event, const std::string& end) {
  return event ? fmt::format("{}, digest {:016x}", to_string(*event), event->digest) : "no event: " + end;
}

std::string where_it_differs(const Difference& difference) {
  const auto& [number, expected, found, expected_end, found_end, before] = difference;
  if (expected && found) return what_differs(*expected, *found);
  if (expected || found) return "the presence of the event";
  return expected_end == found_end ? "values recorded after the last event" : "the end of the run";
}

Json json_of(const LoggedEvent& event) {
  Json json{{"time_s", event.time.since_start().seconds()},
            {"robot", event.robot},
            {"task", event.task},
            {"operation", event.operation}};
  if (!event.object.empty()) json["object"] = event.object;
  return json;
}

}  // namespace

std::string to_string(const LoggedEvent& event) {
  std::string text =
      to_string(event.time) + " s, robot " + event.robot + ", task " + event.task + ": " + event.operation;
  if (!event.object.empty()) text += " " + event.object;
  return text;
}

std::string to_text(const Difference& difference) {
  std::string text;
  const auto line = [&](const char* name, const std::string& value) {
    text += fmt::format("  {:<18}{}\n", name, value);
  };
  const auto& [number, expected, found, expected_end, found_end, before] = difference;
  line("event", std::to_string(number));
  line("was", shown(expected, expected_end));
  line("is", shown(found, found_end));
  line("differs in", where_it_differs(difference));
  line("previous event", before ? to_string(*before) : "none");
  return text;
}

std::string to_json(const Difference& difference) {
  const auto& [number, expected, found, expected_end, found_end, before] = difference;
  Json json{{"event", number}, {"differs_in", where_it_differs(difference)}};
  json[expected ? "was" : "was_end"] = expected ? json_of(*expected) : Json(expected_end);
  json[found ? "is" : "is_end"] = found ? json_of(*found) : Json(found_end);
  if (before) json["previous"] = json_of(*before);
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace waitpoint::tools
