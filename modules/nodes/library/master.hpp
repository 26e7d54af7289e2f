// SPDX-License-Identifier: BSD-3-Clause
// A ROS 1 master with its parameter server, by XML-RPC: all methods of wiki.ros.org/ROS/Master_API and
// wiki.ros.org/ROS/Parameter Server API. One thread; nodes find it by ROS_MASTER_URI.
#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "modules/nodes/library/calls_to_nodes.hpp"
#include "modules/nodes/library/parameters.hpp"
#include "modules/nodes/library/registrations.hpp"
#include "modules/nodes/library/used_master.hpp"

namespace XmlRpc {
class XmlRpcServer;
}  // namespace XmlRpc

namespace waitpoint::nodes {

class Master final : public UsedMaster {
 public:
  /// Listens at a free port. Throws std::runtime_error if there is none.
  Master();
  ~Master() override;
  Master(const Master&) = delete;
  Master& operator=(const Master&) = delete;

  const std::string& address() const override { return address_; }
  void set_parameter(const std::string& key, const Value& value) override;
  bool is_published(const std::string& topic) const override;
  bool is_served(const std::string& service) const override;
  bool is_node(const std::string& name) const override;
  std::vector<std::string> topics_not_only_of(const std::string& node) const override;

  std::optional<Value> parameter(const std::string& key) const;

 private:
  struct Method;

  void serve();
  void add_methods();
  void add_registration_methods();
  void add_lookup_methods();
  void add_parameter_methods();
  template <class Call>
  void add_method(const char* name, int parameters, Call call);

  mutable std::mutex mutex_;  // of the members below
  Registrations registrations_;
  Parameters parameters_;

  std::unique_ptr<XmlRpc::XmlRpcServer> server_;
  std::vector<std::unique_ptr<Method>> methods_;
  std::string address_;
  std::atomic<bool> is_ending_ = false;
  std::thread thread_;
};

}  // namespace waitpoint::nodes
