// SPDX-License-Identifier: BSD-3-Clause
// The master's calls to the XML-RPC servers of nodes. None waits for another node: they go out from the master's own
// loop, one at a time to each node, so that a node gets them in the order in which they arose.
#pragma once

#include <xmlrpcpp/XmlRpcClient.h>
#include <xmlrpcpp/XmlRpcDispatch.h>
#include <xmlrpcpp/XmlRpcValue.h>

#include <deque>
#include <list>
#include <memory>
#include <string>

namespace waitpoint::nodes {

class CallsToNodes {
 public:
  /// `loop` must outlive this.
  explicit CallsToNodes(XmlRpc::XmlRpcDispatch& loop) : loop_(loop) {}
  ~CallsToNodes();
  CallsToNodes(const CallsToNodes&) = delete;
  CallsToNodes& operator=(const CallsToNodes&) = delete;

  /// `address`: "http://HOST:PORT/".
  void add(const std::string& address, const std::string& method, const XmlRpc::XmlRpcValue& parameters);
  /// After each round of the loop: forgets those that are done, and begins the next. A node that does not answer for
  /// ten seconds, or cannot be reached, misses the call.
  void go_on();
  bool are_done() const { return nodes_.empty(); }

 private:
  struct Call {
    std::string method;
    XmlRpc::XmlRpcValue parameters;
  };
  struct Node {
    std::string address;
    std::deque<Call> calls = {};
    std::unique_ptr<XmlRpc::XmlRpcClient> client = nullptr;  // null: none is under way
    double until_s = 0;
  };

  bool begin(Node& node);
  bool is_over(Node& node);

  XmlRpc::XmlRpcDispatch& loop_;
  std::list<Node> nodes_;  // with calls; in the order in which they got one, since ports differ from run to run
};

}  // namespace waitpoint::nodes
