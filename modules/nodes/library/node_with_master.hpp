// SPDX-License-Identifier: BSD-3-Clause
// The common part of both sides of nodes, that of a world and that of a bag: the master, its parameters, and a node of
// the run.
#pragma once

#include <ros/ros.h>

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "modules/nodes/library/made_master.hpp"
#include "modules/nodes/library/own_node.hpp"

namespace waitpoint::nodes {

/// `Side` is a MasterSide. A derived class ends its topics before close_node(), in its destructor.
template <class Side>
class NodeWithMaster : public Side {
 public:
  std::string master_address() const override { return master_->address(); }
  bool is_published(const std::string& topic) const override { return master_->is_published(topic); }
  bool is_served(const std::string& service) const override { return master_->is_served(service); }
  bool is_registered(const std::string& node) const override { return master_->is_node(node); }

 protected:
  void open_node(bool has_debian_master, bool has_clock,
                 const std::vector<std::pair<std::string, nlohmann::json>>& parameters) {
    master_ = make_master(has_debian_master);
    set_parameters(*master_, has_clock, parameters);
    start_own_node(*master_);
    node_.emplace();
  }
  void close_node() {
    node_.reset();
    ros::shutdown();
  }

  std::unique_ptr<UsedMaster> master_;
  std::optional<ros::NodeHandle> node_;
};

}  // namespace waitpoint::nodes
