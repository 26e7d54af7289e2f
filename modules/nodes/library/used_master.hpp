// SPDX-License-Identifier: BSD-3-Clause
// The master of a run, as its own side uses it: one inside, or Debian's in a process of its own. From any thread.
#pragma once

#include <xmlrpcpp/XmlRpcValue.h>

#include <string>
#include <vector>

namespace waitpoint::nodes {

class UsedMaster {
 public:
  virtual ~UsedMaster() = default;

  /// "http://127.0.0.1:PORT/".
  virtual const std::string& address() const = 0;
  virtual void set_parameter(const std::string& key, const XmlRpc::XmlRpcValue& value) = 0;
  virtual bool is_published(const std::string& topic) const = 0;
  virtual bool is_served(const std::string& service) const = 0;
  virtual bool is_node(const std::string& name) const = 0;
  /// By name: topics that another node publishes, too.
  virtual std::vector<std::string> topics_not_only_of(const std::string& node) const = 0;
};

}  // namespace waitpoint::nodes
