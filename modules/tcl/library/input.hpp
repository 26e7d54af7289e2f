// SPDX-License-Identifier: BSD-3-Clause
// The words behind a request, as settings of its input's declared fields: in the order of the fields, or by name.
//
//   pom::SetPos {20 4 1.5708} 0.01            a record: its fields in their order,
//   pom::SetPos {x 20 y 4}                    or a dictionary
//   ndd::GoTo {{3 4} {5 6}}                   a list of records
//   rflex::GotoSpeed w_rad_s=0.2              FIELD=VALUE, also of fields within fields: pose.x=3
#pragma once

#include <tcl.h>

#include <span>
#include <string>
#include <vector>

#include "core/setting.hpp"
#include "modules/tcl/interpreter.hpp"

namespace waitpoint::tcl {

/// Appends the settings of `words`; false with a message in the interpreter's result for words that do not fit.
bool read_input(Tcl_Interp* tcl, const FieldShape& input, std::span<Tcl_Obj* const> words,
                std::vector<Setting>& settings);

}  // namespace waitpoint::tcl
