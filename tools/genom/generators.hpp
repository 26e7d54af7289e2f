// SPDX-License-Identifier: BSD-3-Clause
// The files that a description becomes: each function returns the text of one.
//
//   server/MODULEType.h      the C types of the description, and those of its posters
//   server/MODULEError.h     its reports, S_MODULE_NAME
//   server/MODULEHeader.h    for codels: their prototypes, SDI_F, posters
//   server/MODULEMsgLib.h    for clients: functions that send requests and read posters
//   server/MODULEMsgLib.cpp
//   server/MODULEFields.hpp  the values that stand for the C types in the frame, with declared fields
//   server/MODULEModule.hpp  the module's type
//   server/MODULEModule.cpp  the module on the frame of modules/genom
//   server/MODULEMain.cpp    the program
//   codels/*                 a file of codels for the control task, and one for each execution task
//   MODULE.yaml, Makefile, MODULE.md
#pragma once

#include <string>
#include <vector>

#include "modules/description/description.hpp"

namespace waitpoint::tools {

std::string type_header(const description::Description& description);
std::string error_header(const description::Description& description);
std::string codel_header(const description::Description& description);
std::string client_header(const description::Description& description);
std::string client_source(const description::Description& description);
std::string fields_header(const description::Description& description);
std::string module_header(const description::Description& description);
std::string module_source(const description::Description& description);
std::string main_source(const description::Description& description);
std::string control_stubs(const description::Description& description);
std::string task_stubs(const description::Description& description, std::size_t task);
std::string scenario(const description::Description& description);
/// `include_folders` are those of the headers that the description includes.
std::string makefile(const description::Description& description, const std::vector<std::string>& include_folders);
/// A page of Markdown: requests, posters and tasks.
std::string documentation(const description::Description& description);

/// The first line of generated files; `comment` begins it.
std::string generated_line(const description::Description& description, const std::string& comment);

}  // namespace waitpoint::tools
