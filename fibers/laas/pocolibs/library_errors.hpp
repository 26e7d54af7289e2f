// SPDX-License-Identifier: BSD-3-Clause
// The names of the libraries' own errors, known to every robot from its start.
#pragma once

#include <span>

#include "fibers/laas/include/h2errorLib.h"

namespace waitpoint::laas {

struct LibraryErrors {
  int number;
  const char* name;
  std::span<const H2_ERROR> errors;
};

std::span<const LibraryErrors> library_errors();

}  // namespace waitpoint::laas
