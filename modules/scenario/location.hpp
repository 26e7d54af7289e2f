// SPDX-License-Identifier: BSD-3-Clause
// The place of a value in a scenario's files or options.
#pragma once

#include "core/location.hpp"

namespace waitpoint::scenario {

using waitpoint::FileName;
using waitpoint::Location;

}  // namespace waitpoint::scenario
