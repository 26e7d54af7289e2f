// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/sync/source_lines.hpp"

#include <cxxabi.h>
#include <dlfcn.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <memory>

namespace waitpoint::sync {
namespace {

bool contains(const std::string& text, const char* part) { return text.find(part) != std::string::npos; }

// Frames that implement the primitives say nothing about the user's program.
bool is_ours(const std::string& line) {
  if (contains(line, "tests/fibers/")) return false;
  for (const char* part :
       {"fibers/kernel/", "fibers/sync/", "waitpoint::kernel::", "waitpoint::sync::", "/include/c++/"})
    if (contains(line, part)) return true;
  return false;
}

bool is_entry(const std::string& line) {
  return contains(line, "waitpoint::sync::(anonymous namespace)::run_thread") ||
         contains(line, "waitpoint::kernel::Scheduler::task_main");
}

std::string name_from_symbols(const Dl_info& info, std::uintptr_t offset) {
  if (info.dli_sname != nullptr) {
    int status = 0;
    const std::unique_ptr<char, void (*)(void*)> demangled(
        abi::__cxa_demangle(info.dli_sname, nullptr, nullptr, &status), std::free);
    return status == 0 ? demangled.get() : info.dli_sname;
  }
  char text[64];
  std::snprintf(text, sizeof text, "+0x%zx", static_cast<std::size_t>(offset));
  return std::string(info.dli_fname != nullptr ? info.dli_fname : "?") + text;
}

// The inlined functions at one address, innermost first, as "function at file:line".
std::vector<std::string> lines_of(void* return_address) {
  Dl_info info{};
  // The call is before the address it returns to.
  void* call = static_cast<char*>(return_address) - 1;
  if (dladdr(call, &info) == 0) return {"?"};
  const std::uintptr_t offset =
      reinterpret_cast<std::uintptr_t>(call) - reinterpret_cast<std::uintptr_t>(info.dli_fbase);
  const std::string module = info.dli_fname;
  std::vector<std::string> lines;
  if (!contains(module, "'")) {
    char command[4200];
    std::snprintf(command, sizeof command, "addr2line -Cfip -e '%s' 0x%zx 2>/dev/null", module.c_str(),
                  static_cast<std::size_t>(offset));
    if (FILE* pipe = popen(command, "r")) {
      char text[2048];
      while (std::fgets(text, sizeof text, pipe) != nullptr) {
        std::string line = text;
        while (!line.empty() && line.back() == '\n') line.pop_back();
        constexpr const char* inlined = " (inlined by) ";
        if (line.starts_with(inlined)) line = line.substr(std::char_traits<char>::length(inlined));
        if (!contains(line, "??")) lines.push_back(line);
      }
      pclose(pipe);
    }
  }
  if (lines.empty()) lines.push_back(name_from_symbols(info, offset));
  return lines;
}

}  // namespace

std::vector<std::string> user_source_lines(std::span<void* const> return_addresses, std::size_t most) {
  std::vector<std::string> found;
  for (void* address : return_addresses) {
    for (const std::string& line : lines_of(address)) {
      if (is_entry(line)) return found;
      if (is_ours(line)) continue;
      found.push_back(line);
      if (found.size() == most) return found;
    }
  }
  return found;
}

}  // namespace waitpoint::sync
