// SPDX-License-Identifier: BSD-3-Clause
#include "tools/command/version.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

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

}  // namespace

std::string version_text() {
  return fmt::format("waitpoint {}\ncompiler  {}\nflags     {}\nmath      {:016x}", WAITPOINT_VERSION, compiler,
                     WAITPOINT_FLAGS, exact::fingerprint());
}

std::string version_line() {
  const std::string version = version_text();
  return version.substr(0, version.find('\n'));
}

std::string version_json() {
  const std::string digest = to_string(Digest());
  const nlohmann::ordered_json result = {{"version", WAITPOINT_VERSION},
                                         {"digests", digest.substr(0, digest.find(':'))},
                                         {"compiler", compiler},
                                         {"flags", WAITPOINT_FLAGS},
                                         {"math", fmt::format("{:016x}", exact::fingerprint())}};
  const nlohmann::ordered_json document = {{"format", 1}, {"command", "--version"}, {"status", 0}, {"result", result}};
  return document.dump(2);
}

}  // namespace waitpoint::tools
