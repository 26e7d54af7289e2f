// SPDX-License-Identifier: BSD-3-Clause
#include "modules/genom/name_space.hpp"

#include "core/error.hpp"

namespace waitpoint::genom {

PosterBase* NameSpace::find_poster(const std::string& name) const {
  const auto found = posters_.find(name);
  return found != posters_.end() ? found->second.get() : nullptr;
}

Module* NameSpace::find_module(const std::string& name) const {
  const auto found = modules_.find(name);
  return found != modules_.end() ? found->second : nullptr;
}

threads::processor& NameSpace::add_processor(const std::string& name) {
  const auto [at, added] = processors_.try_emplace(name);
  WAITPOINT_CHECK(added, "a robot has two processors of one name");
  at->second = std::make_unique<threads::processor>(at->first.c_str());
  return *at->second;
}

threads::processor* NameSpace::find_processor(const std::string& name) const {
  const auto found = processors_.find(name);
  return found != processors_.end() ? found->second.get() : nullptr;
}

void NameSpace::add(std::unique_ptr<PosterBase> poster) {
  const std::string name = poster->name();
  const auto [place, added] = posters_.emplace(name, std::move(poster));
  if (!added) throw BadInput("poster '" + name + "'", "written by '" + place->second->writer() + "' and by another");
}

void NameSpace::add(const std::string& name, Module& module) {
  if (!modules_.emplace(name, &module).second)
    throw BadInput("module '" + name + "'", "there is another of that name on this robot");
}

}  // namespace waitpoint::genom
