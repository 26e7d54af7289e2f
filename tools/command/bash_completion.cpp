// SPDX-License-Identifier: BSD-3-Clause
#include "tools/command/completion.hpp"
#include "tools/command/help_text.hpp"

namespace waitpoint::tools {
namespace {

// The function's beginning: $word is to be completed, $command is given, $option is the option that $word belongs to.
// Bash splits "--strategy=fifo" at the '='.
constexpr const char* beginning = R"(
  local word=${COMP_WORDS[COMP_CWORD]} option=${COMP_WORDS[COMP_CWORD-1]} command='' dashes=0 i
  if [[ $word == = ]]; then
    word=''
  elif [[ $option == = ]]; then
    option=${COMP_WORDS[COMP_CWORD-2]}
  fi
  for ((i = 1; i < COMP_CWORD; i++)); do
    if [[ ${COMP_WORDS[i]} == -- ]]; then
      dashes=$i
      break
    fi
    [[ -n $command || ${COMP_WORDS[i]} == -* ]] || command=${COMP_WORDS[i]}
  done
  local words='' kind='' options='' argument='' argument_words='' is_optional=''
)";

constexpr const char* ending = R"(
  local -a found=()
  if ((dashes)); then
    kind=files
    if ((COMP_CWORD == dashes + 1)); then kind=program; fi
  elif [[ -n $words$kind && ! ($is_optional && $word == -*) ]]; then
    :
  elif [[ $word == -* ]]; then
    words=$options kind=words
  else
    words=$argument_words kind=$argument
  fi
  case $kind in
    files) mapfile -t found < <(compgen -f -- "$word") ;;
    folders) mapfile -t found < <(compgen -d -- "$word") ;;
    program) mapfile -t found < <(compgen -c -- "$word"; compgen -f -- "$word") ;;
    scenarios)
      local program shipped
      program=$(type -P "${COMP_WORDS[0]}")
      mapfile -t found < <(compgen -f -X '!*.yaml' -- "$word"; compgen -d -- "$word")
      # Only a name without a folder is looked for among the installed ones.
      for shipped in "${program%/*}"/../share/waitpoint/scenarios/*.yaml; do
        shipped=${shipped##*/}
        if [[ $shipped != '*.yaml' && $shipped == "$word"* ]]; then found+=("$shipped"); fi
      done
      ;;
  esac
  COMPREPLY=($(compgen -W "$words" -- "$word"))
  if ((${#found[@]})); then
    COMPREPLY+=("${found[@]}")
    compopt -o filenames 2>/dev/null
  fi
)";

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : " ") + word;
  return text;
}

const char* kind_of(const OfferedValues& offered) {
  switch (offered.files) {
    case OfferedValues::Files::all: return "files";
    case OfferedValues::Files::folders: return "folders";
    case OfferedValues::Files::scenarios: return "scenarios";
    case OfferedValues::Files::none: break;
  }
  return "words";  // none of them: nothing is offered
}

std::string command_names(const DeclaredProgram& program) {
  std::vector<std::string> names;
  for (const auto& command : program.commands) names.push_back(command->name);
  return joined(names);
}

std::string options_line(const Command& command) {
  std::vector<std::string> names = {"-h"};
  for (const auto& options : {help_options(), command.options})
    for (const Option& option : options) names.push_back(option.name);
  if (command.takes_program) names.emplace_back("--");
  return "    " + (command.name.empty() ? "''" : command.name) + ") options='" + joined(names) + "'";
}

}  // namespace

std::string bash_completion(const DeclaredProgram& program) {
  const std::string commands = command_names(program);
  std::string arguments = options_line(program.own) + " argument=words argument_words='" + commands + "' ;;\n", values;
  for (const auto& command : program.commands) {
    arguments += options_line(*command);
    if (!command->arguments.empty()) {
      const OfferedValues offered = offered_values(command->arguments.front());
      arguments += std::string(" argument=") + kind_of(offered) + " argument_words='" +
                   (offered.commands ? commands : joined(offered.words)) + "'";
    }
    arguments += " ;;\n";
    for (const Option& option : command->options) {
      if (option.value.is_flag) continue;
      const OfferedValues offered = offered_values(option);
      values += "    '" + command->name + " " + option.name + "') kind=" + kind_of(offered) + " words='" +
                joined(offered.words) + "'" + (option.value.omitted.empty() ? "" : " is_optional=1") + " ;;\n";
    }
  }
  return "# Completion of waitpoint for bash; written by `waitpoint completion bash`.\n_waitpoint() {" +
         (beginning + ("  case $command in\n" + arguments)) + "  esac\n  case \"$command $option\" in\n" + values +
         "  esac" + ending + "}\ncomplete -F _waitpoint waitpoint\n";
}

}  // namespace waitpoint::tools
