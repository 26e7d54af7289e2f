// SPDX-License-Identifier: BSD-3-Clause
// A Tcl interpreter as a simulated task sees it, without Tcl's headers: it is in a library of its own, which is loaded
// by the first scenario that has a script, so that programs without scripts do not need Tcl.
//
//   task -> Interpreter -> script -> commands -> RobotLink -> modules
//
// An exception of RobotLink's functions, such as the one that ends a run's tasks, leaves the interpreter through all
// levels of the script, which cannot catch it.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/field_text.hpp"
#include "core/setting.hpp"
#include "core/time.hpp"

namespace waitpoint::tcl {

/// The result of a command: its text, or the reason of its failure.
struct Answer {
  bool ok = true;
  std::string text;
  std::uint32_t id = 0;  ///< of a request that has been sent
};

/// A module's reply to a request.
struct ReplyText {
  std::uint32_t id = 0;  ///< as from send()
  bool final = false;
  std::int32_t activity = -1;
  bool ok = true;
  std::string report;  ///< "ok", "ACTIVITY_INTERRUPTED", "own report 100"
  std::string output;  ///< by its declared fields
};

struct RequestShape {
  std::string name;
  FieldShape input;
};

/// The surroundings of a script: its robot's modules, and virtual time.
class RobotLink {
 public:
  virtual ~RobotLink() = default;

  virtual std::string robot() const = 0;
  virtual std::vector<std::string> modules() const = 0;
  /// Of a module that exists.
  virtual std::vector<RequestShape> requests(const std::string& module) const = 0;
  /// Sends a request; fails for arguments that do not fit, and if the module's mailbox is full.
  virtual Answer send(const std::string& module, const std::string& request, const std::vector<Setting>& input) = 0;
  /// A request that has not come to its module never does, and ends interrupted.
  virtual void withdraw(std::uint32_t id) = 0;
  /// The next reply to any request; nothing after `timeout` (Duration::max(): no timeout).
  virtual std::optional<ReplyText> receive(Duration timeout) = 0;
  /// The value of the poster "<module>.<name>"; fails if there is none, or it is empty.
  virtual Answer read_poster(const std::string& module, const std::string& name) = 0;

  virtual Time now() const = 0;
  virtual void sleep_until(Time time) = 0;
  /// The absolute folders whose files the script may read and write; relative names are in the first. None: no files.
  virtual std::vector<std::string> folders() const { return {}; }
  /// The script opens a file of these folders, or names one that it writes. False: an output of the run, which it may
  /// not use.
  virtual bool takes_file(const std::string&, bool /*writes*/) { return true; }
  /// A line that the script writes: for people, and for the robot's digest.
  virtual void say(const std::string& line) = 0;

  /// Further commands, in the namespace `waitpoint`, and their execution.
  virtual std::vector<std::string> commands() const { return {}; }
  virtual Answer carry_out(const std::string& command, const std::vector<std::string>& words);
};

inline Answer RobotLink::carry_out(const std::string&, const std::vector<std::string>&) { return {}; }

/// The end of a script: its result, or its error with the innermost known place.
struct ScriptEnd {
  bool ok = true;
  bool exited = false;  ///< by the command `exit`
  std::string text;
  int line = 0;       ///< of the script; 0: unknown
  std::string trace;  ///< the levels of the script, innermost first, a line each
};

class Interpreter {
 public:
  virtual ~Interpreter() = default;
  /// Evaluates a script of a file; from the task that made the interpreter.
  virtual ScriptEnd run(const std::string& file, const std::string& script) = 0;
  /// Evaluates a command of a person.
  virtual ScriptEnd evaluate(const std::string& command) = 0;
  /// From any task, while the interpreter's blocks: rand() goes on from this seed.
  virtual void reseed(std::uint32_t seed) = 0;
};

struct SyntaxError {
  int line = 0;
  std::string text;
};

/// A procedure that a script defines.
struct Procedure {
  std::string name;
  std::string parameters;  ///< a list of Tcl
  int line = 0;            ///< of its body
};

/// The library, loaded.
struct Library {
  static constexpr const char* file = "libwaitpoint-tcl.so";
  static constexpr const char* symbol = "waitpoint_tcl_library_6";  ///< with the version of this file

  /// Makes an interpreter, in a task that destroys it again. `seed` is that of rand(), `now` the clock of the running
  /// task.
  std::unique_ptr<Interpreter> (*make)(RobotLink& link, std::uint32_t seed, Time (*now)());
  /// The first syntax error of a script, without executing it.
  std::optional<SyntaxError> (*check)(const std::string& script);
  /// The procedures of a script without syntax errors, by name, without executing it.
  std::vector<Procedure> (*procedures)(const std::string& script);
  /// The error of a call of a procedure with the words of `arguments`; empty: none.
  std::string (*check_call)(const Procedure& procedure, const std::string& arguments);
  /// False: the text continues on further lines.
  bool (*is_complete)(const std::string& text);
};

/// Loads the library at the first call; BadInput at `where` if it is not there.
const Library& library(const std::string& where, int line);
/// The same, for a script whose name stands there; BadInput for a syntax error.
const Library& library_for(const std::string& file, const std::string& script, const std::string& where, int line);
/// Tells the place of the library; by default, and if `path` is empty, it is one folder above the program.
void set_library_path(const std::string& path);

}  // namespace waitpoint::tcl
