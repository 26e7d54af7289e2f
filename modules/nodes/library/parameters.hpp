// SPDX-License-Identifier: BSD-3-Clause
// The parameter server of a ROS master: a tree of values under names such as /move_base/max_vel_x
// (wiki.ros.org/ROS/Parameter Server API).
#pragma once

#include <xmlrpcpp/XmlRpcValue.h>

#include <deque>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace waitpoint::nodes {

using Value = XmlRpc::XmlRpcValue;

/// A subscriber is to learn of a parameter's value.
struct ParameterChange {
  std::string address;  ///< of the subscriber's XML-RPC server
  std::string key;      ///< with a slash at its end
  Value value;          ///< an empty structure: it was deleted
};

class Parameters {
 public:
  Parameters();

  /// Replaces the value. A structure is the tree of its members; the key "/" is the whole tree, which must be one:
  /// false otherwise.
  bool set(const std::string& key, const Value& value);
  std::optional<Value> get(const std::string& key) const;
  /// False if there was none.
  bool erase(const std::string& key);
  /// The full name of a parameter that is looked for in the namespace `from` and those around it: the nearest one with
  /// the first part of `key`.
  std::optional<std::string> search(const std::string& from, const std::string& key) const;
  /// Of the leaves.
  std::vector<std::string> names() const;

  /// The present value, an empty structure if there is none. `address` learns of changes from now on.
  Value subscribe(const std::string& address, const std::string& key);
  bool unsubscribe(const std::string& address, const std::string& key);
  std::optional<ParameterChange> take_change();

 private:
  void tell_of(const std::string& key);

  Value root_;
  std::map<std::string, std::vector<std::string>> subscribers_;  // addresses by key
  std::deque<ParameterChange> changes_;
};

/// An empty structure.
Value empty_structure();

}  // namespace waitpoint::nodes
