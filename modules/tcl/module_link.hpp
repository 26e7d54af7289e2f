// SPDX-License-Identifier: BSD-3-Clause
// A script's link to the modules of its robot: a client of them, and the clock of its task.
#pragma once

#include <functional>

#include "modules/genom/client.hpp"
#include "modules/tcl/interpreter.hpp"

namespace waitpoint::tcl {

/// The words of a report: "ok", "ACTIVITY_FAILED", "own report 100".
std::string text_of(genom::Report report);

class ModuleLink : public RobotLink {
 public:
  /// `say` gets the lines that the script writes, printable. `owner` names the task in reports.
  ModuleLink(genom::NameSpace& names, std::string robot, const std::string& owner,
             std::function<void(Time date, const std::string& line)> say, std::vector<std::string> folders = {});

  std::string robot() const override { return robot_; }
  std::vector<std::string> modules() const override;
  std::vector<RequestShape> requests(const std::string& module) const override;
  Answer send(const std::string& module, const std::string& request, const std::vector<Setting>& input) override;
  void withdraw(std::uint32_t id) override { client_.withdraw(id); }
  std::optional<ReplyText> receive(Duration timeout) override;
  Answer read_poster(const std::string& module, const std::string& name) override;
  Time now() const override { return threads::now(); }
  void sleep_until(Time time) override;
  std::vector<std::string> folders() const override { return folders_; }
  bool takes_file(const std::string& file, bool writes) override;
  void say(const std::string& line) override;

 protected:
  genom::NameSpace& names() { return names_; }
  genom::Client& client() { return client_; }

 private:
  genom::NameSpace& names_;
  std::string robot_;
  genom::Client client_;
  std::function<void(Time date, const std::string& line)> say_;
  std::vector<std::string> folders_;
};

}  // namespace waitpoint::tcl
