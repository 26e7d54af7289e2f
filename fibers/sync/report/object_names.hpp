// SPDX-License-Identifier: BSD-3-Clause
// Names of tasks and objects, as reports show them.
#pragma once

#include <string>

#include "fibers/kernel/task.hpp"

namespace waitpoint::sync {

/// "NAME of ROBOT".
std::string describe(const kernel::Task& task);

/// "mutex #3 "label"", of memory "memory #3 "queue+40"", by the variables in it.
std::string describe(const kernel::Object& object);

/// The name of the variable at an address of this process, or null; nothing is freed.
using VariableName = const char* (*)(const void* address);
/// From now on memory in this process is described by these names.
void name_variables_by(VariableName name);

/// "held by anna of r1", or "shared by" the first few and the number of the others; empty if it is not held.
std::string describe_holders(const kernel::Object& object);

}  // namespace waitpoint::sync
