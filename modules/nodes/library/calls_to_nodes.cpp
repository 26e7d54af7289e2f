// SPDX-License-Identifier: BSD-3-Clause
#include "modules/nodes/library/calls_to_nodes.hpp"

#include <algorithm>

#include "core/number_text.hpp"

namespace waitpoint::nodes {
namespace {

constexpr double patience_s = 10;

struct Server {
  std::string host;
  int port = 0;
};

Server server_of(const std::string& address) {
  constexpr std::string_view scheme = "http://";
  Server server;
  if (!address.starts_with(scheme)) return server;
  const std::string rest = address.substr(scheme.size());
  const std::size_t colon = rest.find(':'), slash = rest.find('/');
  if (colon == std::string::npos || (slash != std::string::npos && slash < colon)) return server;
  server.host = rest.substr(0, colon);
  if (!parse_number(rest.substr(colon + 1, slash == std::string::npos ? slash : slash - colon - 1), server.port))
    server.port = 0;
  return server;
}

}  // namespace

CallsToNodes::~CallsToNodes() {
  for (Node& node : nodes_)
    if (node.client != nullptr) loop_.removeSource(node.client.get());
}

void CallsToNodes::add(const std::string& address, const std::string& method, const XmlRpc::XmlRpcValue& parameters) {
  auto node = std::find_if(nodes_.begin(), nodes_.end(), [&](const Node& each) { return each.address == address; });
  if (node == nodes_.end()) node = nodes_.insert(node, Node{.address = address});
  node->calls.push_back({method, parameters});
}

void CallsToNodes::go_on() {
  for (auto at = nodes_.begin(); at != nodes_.end();) {
    Node& node = *at;
    if (node.client != nullptr && is_over(node)) {
      loop_.removeSource(node.client.get());
      node.client.reset();
    }
    while (node.client == nullptr && !node.calls.empty() && !begin(node)) {
    }
    at = node.client == nullptr ? nodes_.erase(at) : std::next(at);
  }
}

bool CallsToNodes::begin(Node& node) {
  const Call call = std::move(node.calls.front());
  node.calls.pop_front();
  const Server server = server_of(node.address);
  if (server.port <= 0) return false;
  auto client = std::make_unique<XmlRpc::XmlRpcClient>(server.host.c_str(), server.port, "/");
  if (!client->executeNonBlock(call.method.c_str(), call.parameters)) return false;
  loop_.addSource(client.get(), XmlRpc::XmlRpcDispatch::WritableEvent | XmlRpc::XmlRpcDispatch::Exception);
  node.client = std::move(client);
  node.until_s = loop_.getTime() + patience_s;
  return true;
}

bool CallsToNodes::is_over(Node& node) {
  XmlRpc::XmlRpcValue result;
  return node.client->executeCheckDone(result) || node.client->getfd() < 0 || loop_.getTime() > node.until_s;
}

}  // namespace waitpoint::nodes
