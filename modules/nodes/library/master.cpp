// SPDX-License-Identifier: BSD-3-Clause
#include "modules/nodes/library/master.hpp"

#include <unistd.h>
#include <xmlrpcpp/XmlRpcException.h>
#include <xmlrpcpp/XmlRpcServer.h>
#include <xmlrpcpp/XmlRpcServerMethod.h>

#include <algorithm>
#include <functional>
#include <stdexcept>

namespace waitpoint::nodes {
namespace {

constexpr const char* own_name = "/master";
constexpr double round_s = 0.05;  // of the loop, without calls; the library's header says milliseconds
constexpr int backlog = 128;

Value answer(int code, const std::string& text, const Value& value) {
  Value triple;
  triple[0] = code;
  triple[1] = text;
  triple[2] = value;
  return triple;
}
Value done(const std::string& text, const Value& value) { return answer(1, text, value); }
Value refused(const std::string& text) { return answer(-1, text, Value(0)); }

Value empty_array() {
  Value value;
  value.setSize(0);
  return value;
}

template <class Range, class ToValue>
Value array_of(const Range& range, ToValue to_value) {
  Value array = empty_array();
  int i = 0;
  for (const auto& element : range) array[i++] = to_value(element);
  return array;
}

Value texts(const std::vector<std::string>& all) {
  return array_of(all, [](const std::string& text) { return Value(text); });
}

Value pairs(const std::vector<std::pair<std::string, std::string>>& all) {
  return array_of(all, [](const auto& pair) { return texts({pair.first, pair.second}); });
}

Value names(const std::vector<Registrations::Names>& all) {
  return array_of(all, [](const Registrations::Names& of) {
    Value pair;
    pair[0] = of.name;
    pair[1] = texts(of.nodes);
    return pair;
  });
}

const std::string& text(const Value& parameters, int i) { return static_cast<const std::string&>(parameters[i]); }

/// The name of a parameter as its caller means it: in the caller's namespace, unless it begins with a slash.
std::string full_name(const std::string& caller, const std::string& key) {
  if (key.starts_with('/')) return key;
  if (key.starts_with('~')) return caller + "/" + key.substr(1);
  return caller.substr(0, caller.rfind('/') + 1) + key;
}

}  // namespace

struct Master::Method final : XmlRpc::XmlRpcServerMethod {
  using Call = std::function<Value(const Value& parameters)>;

  Method(const char* method_name, int parameter_count, Call made)
      : XmlRpcServerMethod(method_name), count(parameter_count), call(std::move(made)) {}

  void execute(Value& parameters, Value& result) override {
    if (parameters.getType() != Value::TypeArray || parameters.size() != count) {
      result = refused(_name + ": expected " + std::to_string(count) + " parameters");
      return;
    }
    try {
      result = call(parameters);
    } catch (const XmlRpc::XmlRpcException& bad) {
      result = refused(_name + ": " + bad.getMessage());
    }
  }

  int count;
  Call call;
};

Master::Master() : server_(std::make_unique<XmlRpc::XmlRpcServer>()) {
  add_methods();
  if (!server_->bindAndListen(0, backlog)) throw std::runtime_error("there is no port for the ROS master");
  address_ = "http://127.0.0.1:" + std::to_string(server_->get_port()) + "/";
  thread_ = std::thread([this] { serve(); });
}

Master::~Master() {
  is_ending_ = true;
  thread_.join();
  server_->shutdown();
}

void Master::serve() {
  CallsToNodes calls(*server_->get_dispatch());
  while (!is_ending_) {
    server_->work(round_s);
    const std::lock_guard lock(mutex_);
    while (const auto news = registrations_.take_notification()) {
      Value parameters;
      parameters[0] = own_name;
      parameters[1] = news->topic;
      if (news->kind == Notification::Kind::publishers) parameters[2] = texts(news->publishers);
      calls.add(news->address, news->kind == Notification::Kind::publishers ? "publisherUpdate" : "shutdown",
                parameters);
    }
    while (const auto change = parameters_.take_change()) {
      Value parameters;
      parameters[0] = own_name;
      parameters[1] = change->key;
      parameters[2] = change->value;
      calls.add(change->address, "paramUpdate", parameters);
    }
    calls.go_on();
  }
}

void Master::set_parameter(const std::string& key, const Value& value) {
  const std::lock_guard lock(mutex_);
  parameters_.set(key, value);
}

std::optional<Value> Master::parameter(const std::string& key) const {
  const std::lock_guard lock(mutex_);
  return parameters_.get(key);
}

bool Master::is_published(const std::string& topic) const {
  const std::lock_guard lock(mutex_);
  return registrations_.is_published(topic);
}

bool Master::is_served(const std::string& service) const {
  const std::lock_guard lock(mutex_);
  return registrations_.service_address(service).has_value();
}

bool Master::is_node(const std::string& name) const {
  const std::lock_guard lock(mutex_);
  return registrations_.node_address(name).has_value();
}

std::vector<std::string> Master::topics_not_only_of(const std::string& node) const {
  const std::lock_guard lock(mutex_);
  std::vector<std::string> topics;
  for (const Registrations::Names& topic : registrations_.publishers())
    if (std::any_of(topic.nodes.begin(), topic.nodes.end(), [&](const std::string& name) { return name != node; }))
      topics.push_back(topic.name);
  return topics;
}

// A call that is answered ends the round of the loop, so that its consequences go out at once.
template <class Call>
void Master::add_method(const char* name, int parameters, Call call) {
  methods_.push_back(std::make_unique<Method>(name, parameters, [this, call](const Value& given) {
    const std::lock_guard lock(mutex_);
    server_->exit();
    return call(given);
  }));
  server_->addMethod(methods_.back().get());
}

void Master::add_methods() {
  add_registration_methods();
  add_lookup_methods();
  add_parameter_methods();
  add_method("getUri", 1, [this](const Value&) { return done("", address_); });
  add_method("getPid", 1, [](const Value&) { return done("", static_cast<int>(getpid())); });
  add_method("shutdown", 2, [](const Value&) { return refused("the master ends with the run"); });
}

void Master::add_registration_methods() {
  add_method("registerPublisher", 4, [this](const Value& given) {
    return done("registered",
                texts(registrations_.publish(text(given, 0), text(given, 1), text(given, 2), text(given, 3))));
  });
  add_method("unregisterPublisher", 3, [this](const Value& given) {
    return done("", registrations_.stop_publishing(text(given, 0), text(given, 1), text(given, 2)) ? 1 : 0);
  });
  add_method("registerSubscriber", 4, [this](const Value& given) {
    return done("registered",
                texts(registrations_.subscribe(text(given, 0), text(given, 1), text(given, 2), text(given, 3))));
  });
  add_method("unregisterSubscriber", 3, [this](const Value& given) {
    return done("", registrations_.stop_subscribing(text(given, 0), text(given, 1), text(given, 2)) ? 1 : 0);
  });
  add_method("registerService", 4, [this](const Value& given) {
    registrations_.serve(text(given, 0), text(given, 1), text(given, 2), text(given, 3));
    return done("registered", 1);
  });
  add_method("unregisterService", 3, [this](const Value& given) {
    return done("", registrations_.stop_serving(text(given, 0), text(given, 1), text(given, 2)) ? 1 : 0);
  });
}

void Master::add_lookup_methods() {
  add_method("lookupNode", 2, [this](const Value& given) {
    if (text(given, 1) == own_name) return done("", address_);
    const auto address = registrations_.node_address(text(given, 1));
    return address ? done("", *address) : refused("unknown node [" + text(given, 1) + "]");
  });
  add_method("lookupService", 2, [this](const Value& given) {
    const auto address = registrations_.service_address(text(given, 1));
    return address ? done("", *address) : refused("no provider");
  });
  add_method("getPublishedTopics", 2,
             [this](const Value& given) { return done("", pairs(registrations_.published(text(given, 1)))); });
  add_method("getTopicTypes", 1, [this](const Value&) { return done("", pairs(registrations_.types())); });
  add_method("getSystemState", 1, [this](const Value&) {
    Value state;
    state[0] = names(registrations_.publishers());
    state[1] = names(registrations_.subscribers());
    state[2] = names(registrations_.services());
    return done("", state);
  });
}

void Master::add_parameter_methods() {
  const auto missing = [](const std::string& key) { return refused("Parameter [" + key + "] is not set"); };
  add_method("setParam", 3, [this](const Value& given) {
    const bool taken = parameters_.set(full_name(text(given, 0), text(given, 1)), given[2]);
    return taken ? done("", 0) : refused("expected a dictionary for the whole tree");
  });
  add_method("getParam", 2, [this, missing](const Value& given) {
    const std::string key = full_name(text(given, 0), text(given, 1));
    const auto value = parameters_.get(key);
    return value ? done("", *value) : missing(key);
  });
  add_method("deleteParam", 2, [this, missing](const Value& given) {
    const std::string key = full_name(text(given, 0), text(given, 1));
    return parameters_.erase(key) ? done("", 0) : missing(key);
  });
  add_method("hasParam", 2, [this](const Value& given) {
    return done("", Value(parameters_.get(full_name(text(given, 0), text(given, 1))).has_value()));
  });
  add_method("searchParam", 2, [this, missing](const Value& given) {
    const auto found = parameters_.search(text(given, 0), text(given, 1));
    return found ? done("", *found) : missing(text(given, 1));
  });
  add_method("getParamNames", 1, [this](const Value&) { return done("", texts(parameters_.names())); });
  add_method("subscribeParam", 3, [this](const Value& given) {
    return done("", parameters_.subscribe(text(given, 1), full_name(text(given, 0), text(given, 2))));
  });
  add_method("unsubscribeParam", 3, [this](const Value& given) {
    const std::string key = full_name(text(given, 0), text(given, 2));
    return done("", parameters_.unsubscribe(text(given, 1), key) ? 1 : 0);
  });
}

}  // namespace waitpoint::nodes
