// SPDX-License-Identifier: BSD-3-Clause
// The controller of a robot's execution: a task between the clients of its modules and the modules, after LAAS's R2C
// (request and report checker).
//
//   clients --- requests ---> [gate] --> controller --- accepted ones ---> modules
//           <--- replies ---------------           <--- replies ----------
//
// One step, for a letter, a period or the end of a time:
//
//   read the posters -> a reply: end or start its request -> a request: accept, reject or delay it, or withdraw one ->
//   a forbidden state: interrupt running requests -> delayed requests: accept at most one, reject those whose time is
//   over -> memory of the temporal operators -> the step's cost -> letters to modules and clients
//
// Rules hold for the state as known in a step: the poster's values are those at its beginning, and a request counts as
// running from its acceptance to its final reply.
#pragma once

#include <atomic>
#include <deque>
#include <string>
#include <utility>
#include <vector>

#include "modules/control/accepted_requests.hpp"
#include "modules/control/automaton.hpp"
#include "modules/control/bindings.hpp"
#include "modules/control/decision.hpp"
#include "modules/genom/name_space.hpp"
#include "modules/genom/request_gate.hpp"
#include "modules/genom/task_computing.hpp"

namespace waitpoint::control {

class Controller : private genom::RequestGate {
 public:
  /// Once all modules are made: takes the place of the gate of `names`, which must outlive the controller as its
  /// modules must, until it is destroyed. BadInput for rules that contradict each other or the robot.
  Controller(Rules rules, genom::NameSpace& names, const genom::TaskComputing& computing);
  ~Controller() override;

  /// Starts its task; from a task of the robot, before the modules' clients.
  void start();
  /// Ends its task, from another one: after the modules have ended.
  void stop();
  /// Call before start(). Null: no watch.
  void set_watch(DecisionWatch* watch) { watch_ = watch; }

 private:
  struct Delayed {
    ControlledRequest request;
    Time arrival, until;
    std::size_t check;  ///< for which it waits
  };
  /// The treatment of a request now.
  struct Judgement {
    Verdict verdict = Verdict::accepted;
    std::size_t check = 0;
    Duration wait_max = {};
    std::vector<std::size_t> give_way = {};  ///< checks whose activities are interrupted for it
  };

  bool post(genom::Module& module, const genom::Letter& request) override;
  void withdraw(const genom::Letter& withdrawal) override;

  void run();
  void wait();
  void step();
  void take_request(const genom::Letter& letter);
  void take_reply(const genom::Letter& reply);
  void take_withdrawal(const genom::Letter& withdrawal);
  Judgement judge(const ControlledRequest& request) const;
  void accept(ControlledRequest request);
  void reject(const ControlledRequest& request, std::size_t check);
  void end_here(const ControlledRequest& request, genom::StandardReport report);
  void keep_safe();
  void interrupt_for(std::size_t check);
  void interrupt(ControlledRequest& request, std::size_t check);
  void abort(const ControlledRequest& request);
  void look_at_delayed();
  bool is_of(const ControlledRequest& request, const std::vector<RequestPattern>& patterns) const;

  void decide(Verdict verdict, const ControlledRequest* request, std::ptrdiff_t check);
  void send();

  Rules rules_;
  genom::NameSpace& names_;
  Automaton automaton_;
  Bindings bindings_;
  genom::TaskComputing computing_;
  genom::Mailbox mailbox_{"control"};
  genom::Poster<Decision>& log_;
  DecisionWatch* watch_ = nullptr;
  std::vector<threads::thread> threads_;  // its task, from start() to stop()
  std::atomic<bool> stopping_ = false;

  // Of the task alone.
  std::vector<bool> values_;
  AcceptedRequests requests_;
  AcceptedRequests::Change change_;  // of this step
  ControlledRequest ended_;
  std::deque<Delayed> delayed_;
  std::uint32_t numbered_ = 0;
  Time now_, next_look_;
  bool again_ = false;               // a delayed request may be acceptable now
  std::vector<bool> is_unresolved_;  // by check: told so
  // Of this step, after its cost; aborts of an earlier one that found a full mailbox.
  std::vector<std::pair<genom::Mailbox*, genom::Letter>> letters_;
  std::vector<std::pair<Decision, std::string>> decisions_;
};

}  // namespace waitpoint::control
