// SPDX-License-Identifier: BSD-3-Clause
// The registrations at a ROS master: publishers, subscribers and servers by name. Values only: calls come in and
// notifications go out through master.hpp.
//
// The rules are those of the ROS Master API (wiki.ros.org/ROS/Master_API): a node is known by its name and the address
// of its XML-RPC server; one that registers with a new address takes the name's place, and the old one is to shut down.
#pragma once

#include <deque>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace waitpoint::nodes {

/// A node is to be called by the master.
struct Notification {
  enum class Kind { publishers, shutdown };
  Kind kind;
  std::string address;                  ///< of the node's XML-RPC server
  std::string topic;                    ///< of publishers; of a shutdown: the reason
  std::vector<std::string> publishers;  ///< their addresses
};

class Registrations {
 public:
  struct Names {
    std::string name;
    std::vector<std::string> nodes;
  };

  /// Addresses of the topic's subscribers.
  std::vector<std::string> publish(const std::string& node, const std::string& topic, const std::string& type,
                                   const std::string& address);
  /// Addresses of the topic's publishers. The type `*` says nothing of it.
  std::vector<std::string> subscribe(const std::string& node, const std::string& topic, const std::string& type,
                                     const std::string& address);
  /// Of another node's registrations nothing changes: false.
  bool stop_publishing(const std::string& node, const std::string& topic, const std::string& address);
  bool stop_subscribing(const std::string& node, const std::string& topic, const std::string& address);
  void serve(const std::string& node, const std::string& service, const std::string& service_address,
             const std::string& address);
  bool stop_serving(const std::string& node, const std::string& service, const std::string& service_address);

  std::optional<std::string> node_address(const std::string& node) const;
  std::optional<std::string> service_address(const std::string& service) const;
  bool is_published(const std::string& topic) const { return !addresses_of(topic, publishers_).empty(); }

  /// Topics with publishers below `within` ("/": all), with their types.
  std::vector<std::pair<std::string, std::string>> published(const std::string& within) const;
  std::vector<std::pair<std::string, std::string>> types() const;
  std::vector<Names> publishers() const { return names(publishers_); }
  std::vector<Names> subscribers() const { return names(subscribers_); }
  std::vector<Names> services() const;

  /// In the order in which they arose.
  std::optional<Notification> take_notification();

 private:
  struct Node {
    std::string address;
    int registrations = 0;
  };
  using Users = std::vector<std::string>;  // nodes, in the order of their registration
  using Table = std::map<std::string, Users>;
  struct Service {
    std::string node, address;
  };

  void know(const std::string& node, const std::string& address);
  void count_down(const std::string& node);
  void forget(const std::string& node);
  void add(Table& table, const std::string& key, const std::string& node);
  bool remove(Table& table, const std::string& key, const std::string& node, const std::string& address);
  bool remove_name(Table& table, const std::string& key, const std::string& node);
  std::vector<std::string> addresses_of(const std::string& key, const Table& table) const;
  void tell_of_publishers(const std::string& topic);
  static std::vector<Names> names(const Table& table);

  std::map<std::string, Node> nodes_;
  Table publishers_, subscribers_;
  std::map<std::string, std::string> types_;
  std::map<std::string, Service> services_;
  std::deque<Notification> notifications_;
};

}  // namespace waitpoint::nodes
