// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/surroundings.hpp"

#include <fmt/format.h>
#include <sys/utsname.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <fstream>
#include <memory>

namespace waitpoint::bench {
namespace {

std::string processor() {
  std::ifstream stream("/proc/cpuinfo");
  for (std::string line; std::getline(stream, line);)
    if (line.rfind("model name", 0) == 0) return line.substr(line.find(':') + 2);
  return "processor";
}

std::string output_of(const std::string& command) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> stream(popen(command.c_str(), "r"), &pclose);
  std::string text;
  std::array<char, 256> chunk;
  while (stream != nullptr && std::fgets(chunk.data(), chunk.size(), stream.get()) != nullptr) text += chunk.data();
  return text;
}

}  // namespace

std::string surroundings(const std::vector<std::string>& packages) {
  utsname system{};
  uname(&system);
#ifdef __clang__
  const char* compiler = "clang++";
#else
  const char* compiler = "g++";
#endif
  std::string text = fmt::format("{}, {} cores, {} {}\n{} {}, {}\n", processor(), sysconf(_SC_NPROCESSORS_ONLN),
                                 system.sysname, system.release, compiler, __VERSION__, WAITPOINT_FLAGS);
  std::string names;
  for (const std::string& package : packages) names += " " + package;
  text += output_of("dpkg-query -W -f '${Package} ${Version}\\n'" + names + " 2>/dev/null");
  return text;
}

}  // namespace waitpoint::bench
