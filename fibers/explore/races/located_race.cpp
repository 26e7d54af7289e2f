// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/explore/races/located_race.hpp"

#include <dlfcn.h>
#include <link.h>

namespace waitpoint::races {
namespace {

std::string where(const FoundRace& race) {
  if (race.stack_of[0] != '\0') return std::string("the stack of task ") + race.stack_of;
  Dl_info info{};
  const ElfW(Sym)* symbol = nullptr;
  if (dladdr1(reinterpret_cast<void*>(race.address), &info, const_cast<void**>(reinterpret_cast<const void**>(&symbol)),
              RTLD_DL_SYMENT) == 0)
    return "";
  if (info.dli_sname == nullptr || symbol == nullptr) return std::string("data of ") + info.dli_fname;
  const std::uint64_t offset = race.address - reinterpret_cast<std::uint64_t>(info.dli_saddr);
  if (offset >= symbol->st_size) return std::string("data of ") + info.dli_fname;
  return sync::demangled(info.dli_sname) + (offset == 0 ? "" : " + " + std::to_string(offset));
}

sync::CodePlaces places_of(const Side& side) {
  sync::CodePlaces places;
  for (std::size_t i = 0; i < side.call_count; ++i) places.push_back(sync::code_place_of(side.calls[i]));
  return places;
}

}  // namespace

LocatedRace located(const FoundRace& race) {
  return {race, where(race), places_of(race.first), places_of(race.second)};
}

}  // namespace waitpoint::races
