// SPDX-License-Identifier: BSD-3-Clause
#include "tools/command/version.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <string_view>

#include "core/digest.hpp"
#include "core/exact_math.hpp"

#ifndef WAITPOINT_VERSION
#define WAITPOINT_VERSION "unknown"
#endif
#ifndef WAITPOINT_FLAGS
#define WAITPOINT_FLAGS "unknown"
#endif

namespace waitpoint::tools {
namespace {

#ifdef __clang__
constexpr const char* compiler = __VERSION__;
#else
constexpr const char* compiler = "g++ " __VERSION__;
#endif

/// The build leaves a blank behind them where it has none of its user's.
std::string_view flags() {
  constexpr std::string_view all = WAITPOINT_FLAGS;
  return all.substr(0, all.find_last_not_of(' ') + 1);
}

/// With which texts of digests begin.
std::string format_of_digests() {
  const std::string digest = to_string(Digest());
  return digest.substr(0, digest.find(':'));
}

}  // namespace

std::string version_text() {
  return fmt::format("waitpoint {}\ndigests   {}\ncompiler  {}\nflags     {}\nmath      {:016x}", WAITPOINT_VERSION,
                     format_of_digests(), compiler, flags(), exact::fingerprint());
}

std::string version_line() {
  const std::string version = version_text();
  return version.substr(0, version.find('\n'));
}

std::string version_json() {
  const nlohmann::ordered_json result = {{"version", WAITPOINT_VERSION},
                                         {"digests", format_of_digests()},
                                         {"compiler", compiler},
                                         {"flags", flags()},
                                         {"math", fmt::format("{:016x}", exact::fingerprint())}};
  const nlohmann::ordered_json document = {{"format", 1}, {"command", "--version"}, {"status", 0}, {"result", result}};
  return document.dump(2);
}

}  // namespace waitpoint::tools
