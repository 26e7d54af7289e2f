// SPDX-License-Identifier: BSD-3-Clause
#include "tools/view/request.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"

namespace waitpoint::tools::view {
namespace {

constexpr int levels_max = 6;
constexpr std::size_t shown_max = 40;
constexpr std::int64_t century_ns = 3'155'760'000'000'000'000;

[[noreturn]] void refuse(const char* key, const std::string& expected, const Json& found) {
  throw BadInput("the view",
                 "'" + std::string(key) + "': expected " + expected + ", found " + text_of(found).substr(0, shown_max));
}

const Json& member(const Json& request, const char* key, const std::string& expected) {
  const auto found = request.find(key);
  if (found == request.end()) throw BadInput("the view", "'" + std::string(key) + "' is missing: expected " + expected);
  return *found;
}

}  // namespace

// Levels are counted while it is read: the functions that take them apart later are recursive.
Json read_request(std::string_view text) {
  const auto is_shallow = [](int depth, Json::parse_event_t, Json&) {
    if (depth > levels_max) throw BadInput("the view", "expected a request of few levels");
    return true;
  };
  Json request = Json::parse(text, is_shallow);
  if (!request.is_object() || !request.contains("ask") || !request["ask"].is_string())
    throw BadInput("the view", "expected {\"id\", \"ask\", ...}");
  if (request.contains("id") && request["id"].is_structured())
    throw BadInput("the view", "expected a number or a text as the request's id");
  return request;
}

Time time_of(const Json& value, const char* key) {
  if (!value.is_number()) refuse(key, "a time in nanoseconds", value);
  if (value.is_number_unsigned())
    return Time::from_ns(static_cast<std::int64_t>(std::min<std::uint64_t>(value.get<std::uint64_t>(), century_ns)));
  if (value.is_number_integer())
    return Time::from_ns(std::clamp<std::int64_t>(value.get<std::int64_t>(), 0, century_ns));
  return Time::from_ns(std::llround(std::clamp(value.get<double>(), 0.0, static_cast<double>(century_ns))));
}

Time time_in(const Json& request, const char* key) {
  return time_of(member(request, key, "a time in nanoseconds"), key);
}

std::int64_t whole_number_in(const Json& request, const char* key, std::int64_t least, std::int64_t most,
                             std::optional<std::int64_t> otherwise) {
  if (otherwise && (!request.contains(key) || request[key].is_null())) return *otherwise;
  const std::string expected = "a whole number from " + std::to_string(least) + " to " + std::to_string(most);
  const Json& value = member(request, key, expected);
  const bool is_small = value.is_number_unsigned() ? value.get<std::uint64_t>() <= static_cast<std::uint64_t>(INT64_MAX)
                                                   : value.is_number_integer();
  if (!is_small || value.get<std::int64_t>() < least || value.get<std::int64_t>() > most) refuse(key, expected, value);
  return value.get<std::int64_t>();
}

bool flag_in(const Json& request, const char* key, std::optional<bool> otherwise) {
  if (otherwise && !request.contains(key)) return *otherwise;
  const std::string expected = "true or false";
  const Json& value = member(request, key, expected);
  if (!value.is_boolean()) refuse(key, expected, value);
  return value;
}

}  // namespace waitpoint::tools::view
