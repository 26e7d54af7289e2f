// SPDX-License-Identifier: BSD-3-Clause
#include "modules/nodes/library/debian_master.hpp"

#include <arpa/inet.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <signal.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>
#include <xmlrpcpp/XmlRpcClient.h>

#include <chrono>
#include <cstring>
#include <stdexcept>
#include <thread>

#include "modules/nodes/library/own_node.hpp"

extern char** environ;

namespace waitpoint::nodes {
namespace {

constexpr int looks = 100;
constexpr std::chrono::milliseconds between_looks(100);

/// A free one.
int free_port() {
  const int descriptor = socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in name{};
  name.sin_family = AF_INET;
  name.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof name;
  auto* const any = reinterpret_cast<sockaddr*>(&name);
  const bool is_bound = bind(descriptor, any, size) == 0 && getsockname(descriptor, any, &size) == 0;
  close(descriptor);
  if (!is_bound) throw std::runtime_error("there is no port for the ROS master");
  return ntohs(name.sin_port);
}

pid_t start(int port) {
  std::string words[] = {"rosmaster", "--core", "-p", std::to_string(port)};
  char* arguments[] = {words[0].data(), words[1].data(), words[2].data(), words[3].data(), nullptr};
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  pid_t process = 0;
  const int error = posix_spawnp(&process, arguments[0], &actions, nullptr, arguments, environ);
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0) throw std::runtime_error(std::string("rosmaster cannot be started: ") + std::strerror(error));
  return process;
}

XmlRpc::XmlRpcValue words_of(const std::vector<std::string>& words) {
  XmlRpc::XmlRpcValue parameters;
  parameters[0] = own_name;
  for (std::size_t i = 0; i < words.size(); ++i) parameters[static_cast<int>(i) + 1] = words[i];
  return parameters;
}

constexpr int publishers = 0, services = 2;  // in a system's state

/// The nodes of a topic or service; an empty array if it has none.
XmlRpc::XmlRpcValue nodes_of(XmlRpc::XmlRpcValue& table, const std::string& name) {
  for (int i = 0; i < table.size(); ++i)
    if (static_cast<const std::string&>(table[i][0]) == name) return table[i][1];
  XmlRpc::XmlRpcValue none;
  none.setSize(0);
  return none;
}

}  // namespace

DebianMaster::DebianMaster()
    : port_(free_port()), address_("http://127.0.0.1:" + std::to_string(port_) + "/"), process_(start(port_)) {
  XmlRpc::XmlRpcValue id;
  for (int look = 0; look < looks; ++look) {
    if (call("getPid", words_of({}), id)) return;
    std::this_thread::sleep_for(between_looks);
  }
  end();
  throw std::runtime_error("rosmaster does not answer");
}

void DebianMaster::end() {
  kill(process_, SIGINT);
  for (int look = 0; look < looks; ++look) {
    if (waitpid(process_, nullptr, WNOHANG) != 0) return;
    std::this_thread::sleep_for(between_looks);
  }
  kill(process_, SIGKILL);
  waitpid(process_, nullptr, 0);
}

// A connection for each call, since the client of roscpp's library is for one thread.
bool DebianMaster::call(const char* method, const XmlRpc::XmlRpcValue& parameters, XmlRpc::XmlRpcValue& value) const {
  constexpr int done = 1;
  XmlRpc::XmlRpcClient client("127.0.0.1", port_, "/");
  XmlRpc::XmlRpcValue result;
  if (!client.execute(method, parameters, result) || client.isFault() || result.size() != 3) return false;
  value = result[2];
  return static_cast<int>(result[0]) == done;
}

void DebianMaster::set_parameter(const std::string& key, const XmlRpc::XmlRpcValue& value) {
  XmlRpc::XmlRpcValue parameters = words_of({key}), none;
  parameters[2] = value;
  call("setParam", parameters, none);
}

bool DebianMaster::is_published(const std::string& topic) const {
  XmlRpc::XmlRpcValue state;
  return call("getSystemState", words_of({}), state) && nodes_of(state[publishers], topic).size() > 0;
}

bool DebianMaster::is_served(const std::string& service) const {
  XmlRpc::XmlRpcValue state;
  return call("getSystemState", words_of({}), state) && nodes_of(state[services], service).size() > 0;
}

bool DebianMaster::is_node(const std::string& name) const {
  XmlRpc::XmlRpcValue address;
  return call("lookupNode", words_of({name}), address);
}

std::vector<std::string> DebianMaster::topics_not_only_of(const std::string& node) const {
  XmlRpc::XmlRpcValue state;
  std::vector<std::string> topics;
  if (!call("getSystemState", words_of({}), state)) return topics;
  for (int i = 0; i < state[publishers].size(); ++i) {
    XmlRpc::XmlRpcValue& topic = state[publishers][i];
    bool is_of_another = false;
    for (int j = 0; j < topic[1].size(); ++j)
      is_of_another = is_of_another || static_cast<const std::string&>(topic[1][j]) != node;
    if (is_of_another) topics.push_back(topic[0]);
  }
  return topics;
}

}  // namespace waitpoint::nodes
