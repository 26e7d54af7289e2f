// SPDX-License-Identifier: BSD-3-Clause
#include "modules/nodes/library/registrations.hpp"

#include <algorithm>

namespace waitpoint::nodes {
namespace {

constexpr const char* any_type = "*";

bool is_within(const std::string& name, const std::string& space) {
  if (space.empty() || space == "/") return true;
  const std::string folder = space.back() == '/' ? space : space + "/";
  return name.starts_with(folder);
}

}  // namespace

std::vector<std::string> Registrations::publish(const std::string& node, const std::string& topic,
                                                const std::string& type, const std::string& address) {
  know(node, address);
  add(publishers_, topic, node);
  // A subscriber of any type does not settle it.
  std::string& known = types_[topic];
  if (known.empty() || known == any_type) known = type;
  tell_of_publishers(topic);
  return addresses_of(topic, subscribers_);
}

std::vector<std::string> Registrations::subscribe(const std::string& node, const std::string& topic,
                                                  const std::string& type, const std::string& address) {
  know(node, address);
  add(subscribers_, topic, node);
  types_.try_emplace(topic, type);
  return addresses_of(topic, publishers_);
}

bool Registrations::stop_publishing(const std::string& node, const std::string& topic, const std::string& address) {
  if (!remove(publishers_, topic, node, address)) return false;
  tell_of_publishers(topic);
  return true;
}

bool Registrations::stop_subscribing(const std::string& node, const std::string& topic, const std::string& address) {
  return remove(subscribers_, topic, node, address);
}

void Registrations::serve(const std::string& node, const std::string& service, const std::string& service_address,
                          const std::string& address) {
  know(node, address);
  Service& of = services_[service];
  if (of.node != node) {
    if (!of.node.empty()) count_down(of.node);
    ++nodes_[node].registrations;
  }
  of = {node, service_address};
}

bool Registrations::stop_serving(const std::string& node, const std::string& service,
                                 const std::string& service_address) {
  const auto found = services_.find(service);
  if (found == services_.end() || found->second.node != node || found->second.address != service_address) return false;
  services_.erase(found);
  count_down(node);
  return true;
}

std::optional<std::string> Registrations::node_address(const std::string& node) const {
  const auto found = nodes_.find(node);
  return found == nodes_.end() ? std::nullopt : std::optional(found->second.address);
}

std::optional<std::string> Registrations::service_address(const std::string& service) const {
  const auto found = services_.find(service);
  return found == services_.end() ? std::nullopt : std::optional(found->second.address);
}

std::vector<std::pair<std::string, std::string>> Registrations::published(const std::string& within) const {
  std::vector<std::pair<std::string, std::string>> all;
  for (const auto& [topic, users] : publishers_)
    if (is_within(topic, within)) all.emplace_back(topic, types_.at(topic));
  return all;
}

std::vector<std::pair<std::string, std::string>> Registrations::types() const { return {types_.begin(), types_.end()}; }

std::vector<Registrations::Names> Registrations::names(const Table& table) {
  std::vector<Names> all;
  all.reserve(table.size());
  for (const auto& [name, users] : table) all.push_back({name, users});
  return all;
}

std::vector<Registrations::Names> Registrations::services() const {
  std::vector<Names> all;
  all.reserve(services_.size());
  for (const auto& [name, service] : services_) all.push_back({name, {service.node}});
  return all;
}

std::optional<Notification> Registrations::take_notification() {
  if (notifications_.empty()) return std::nullopt;
  Notification first = std::move(notifications_.front());
  notifications_.pop_front();
  return first;
}

void Registrations::know(const std::string& node, const std::string& address) {
  const auto known = nodes_.find(node);
  if (known != nodes_.end() && known->second.address != address) {
    notifications_.push_back({Notification::Kind::shutdown,
                              known->second.address,
                              "[" + node + "] Reason: new node registered with same name",
                              {}});
    forget(node);
  }
  nodes_[node].address = address;
}

void Registrations::forget(const std::string& node) {
  for (Table* const table : {&publishers_, &subscribers_}) {
    std::vector<std::string> keys;
    for (const auto& [key, users] : *table)
      if (std::find(users.begin(), users.end(), node) != users.end()) keys.push_back(key);
    for (const std::string& key : keys) {
      remove_name(*table, key, node);
      if (table == &publishers_) tell_of_publishers(key);
    }
  }
  std::erase_if(services_, [&](const auto& service) { return service.second.node == node; });
  nodes_.erase(node);
}

void Registrations::count_down(const std::string& node) {
  const auto found = nodes_.find(node);
  if (found != nodes_.end() && --found->second.registrations <= 0) nodes_.erase(found);
}

void Registrations::add(Table& table, const std::string& key, const std::string& node) {
  Users& users = table[key];
  if (std::find(users.begin(), users.end(), node) != users.end()) return;
  users.push_back(node);
  ++nodes_[node].registrations;
}

bool Registrations::remove(Table& table, const std::string& key, const std::string& node, const std::string& address) {
  const auto known = nodes_.find(node);
  if (known == nodes_.end() || known->second.address != address || !remove_name(table, key, node)) return false;
  count_down(node);
  return true;
}

bool Registrations::remove_name(Table& table, const std::string& key, const std::string& node) {
  const auto users = table.find(key);
  if (users == table.end() || std::erase(users->second, node) == 0) return false;
  if (users->second.empty()) table.erase(users);
  return true;
}

std::vector<std::string> Registrations::addresses_of(const std::string& key, const Table& table) const {
  std::vector<std::string> all;
  const auto users = table.find(key);
  if (users == table.end()) return all;
  all.reserve(users->second.size());
  for (const std::string& node : users->second) all.push_back(nodes_.at(node).address);
  return all;
}

void Registrations::tell_of_publishers(const std::string& topic) {
  const std::vector<std::string> publishers = addresses_of(topic, publishers_);
  for (const std::string& subscriber : addresses_of(topic, subscribers_))
    notifications_.push_back({Notification::Kind::publishers, subscriber, topic, publishers});
}

}  // namespace waitpoint::nodes
