// SPDX-License-Identifier: BSD-3-Clause
// A command of a program, declared: its arguments, its options in sections, which of them go together, and its help.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "tools/command/distinct_files.hpp"
#include "tools/command/option.hpp"

namespace waitpoint::tools {

/// Options that cannot be given together, or one that needs another. "--" stands for a program behind it.
struct Rule {
  enum class Kind { excludes, needs };

  std::string option;
  Kind kind;
  std::vector<std::string> others;  ///< all of them excluded; one of them needed
  std::string reason = {};          ///< the end of the message
  std::string unless = {};          ///< a value of `option` with which the rule does not hold
};

/// An option of the last version that is gone.
struct RemovedOption {
  std::string name, instead;  ///< what does its work now, as the end of a message
};

/// The words with which the program was called; former spellings are replaced.
struct Invocation {
  std::string program;             ///< "waitpoint", or the file of a program with modules of its own, as called
  std::vector<std::string> words;  ///< the command and all that follows
};

class Command {
 public:
  /// Texts by the names of options and arguments.
  using Given = std::map<std::string, std::vector<std::string>>;

  explicit Command(std::string name) : name(std::move(name)) {}
  Command(const Command&) = delete;
  Command& operator=(const Command&) = delete;

  std::string name;                   ///< empty: of the program itself
  std::string description;            ///< a sentence
  std::vector<std::string> examples;  ///< command lines without the program's name
  std::vector<std::string> usages;    ///< what follows the command; empty: from the declarations
  std::string notes;                  ///< the end of the help
  std::vector<Option> arguments, options;
  std::vector<Rule> rules;                ///< in the order in which they are checked
  std::vector<std::string> former_flags;  ///< of the last version, without effect now
  std::vector<RemovedOption> removed;
  bool takes_program = false;    ///< behind "--"
  bool takes_all_words = false;  ///< they are those of another program, and nothing but its program()

  /// The options that follow belong to this section of the help.
  void section(const std::string& title) { section_ = title; }
  /// An option, "--seed", or an argument, "SCENARIO". The variable of its value must outlive the command.
  void add(const std::string& name, OptionValue value, const std::string& description, OptionDetails details = {});
  /// --json, the flag of all commands whose result a machine may read.
  void json(bool& into);
  /// What is to be done with the values, in the order of these calls.
  void finally(std::function<void()> step) { steps_.push_back(std::move(step)); }

  /// Stores all values, and those of environment variables. Throws BadInput for invalid ones, for options that do not
  /// go together, and for two that name one file.
  void take(const Given& given, std::vector<std::string> program, Invocation invocation);

  // After take().
  bool is_given(const std::string& option) const;
  /// The last text of an option that is given.
  const std::string& text(const std::string& option) const { return given_.at(option).back(); }
  /// All texts of an option; none if it is not given.
  std::vector<std::string> texts(const std::string& option) const {
    const auto found = given_.find(option);
    return found == given_.end() ? std::vector<std::string>() : found->second;
  }
  /// Given, or its environment variable is.
  bool has_value(const std::string& option) const;
  std::vector<std::string> given_options() const;
  const std::vector<std::string>& program() const { return program_; }
  const Invocation& invocation() const { return invocation_; }
  /// The files that options name: those to be written, then those to be read.
  const std::vector<NamedFile>& files() const { return files_; }

 private:
  void check(const Rule& rule) const;
  void take_values(const Option& option);
  void note_files(const Option& option, OptionValue::File use);

  std::string section_;
  std::vector<std::function<void()>> steps_;
  Given given_;
  std::vector<std::string> program_;
  Invocation invocation_;
  std::vector<NamedFile> files_;
};

}  // namespace waitpoint::tools
