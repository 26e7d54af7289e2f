// SPDX-License-Identifier: BSD-3-Clause
// Debian's `rosmaster` as a process of the run.
#pragma once

#include <sys/types.h>

#include "modules/nodes/library/used_master.hpp"

namespace waitpoint::nodes {

class DebianMaster final : public UsedMaster {
 public:
  /// Returns when it answers. Throws std::runtime_error if it does not within ten seconds, or is not installed.
  DebianMaster();
  ~DebianMaster() override { end(); }
  DebianMaster(const DebianMaster&) = delete;
  DebianMaster& operator=(const DebianMaster&) = delete;

  const std::string& address() const override { return address_; }
  void set_parameter(const std::string& key, const XmlRpc::XmlRpcValue& value) override;
  bool is_published(const std::string& topic) const override;
  bool is_served(const std::string& service) const override;
  bool is_node(const std::string& name) const override;
  std::vector<std::string> topics_not_only_of(const std::string& node) const override;

 private:
  bool call(const char* method, const XmlRpc::XmlRpcValue& parameters, XmlRpc::XmlRpcValue& value) const;
  void end();

  int port_ = 0;
  std::string address_;
  pid_t process_ = 0;
};

}  // namespace waitpoint::nodes
