// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/laas/include/h2errorLib.h"

#include <array>
#include <cstdio>
#include <cstring>
#include <map>
#include <string>

#include "fibers/laas/include/logLib.h"
#include "fibers/laas/pocolibs/library_errors.hpp"
#include "fibers/sync/blocking.hpp"
#include "fibers/sync/robot_state.hpp"

using waitpoint::laas::LibraryErrors;

namespace {

struct Module {
  std::string name;
  std::span<const H2_ERROR> errors;
};

struct Errors : waitpoint::sync::RobotState {
  explicit Errors(waitpoint::kernel::Robot&) {
    for (const LibraryErrors& library : waitpoint::laas::library_errors())
      modules.emplace(library.number, Module{library.name, library.errors});
  }
  std::map<int, Module> modules;  // by their numbers
  std::array<char, 256> latest{};
};

Errors& here() { return waitpoint::sync::state_of<Errors>(*waitpoint::sync::running_task().robot); }

const Module* find(int number) {
  const auto& modules = here().modules;
  const auto found = modules.find(number);
  return found == modules.end() ? nullptr : &found->second;
}

std::string name_of(const Module* module, int number) {
  return module != nullptr ? module->name : std::to_string(number);
}

// The error's name, or `unknown`.
std::string error_of(const Module& module, unsigned short number, const std::string& unknown) {
  for (const H2_ERROR& error : module.errors)
    if (error.num == number) return error.name;
  return unknown;
}

std::string text_of(int code) {
  if (code == 0) return "Unknown error";
  short number = 0, standard_source = 0, standard_number = 0;
  const short source = h2decodeError(code, &number, &standard_source, &standard_number);
  if (source == 0) return std::strerror(code);
  const Module* const module = find(source);
  const std::string text = "S_" + name_of(module, source) + "_";
  if (number >= 0) {
    const std::string plain = std::to_string(number);
    return text + (module != nullptr ? error_of(*module, static_cast<unsigned short>(number), plain) : plain);
  }
  const Module* const standard = find(standard_source);
  const std::string plain = std::to_string(standard_number);
  if (module == nullptr || standard == nullptr) return text + "std" + std::to_string(standard_source) + "_" + plain;
  return text + standard->name + "_" + error_of(*standard, static_cast<unsigned short>(number), plain);
}

void print_head(int number, const Module& module) {
  std::printf("Module id  %5d  M_%-16s  (%2zu errors)\n", number, module.name.c_str(), module.errors.size());
}

}  // namespace

int h2recordErrMsgs(const char* bywho, const char* moduleName, short moduleId, int nbErrors, const H2_ERROR errors[]) {
  const auto [place, added] = here().modules.try_emplace(
      moduleId, Module{moduleName, {errors, static_cast<std::size_t>(nbErrors > 0 ? nbErrors : 0)}});
  const std::string& owner = place->second.name;
  if (!added && owner != moduleName)
    std::printf("h2recordErrMsgs by %s: number %d of %s is taken by %s\n", bywho != nullptr ? bywho : "?", moduleId,
                moduleName, owner.c_str());
  return 1;
}

short h2decodeError(int error, short* num, short* srcStd, short* numStd) {
  *num = static_cast<short>(H2_NUMBER_ERR(error));
  *srcStd = static_cast<short>(*num < 0 ? H2_SOURCE_STD_ERR(*num) : 0);
  *numStd = static_cast<short>(*num < 0 ? H2_NUMBER_STD_ERR(*num) : 0);
  return static_cast<short>(H2_SOURCE_ERR(error));
}

char* h2getErrMsg(int fullError, char* string, int maxLength) {
  if (maxLength > 0) std::snprintf(string, static_cast<std::size_t>(maxLength), "%s", text_of(fullError).c_str());
  return string;
}

char* h2getMsgErrno(int fullError) {
  auto& latest = here().latest;
  return h2getErrMsg(fullError, latest.data(), static_cast<int>(latest.size()));
}

void h2printErrno(int numErr) { logMsg("%s\n", text_of(numErr).c_str()); }

void h2perror(const char* string) {
  const bool has_head = string != nullptr && *string != '\0';
  logMsg("%s%s%s\n", has_head ? string : "", has_head ? ": " : "", text_of(errnoGet()).c_str());
}

void h2listModules() {
  for (const auto& [number, module] : here().modules) print_head(number, module);
}

void h2listErrors() {
  for (const auto& [number, module] : here().modules) {
    print_head(number, module);
    for (const H2_ERROR& error : module.errors) std::printf("    %2d %s\n", error.num, error.name);
  }
}
