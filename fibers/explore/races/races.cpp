// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/explore/races/races.hpp"

#include <cxxabi.h>
#include <dlfcn.h>
#include <link.h>

#include <cstdlib>
#include <memory>
#include <ostream>

#include "fibers/explore/races/runtime.hpp"
#include "fibers/sync/source_lines.hpp"

namespace waitpoint::races {
namespace {

const Runtime* runtime() { return &waitpoint_races_runtime == nullptr ? nullptr : waitpoint_races_runtime(); }

std::string demangled(const char* symbol) {
  int status = 0;
  const std::unique_ptr<char, void (*)(void*)> name(abi::__cxa_demangle(symbol, nullptr, nullptr, &status), std::free);
  return status == 0 ? name.get() : symbol;
}

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
  return demangled(info.dli_sname) + (offset == 0 ? "" : " + " + std::to_string(offset));
}

Access access_of(const Side& side, std::vector<std::string> calls) {
  std::optional<std::uint32_t> number;
  if (side.record != 0) number = side.record - 1;
  return {side.task,        number,          side.access.event, side.access.writes(), side.access.is_atomic(),
          side.access.size, std::move(calls)};
}

void write(std::ostream& out, const char* which, const Access& access) {
  out << "  " << which << ": " << (access.atomic ? "atomic " : "") << (access.writes ? "write" : "read") << " of "
      << access.size
      << (access.size == 63  ? " bytes or more"
          : access.size == 1 ? " byte"
                             : " bytes")
      << " by task " << access.task;
  if (access.number) out << "#" << *access.number;
  out << ", after its event " << access.event << "\n";
  for (const std::string& call : access.calls) out << "    " << call << "\n";
}

constexpr std::size_t calls_written = 8;

}  // namespace

bool present() { return runtime() != nullptr; }

void begin_run() {
  if (present()) runtime()->begin_run();
}

bool any_found() {
  const FoundRace* races = nullptr;
  return present() && runtime()->found(races) != 0;
}

std::vector<Race> found() {
  if (!present()) return {};
  const FoundRace* races = nullptr;
  const std::size_t count = runtime()->found(races);
  std::vector<sync::ReturnAddresses> stacks;
  for (std::size_t i = 0; i < count; ++i)
    for (const Side* side : {&races[i].first, &races[i].second})
      stacks.emplace_back(side->calls, side->calls + side->call_count);
  std::vector<std::vector<std::string>> calls = sync::user_source_lines(stacks, calls_written);
  std::vector<Race> found;
  for (std::size_t i = 0; i < count; ++i)
    found.push_back({access_of(races[i].first, std::move(calls[2 * i])),
                     access_of(races[i].second, std::move(calls[2 * i + 1])),
                     reinterpret_cast<const void*>(races[i].address), where(races[i])});
  return found;
}

void learn(bool on) {
  if (present()) runtime()->learn(on);
}

void forget_learned() {
  if (present()) runtime()->forget_learned();
}

std::ostream& operator<<(std::ostream& out, const Race& race) {
  out << "data race at " << race.address;
  if (!race.memory.empty()) out << " (" << race.memory << ")";
  out << "\n";
  write(out, "first", race.first);
  write(out, "second", race.second);
  return out;
}

}  // namespace waitpoint::races
