// SPDX-License-Identifier: BSD-3-Clause
// An interpreter of Tcl within a simulated task: the commands of a client of modules, and Tcl's own of events and
// clocks in virtual time.
//
// All interpreters of a process share one OS thread, and with it Tcl's queue of events; each robot's events must stay
// its own. So `after`, `vwait` and `update` are replaced by the commands of this class, with a queue in each
// interpreter, and Tcl's notifier by one without events or threads (surroundings.hpp).
//
// Callbacks (of -ack and `after`) are evaluated in `vwait` and `update` only, as by Tcl: replies that arrive while the
// script blocks elsewhere are kept until then. At one instant replies come first, then timers by date and number.
#pragma once

#include <tcl.h>

#include <deque>
#include <exception>
#include <functional>
#include <map>
#include <set>
#include <span>

#include "modules/tcl/interpreter.hpp"
#include "modules/tcl/library/surroundings.hpp"
#include "modules/tcl/library/syntax.hpp"

namespace waitpoint::tcl {

class TaskInterpreter : public Interpreter {
 public:
  TaskInterpreter(RobotLink& link, std::uint32_t seed);
  ~TaskInterpreter() override;
  TaskInterpreter(const TaskInterpreter&) = delete;
  TaskInterpreter& operator=(const TaskInterpreter&) = delete;

  ScriptEnd run(const std::string& file, const std::string& script) override;
  ScriptEnd evaluate(const std::string& command) override;
  void reseed(std::uint32_t seed) override { set_seed(tcl_, seed); }

 private:
  using Words = std::span<Tcl_Obj* const>;
  using Command = int (TaskInterpreter::*)(Words words);
  struct Bound {
    TaskInterpreter* self;
    Command command;
  };
  /// A request of a module, as a command.
  struct RequestCommand {
    TaskInterpreter* self;
    std::string module;
    RequestShape shape;
  };
  /// A further command of the link.
  struct LinkCommand {
    TaskInterpreter* self;
    std::string name;
  };
  /// A request that has been sent.
  struct Sent {
    std::string module, name;  ///< name: of the script's, "ndd::GoTo#3"
    std::optional<std::string> ack;
    std::int32_t activity = -1;
    std::optional<ReplyText> final;
  };
  struct Timer {
    Time due;
    std::uint64_t number = 0;
    std::string script;
    bool idle = false;
  };

  void add(const char* name, Command command);
  static int call(ClientData data, Tcl_Interp*, int count, Tcl_Obj* const* words);
  static int call_request(ClientData data, Tcl_Interp*, int count, Tcl_Obj* const* words);
  static int call_link(ClientData data, Tcl_Interp*, int count, Tcl_Obj* const* words);
  /// Keeps an exception of `function` for run(), and ends the script.
  int guarded(const std::function<int()>& function);
  int unwind();
  int fail(const std::string& message, const char* kind = "ERROR");
  int succeed(const std::string& text);
  int usage(Words words, const char* arguments);
  ScriptEnd outcome(int result);

  // Requests: requests.cpp.
  int connect(Words words);
  int load_module(Words words);
  int read_poster(Words words);
  int request(const RequestCommand& command, Words words);
  int wait(Words words);
  int abort(Words words);
  int state(Words words);
  Sent* find_sent(Tcl_Obj* name, std::uint32_t& id);
  bool receive(Duration timeout);
  int wait_for(std::uint32_t id, Time deadline);
  int finish(std::uint32_t id);

  // Events: events.cpp.
  int after(Words words);
  int cancel(Words words);
  int vwait(Words words);
  int update(Words words);
  int puts(Words words);
  int exit(Words words);
  bool do_one_event(bool idle, Time limit, int& result);
  void do_idle_tasks(int& result);
  std::optional<Time> next_timer() const;
  bool may_still_happen() const;
  int evaluate_callback(const std::string& script);

  RobotLink& link_;
  Tcl_Interp* tcl_;
  std::deque<Bound> bound_;
  std::deque<RequestCommand> request_commands_;
  std::deque<LinkCommand> link_commands_;
  std::set<std::string> loaded_;  // modules
  std::map<std::uint32_t, Sent> sent_;
  std::deque<std::uint32_t> acknowledged_;  // final replies whose callback has not been evaluated
  std::deque<Timer> timers_;                // by date, then number
  std::uint64_t timers_made_ = 0;
  std::string line_;  // the beginning of one that the script writes
  ProceduresByName procedures_;
  std::exception_ptr thrown_;
  bool exited_ = false;
};

}  // namespace waitpoint::tcl
