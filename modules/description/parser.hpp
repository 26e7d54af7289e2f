// SPDX-License-Identifier: BSD-3-Clause
// Reads GenoM 2's descriptions of modules, by recursive descent:
//
//   file        : { module | import | request | poster | exec_task | C declaration }
//   module      : 'module' NAME '{' { attribute ';' } '}' ';'
//   import      : 'import' 'from' NAME '{' { C declaration } '}' ';'
//   request     : 'request' NAME '{' { attribute ';' } '}' ';'       and so for poster and exec_task
//   attribute   : KEYWORD ':' value { ',' value }
//   parameter   : NAME '::' MEMBER { '.' MEMBER }
//
// GenoM's earlier keywords mean the same: c_exec_func is codel_main, incompatible_with interrupt_activity, fail_msg
// fail_reports, and so on.
#pragma once

#include "modules/description/description.hpp"
#include "modules/description/preprocessor.hpp"

namespace waitpoint::description {

/// The contents of a file, before names are resolved.
Description parse(const SourceFile& source, const std::vector<std::string>& include_folders, const ReadFile& read_file);

/// Resolves names and checks the constraints between the parts; BadInput at the first that does not.
void resolve(Description& description);

/// Both. BadInput "file:line: column N: expected ..., found ..." at the first mistake.
Description parse_description(const SourceFile& source, const std::vector<std::string>& include_folders,
                              const ReadFile& read_file);

/// The same of a file; included files are searched in its folder and in `include_folders`.
Description read_description(const std::string& path, const std::vector<std::string>& include_folders = {});

}  // namespace waitpoint::description
