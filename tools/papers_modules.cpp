// SPDX-License-Identifier: BSD-3-Clause
#include "tools/papers_modules.hpp"

#ifndef WAITPOINT_REAL_THREADS
#include "modules/meeting/meeting.hpp"
#endif
#include "modules/locate/locate.hpp"
#include "modules/ndd/ndd.hpp"
#include "modules/pom/pom.hpp"
#include "modules/rflex/rflex.hpp"
#include "modules/segloc/segloc.hpp"
#include "modules/sick/sick.hpp"
#include "modules/wander/wander.hpp"

namespace waitpoint::tools {

std::vector<genom::ModuleType> papers_modules() {
  return {genom::module_type<ndd::Ndd>("ndd"), genom::module_type<pom::Pom>("pom"),
          genom::module_type<rflex::Rflex>("rflex"), genom::module_type<segloc::Segloc>("segloc"),
          genom::module_type<sick::Sick>("sick")};
}

std::vector<genom::ModuleType> shipped_modules() {
  std::vector<genom::ModuleType> types = papers_modules();
  types.push_back(genom::module_type<locate::Locate>("locate"));
  types.push_back(genom::module_type<wander::Wander>("wander"));
#ifndef WAITPOINT_REAL_THREADS
  types.push_back(genom::module_type<meeting::MeetingModule>("meeting"));
#endif
  return types;
}

}  // namespace waitpoint::tools
