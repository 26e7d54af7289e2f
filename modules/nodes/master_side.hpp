// SPDX-License-Identifier: BSD-3-Clause
// A ROS master, as seen by the starter of its nodes.
#pragma once

#include <string>

namespace waitpoint::nodes {

class MasterSide {
 public:
  virtual ~MasterSide() = default;

  /// "http://127.0.0.1:PORT/".
  virtual std::string master_address() const = 0;
  virtual bool is_published(const std::string& topic) const = 0;
  virtual bool is_served(const std::string& service) const = 0;
  virtual bool is_registered(const std::string& node) const = 0;
};

}  // namespace waitpoint::nodes
