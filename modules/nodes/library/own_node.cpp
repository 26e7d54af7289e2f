// SPDX-License-Identifier: BSD-3-Clause
#include "modules/nodes/library/own_node.hpp"

#include <ros/ros.h>

#include <cstdlib>

#include "modules/nodes/library/parameters.hpp"

namespace waitpoint::nodes {
namespace {

using XmlRpc::XmlRpcValue;

XmlRpcValue value_of(const nlohmann::json& json);

/// Of a map within a list; others are parameters of their own.
XmlRpcValue structure_of(const nlohmann::json& json) {
  XmlRpcValue structure = empty_structure();
  for (const auto& [key, element] : json.items()) structure[key] = value_of(element);
  return structure;
}

XmlRpcValue value_of(const nlohmann::json& json) {
  if (json.is_boolean()) return XmlRpcValue(json.get<bool>());
  if (json.is_number_integer()) return XmlRpcValue(json.get<int>());
  if (json.is_number()) return XmlRpcValue(json.get<double>());
  if (json.is_string()) return XmlRpcValue(json.get<std::string>());
  if (json.is_object()) return structure_of(json);
  XmlRpcValue array;
  array.setSize(0);
  int i = 0;
  for (const nlohmann::json& element : json) array[i++] = value_of(element);
  return array;
}

}  // namespace

void set_parameters(UsedMaster& master, bool has_clock,
                    const std::vector<std::pair<std::string, nlohmann::json>>& parameters) {
  for (const auto& [name, parameter] : parameters) master.set_parameter(name, value_of(parameter));
  master.set_parameter("/rosdistro", XmlRpcValue("noetic\n"));
  master.set_parameter("/rosversion", XmlRpcValue("1.15.15\n"));
  if (has_clock) master.set_parameter("/use_sim_time", XmlRpcValue(true));
}

void start_own_node(const UsedMaster& master) {
  // The names and addresses are the run's, whatever the shell's are; the nodes get this environment.
  for (const char* const variable : {"ROS_NAMESPACE", "ROS_HOSTNAME", "ROS_IPV6"}) unsetenv(variable);
  setenv("ROS_IP", "127.0.0.1", 1);
  ros::M_string remappings{{"__master", master.address()}};
  ros::init(remappings, own_name + 1, ros::init_options::NoSigintHandler | ros::init_options::NoRosout);
}

}  // namespace waitpoint::nodes
