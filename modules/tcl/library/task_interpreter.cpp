// SPDX-License-Identifier: BSD-3-Clause
#include "modules/tcl/library/task_interpreter.hpp"

#include <algorithm>

#include "modules/tcl/library/surroundings.hpp"

namespace waitpoint::tcl {
namespace {

// Levels of procedures, and of commands that evaluate scripts by themselves (lsort -command, update), which take up to
// 0.7 KiB of the stack each. Procedures that call each other take none: Tcl keeps their frames in the heap.
constexpr int levels_max = 1000;

std::unique_ptr<Interpreter> make(RobotLink& link, std::uint32_t seed, Time (*now)()) {
  set_up_process(now);
  return std::make_unique<TaskInterpreter>(link, seed);
}

std::optional<SyntaxError> check(const std::string& script) { return check_syntax(script); }

std::vector<Procedure> procedures_of(const std::string& script) {
  ProceduresByName by_name;
  (void)check_syntax(script, &by_name);
  std::vector<Procedure> all;
  for (auto& [name, procedure] : by_name) all.push_back(std::move(procedure));
  return all;
}

bool is_complete(const std::string& text) { return Tcl_CommandComplete(text.c_str()) != 0; }

}  // namespace

TaskInterpreter::TaskInterpreter(RobotLink& link, std::uint32_t seed) : link_(link), tcl_(Tcl_CreateInterp()) {
  Tcl_Init(tcl_);
  Tcl_SetRecursionLimit(tcl_, levels_max);
  set_up_interpreter(tcl_, seed, link_);
  add("connect", &TaskInterpreter::connect);
  add("lm", &TaskInterpreter::load_module);
  add("wait", &TaskInterpreter::wait);
  add("abort", &TaskInterpreter::abort);
  add("state", &TaskInterpreter::state);
  add("after", &TaskInterpreter::after);
  add("vwait", &TaskInterpreter::vwait);
  add("update", &TaskInterpreter::update);
  add("puts", &TaskInterpreter::puts);
  add("exit", &TaskInterpreter::exit);
  for (const std::string& name : link_.commands()) {
    LinkCommand& command = link_commands_.emplace_back(LinkCommand{this, name});
    Tcl_CreateObjCommand(tcl_, ("::waitpoint::" + name).c_str(), call_link, &command, nullptr);
  }
}

TaskInterpreter::~TaskInterpreter() { Tcl_DeleteInterp(tcl_); }

void TaskInterpreter::add(const char* name, Command command) {
  Bound& bound = bound_.emplace_back(Bound{this, command});
  Tcl_CreateObjCommand(tcl_, (std::string("::") + name).c_str(), call, &bound, nullptr);
}

int TaskInterpreter::guarded(const std::function<int()>& function) {
  try {
    return function();
  } catch (...) {
    thrown_ = std::current_exception();
  }
  return unwind();
}

// Ends all levels of the script up to run() or evaluate(), past `catch` and `finally`: an exceeded limit is the only
// means by which the interpreter can be used again.
int TaskInterpreter::unwind() {
  Tcl_LimitTypeSet(tcl_, TCL_LIMIT_COMMANDS);
  Tcl_LimitSetCommands(tcl_, 0);
  return Tcl_LimitCheck(tcl_);
}

int TaskInterpreter::call(ClientData data, Tcl_Interp*, int count, Tcl_Obj* const* words) {
  const auto& bound = *static_cast<const Bound*>(data);
  return bound.self->guarded([&] { return (bound.self->*bound.command)({words, static_cast<std::size_t>(count)}); });
}

int TaskInterpreter::call_request(ClientData data, Tcl_Interp*, int count, Tcl_Obj* const* words) {
  const auto& command = *static_cast<const RequestCommand*>(data);
  return command.self->guarded([&] {
    return command.self->request(command, {words, static_cast<std::size_t>(count)});
  });
}

int TaskInterpreter::call_link(ClientData data, Tcl_Interp*, int count, Tcl_Obj* const* words) {
  const auto& command = *static_cast<const LinkCommand*>(data);
  TaskInterpreter& self = *command.self;
  return self.guarded([&] {
    std::vector<std::string> arguments;
    for (int i = 1; i < count; ++i) arguments.emplace_back(Tcl_GetString(words[i]));
    const Answer answer = self.link_.carry_out(command.name, arguments);
    return answer.ok ? self.succeed(answer.text) : self.fail(answer.text);
  });
}

int TaskInterpreter::fail(const std::string& message, const char* kind) {
  Tcl_SetObjResult(tcl_, Tcl_NewStringObj(message.data(), static_cast<int>(message.size())));
  Tcl_SetErrorCode(tcl_, "WAITPOINT", kind, nullptr);
  return TCL_ERROR;
}

int TaskInterpreter::succeed(const std::string& text) {
  Tcl_SetObjResult(tcl_, Tcl_NewStringObj(text.data(), static_cast<int>(text.size())));
  return TCL_OK;
}

int TaskInterpreter::usage(Words words, const char* arguments) {
  Tcl_WrongNumArgs(tcl_, 1, words.data(), arguments);
  return TCL_ERROR;
}

ScriptEnd TaskInterpreter::run(const std::string& file, const std::string& script) {
  procedures_.clear();
  (void)check_syntax(script, &procedures_);
  Tcl_Obj* const words[] = {Tcl_NewStringObj("info", -1), Tcl_NewStringObj("script", -1),
                            Tcl_NewStringObj(file.data(), static_cast<int>(file.size()))};
  for (Tcl_Obj* word : words) Tcl_IncrRefCount(word);
  Tcl_EvalObjv(tcl_, 3, words, TCL_EVAL_GLOBAL);
  for (Tcl_Obj* word : words) Tcl_DecrRefCount(word);
  return outcome(Tcl_EvalEx(tcl_, script.data(), static_cast<int>(script.size()), TCL_EVAL_GLOBAL));
}

ScriptEnd TaskInterpreter::evaluate(const std::string& command) {
  return outcome(Tcl_EvalEx(tcl_, command.data(), static_cast<int>(command.size()), TCL_EVAL_GLOBAL));
}

ScriptEnd TaskInterpreter::outcome(int result) {
  Tcl_LimitTypeReset(tcl_, TCL_LIMIT_COMMANDS);
  if (thrown_ != nullptr) std::rethrow_exception(std::exchange(thrown_, nullptr));
  if (!line_.empty()) link_.say(std::exchange(line_, {}));
  ScriptEnd outcome;
  const bool has_exited = std::exchange(exited_, false);
  if (has_exited || result == TCL_OK || result == TCL_RETURN) {
    outcome.exited = has_exited;
    outcome.text = has_exited ? "" : Tcl_GetStringResult(tcl_);
    return outcome;
  }
  outcome.ok = false;
  outcome.text = result == TCL_ERROR ? Tcl_GetStringResult(tcl_) : "break or continue outside a loop";
  const char* const trace = Tcl_GetVar(tcl_, "errorInfo", TCL_GLOBAL_ONLY);
  if (result == TCL_ERROR && trace != nullptr) outcome.trace = trace;
  outcome.line = line_of_error(outcome.trace, Tcl_GetErrorLine(tcl_), procedures_);
  return outcome;
}

}  // namespace waitpoint::tcl

extern "C" [[gnu::visibility("default")]] const waitpoint::tcl::Library waitpoint_tcl_library_6 = {
    waitpoint::tcl::make, waitpoint::tcl::check, waitpoint::tcl::procedures_of, waitpoint::tcl::check_call,
    waitpoint::tcl::is_complete};
