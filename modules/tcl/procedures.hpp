// SPDX-License-Identifier: BSD-3-Clause
// The procedures of a robot's script as requests of a module: a plan above the script sends them as it sends requests
// to other modules, through the execution control.
//
//   plan --- request "visit" {arguments "20 6.4"} ---> module `tcl` --- call ---> task of the script: visit 20 6.4
//        <-- final reply, when the procedure ends ----              <-- end() ---
//
// The script's task evaluates one procedure at a time, in the order of their requests. An interrupted procedure ends
// where it waits; its activity ends at once.
#pragma once

#include <array>
#include <deque>
#include <functional>
#include <optional>

#include "modules/genom/module.hpp"
#include "modules/tcl/interpreter.hpp"

namespace waitpoint::tcl {

/// The input of each of the requests.
struct ProcedureInput {
  std::array<char, 240> arguments{};  ///< words of Tcl

  static void fields(auto field) { field("arguments", &ProcedureInput::arguments); }
};

class Procedures : public genom::Module {
 public:
  static constexpr std::uint16_t number = 28;
  static constexpr std::uint16_t failed = genom::first_own_report;  ///< the report of a procedure with an error

  /// A request for each procedure of the script whose name has letters, digits and _ alone. `library` is Tcl's, loaded.
  Procedures(genom::ModuleSetup& setup, const Library& library, const std::string& script);

  /// The error of a request, without sending it: "wrong # args: ..."; empty: none.
  std::string check(const std::string& procedure, const std::string& arguments) const;

  // The calls below are of the script's task.

  /// `wake` is called from other tasks at each call and each interruption. Before the module is started.
  void set_wake(std::function<void()> wake) { wake_ = std::move(wake); }
  /// Begins the oldest call: its command. Nothing if there is none.
  std::optional<std::string> begin();
  /// True if the call that has begun is to end.
  bool is_interrupted() const;
  /// Ends the call that has begun.
  void end(bool succeeded);

 private:
  struct Call {
    std::int32_t activity;  ///< -1: interrupted, so its activity has ended
    std::string command;
    bool has_begun = false;
    std::optional<bool> result;  ///< of one that has ended: true if it succeeded
  };

  void add(const Procedure& procedure);
  void submit(std::int32_t activity, std::string command);
  void interrupt(std::int32_t activity);
  std::optional<bool> take_result(std::int32_t activity);
  std::deque<Call>::iterator find(std::int32_t activity);
  std::deque<Call>::iterator begun();

  const Library& library_;
  std::vector<Procedure> procedures_;
  genom::ExecutionTask& task_;
  std::function<void()> wake_;
  mutable threads::mutex mutex_{"calls"};
  std::deque<Call> calls_;  // guarded by it
};

}  // namespace waitpoint::tcl
