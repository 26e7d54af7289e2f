// SPDX-License-Identifier: BSD-3-Clause
#include <dlfcn.h>

#include <map>
#include <string>

#include "fibers/laas/include/symLib.h"
#include "fibers/laas/portLib.hpp"
#include "fibers/sync/blocking.hpp"
#include "fibers/sync/robot_state.hpp"

namespace laas = waitpoint::laas;

namespace {

struct Symbol {
  char* value;
  SYM_TYPE type;
};

struct Symbols : waitpoint::sync::RobotState {
  explicit Symbols(waitpoint::kernel::Robot&) {}
  std::map<std::string, Symbol> by_name;
};

Symbols& here() { return waitpoint::sync::state_of<Symbols>(*waitpoint::sync::running_task().robot); }

}  // namespace

STATUS symLibInit() { return OK; }

STATUS symAdd(SYMTAB_ID, char* name, char* value, SYM_TYPE type, unsigned short) {
  here().by_name[name] = {value, type};
  return OK;
}

STATUS symFindByName(SYMTAB_ID symTblId, char* name, char** pValue, SYM_TYPE* pType) {
  const auto& added = here().by_name;
  if (const auto found = added.find(name); found != added.end()) {
    *pValue = found->second.value;
    *pType = found->second.type;
    return OK;
  }
  void* const exported = dlsym(symTblId, name);  // a null table is RTLD_DEFAULT
  if (exported == nullptr) return laas::fail(S_symLib_SYMBOL_NOT_FOUND);
  *pValue = static_cast<char*>(exported);
  *pType = SYM_GLOBAL;
  return OK;
}

STATUS symFindByValue(SYMTAB_ID, char*, char*, int*, SYM_TYPE*) { return laas::fail(S_symLib_NOT_IMPLEMENTED); }
