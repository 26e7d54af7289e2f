// SPDX-License-Identifier: BSD-3-Clause
#include "modules/genom/c_module.hpp"

#include <algorithm>

namespace waitpoint::genom {
namespace {

// Of the calling task, which executes one codel at a time.
struct Codel {
  CModule* module = nullptr;
  int activity = -1;
};
threads::fiber_local<Codel> running_codel;

}  // namespace

static_assert(static_cast<int>(State::ether) == ETHER && static_cast<int>(State::init) == INIT &&
              static_cast<int>(State::start) == START && static_cast<int>(State::exec) == EXEC &&
              static_cast<int>(State::end) == END && static_cast<int>(State::fail) == FAIL &&
              static_cast<int>(State::inter) == INTER && static_cast<int>(State::zombie) == ZOMBIE &&
              static_cast<int>(State::sleep) == SLEEP && activities_max == MAX_ACTIVITIES);

CModule& CModule::running() {
  CModule* module = running_codel->module;
  WAITPOINT_REQUIRE(module != nullptr, "a function for codels is called outside of a codel");
  return *module;
}

CModule::Running::Running(CModule& module, int activity) { *running_codel = {&module, activity}; }

CModule::Running::~Running() { *running_codel = {}; }

int CModule::activity() { return running_codel->activity; }

double CModule::period_s(int task) const {
  if (task < 0 || static_cast<std::size_t>(task) >= tasks().size()) return 0;
  return static_cast<double>(tasks()[static_cast<std::size_t>(task)].options().period_ms.ns()) * 1e-9;
}

CClient* CModule::client(const std::string& name) {
  const auto found = std::find_if(clients_.begin(), clients_.end(), [&](auto& client) { return client.first == name; });
  if (found != clients_.end()) return found->second.get();
  auto made = std::make_unique<CClient>(names_, this->name() + "." + name, name);
  if (!made->exists()) return nullptr;
  return clients_.emplace_back(name, std::move(made)).second.get();
}

PosterBase* CModule::find_poster(const std::string& name) const {
  if (PosterBase* found = names_.find_poster(name)) return found;
  for (const auto& [full, poster] : names_.posters()) {
    std::string joined = full;
    joined.erase(std::remove(joined.begin(), joined.end(), '.'), joined.end());
    if (joined == name) return poster.get();
  }
  return nullptr;
}

}  // namespace waitpoint::genom
