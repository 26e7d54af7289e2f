// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/descriptors/owners.hpp"

#include "core/error.hpp"
#include "fibers/posix/program/program.hpp"

namespace waitpoint::posix {
namespace {

const Program* owners[known_descriptors_max];
int owned_end = 0;  // one past the greatest ever owned

bool is_in_range(int descriptor) { return descriptor >= 0 && descriptor < known_descriptors_max; }

}  // namespace

void note_owner(int descriptor) {
  if (!is_in_range(descriptor) || !is_simulated() || !this_program().is_loaded) return;
  owners[descriptor] = &this_program();
  if (descriptor >= owned_end) owned_end = descriptor + 1;
}

void clear_owner(int descriptor) {
  if (is_in_range(descriptor)) owners[descriptor] = nullptr;
}

int next_owned(int from, const Program*& owner) {
  WAITPOINT_CHECK(from >= 0 && owned_end <= known_descriptors_max, "the table of owners is read outside its range");
  for (int descriptor = from; descriptor < owned_end; ++descriptor)
    if ((owner = owners[descriptor]) != nullptr) return descriptor;
  return -1;
}

}  // namespace waitpoint::posix
