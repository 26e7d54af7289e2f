// SPDX-License-Identifier: BSD-3-Clause
#include "modules/nodes/library/made_master.hpp"

#include "modules/nodes/library/debian_master.hpp"
#include "modules/nodes/library/master.hpp"

namespace waitpoint::nodes {

std::unique_ptr<UsedMaster> make_master(bool is_of_debian) {
  if (is_of_debian) return std::make_unique<DebianMaster>();
  return std::make_unique<Master>();
}

}  // namespace waitpoint::nodes
