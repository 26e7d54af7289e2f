// SPDX-License-Identifier: BSD-3-Clause
// The names of one robot: its posters, modules and processors. Gives no access to another robot.
#pragma once

#include <map>
#include <memory>
#include <string>

#include "modules/genom/poster.hpp"
#include "modules/genom/request_gate.hpp"

namespace waitpoint::genom {

class NameSpace {
 public:
  /// Creates a poster; a duplicate name is BadInput.
  template <HasFields T>
  Poster<T>& create_poster(const std::string& name, const std::string& writer) {
    auto poster = std::make_unique<Poster<T>>(name, writer);
    Poster<T>& reference = *poster;
    add(std::move(poster));
    return reference;
  }

  /// Null if there is none.
  PosterBase* find_poster(const std::string& name) const;
  Module* find_module(const std::string& name) const;
  /// Adds a processor that tasks of this robot can share; a duplicate name is a bug.
  threads::processor& add_processor(const std::string& name);
  threads::processor* find_processor(const std::string& name) const;
  /// A duplicate name is BadInput.
  void add(const std::string& name, Module& module);

  /// The gate through which clients' requests pass, which must outlive their tasks; null (the default): none.
  RequestGate* gate() const { return gate_; }
  void set_gate(RequestGate* gate) { gate_ = gate; }

  const std::map<std::string, std::unique_ptr<PosterBase>>& posters() const { return posters_; }
  const std::map<std::string, Module*>& modules() const { return modules_; }

 private:
  void add(std::unique_ptr<PosterBase> poster);

  std::map<std::string, std::unique_ptr<PosterBase>> posters_;
  std::map<std::string, Module*> modules_;
  std::map<std::string, std::unique_ptr<threads::processor>> processors_;
  RequestGate* gate_ = nullptr;
};

}  // namespace waitpoint::genom
