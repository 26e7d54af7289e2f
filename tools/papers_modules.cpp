// SPDX-License-Identifier: BSD-3-Clause
#include "tools/papers_modules.hpp"

#include "modules/ndd/ndd.hpp"
#include "modules/pom/pom.hpp"
#include "modules/rflex/rflex.hpp"
#include "modules/segloc/segloc.hpp"
#include "modules/sick/sick.hpp"

namespace waitpoint::tools {

std::vector<genom::ModuleType> papers_modules() {
  return {genom::module_type<ndd::Ndd>("ndd"), genom::module_type<pom::Pom>("pom"),
          genom::module_type<rflex::Rflex>("rflex"), genom::module_type<segloc::Segloc>("segloc"),
          genom::module_type<sick::Sick>("sick")};
}

}  // namespace waitpoint::tools
