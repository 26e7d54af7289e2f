// SPDX-License-Identifier: BSD-3-Clause
#include "modules/tcl/library/syntax.hpp"

#include <tcl.h>

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <sstream>
#include <string_view>
#include <vector>

namespace waitpoint::tcl {
namespace {

constexpr int depth_max = 100;  // of bodies in bodies; deeper ones are left to Tcl

const char* message_of(int error) {
  switch (error) {
    case TCL_PARSE_QUOTE_EXTRA: return "expected white space after a closing quote";
    case TCL_PARSE_BRACE_EXTRA: return "expected white space after a closing brace";
    case TCL_PARSE_MISSING_BRACE: return "expected a closing brace for this one";
    case TCL_PARSE_MISSING_BRACKET: return "expected a closing bracket for this one";
    case TCL_PARSE_MISSING_PAREN: return "expected a closing parenthesis for this one";
    case TCL_PARSE_MISSING_QUOTE: return "expected a closing quote for this one";
    case TCL_PARSE_MISSING_VAR_BRACE: return "expected a closing brace of a variable's name";
    default: return "expected a command";
  }
}

class Parser {
 public:
  Parser(const std::string& script, ProceduresByName* procedures) : begin_(script.data()), procedures_(procedures) {}

  bool parse(std::string_view text, int depth) {
    while (!text.empty()) {
      Tcl_Parse command;
      if (Tcl_ParseCommand(nullptr, text.data(), static_cast<int>(text.size()), 0, &command) != TCL_OK) {
        error_ = {line_at(command.term != nullptr ? command.term : text.data()), message_of(command.errorType)};
        return false;
      }
      std::vector<std::string_view> words;
      const Tcl_Token* token = command.tokenPtr;
      for (int i = 0; i < command.numWords; ++i, token += token->numComponents + 1)
        words.emplace_back(token->start, static_cast<std::size_t>(token->size));
      const char* const next = command.commandStart + command.commandSize;
      const char* const end = text.data() + text.size();
      Tcl_FreeParse(&command);
      if (!parse_bodies(words, depth)) return false;
      text = next >= end ? std::string_view() : std::string_view(next, static_cast<std::size_t>(end - next));
    }
    return true;
  }
  const SyntaxError& error() const { return error_; }

 private:
  int line_at(const char* place) const { return 1 + static_cast<int>(std::count(begin_, place, '\n')); }

  static bool is_braced(std::string_view word) { return word.size() >= 2 && word.front() == '{'; }
  static std::string_view without_braces(std::string_view word) {
    return is_braced(word) ? word.substr(1, word.size() - 2) : word;
  }

  bool parse_body(std::string_view word, int depth) {
    return !is_braced(word) || depth >= depth_max || parse(without_braces(word), depth + 1);
  }

  bool parse_bodies(const std::vector<std::string_view>& words, int depth) {
    if (words.empty()) return true;
    const std::string_view name = words.front();
    const auto body = [&](std::size_t i) { return i >= words.size() || parse_body(words[i], depth); };
    if (name == "proc" && words.size() == 4) {
      if (procedures_ != nullptr) {
        const std::string name(words[1]);
        (*procedures_)[name] = {name, std::string(without_braces(words[2])), line_at(words[3].data())};
      }
      return body(3);
    }
    if (name == "while" || name == "foreach" || name == "lmap" || name == "catch")
      return name == "catch" ? body(1) : body(words.size() - 1);
    if (name == "for") return body(1) && body(3) && body(4);
    if (name == "namespace" && words.size() == 4 && words[1] == "eval") return body(3);
    if (name != "if") return true;
    for (std::size_t i = 2; i < words.size(); ++i) {
      if (words[i] == "then" || words[i] == "else") continue;
      if (words[i] == "elseif")
        ++i;  // skips the condition, which follows
      else if (!body(i))
        return false;
    }
    return true;
  }

  const char* begin_;
  ProceduresByName* procedures_;
  SyntaxError error_;
};

/// The elements of a list of Tcl; nothing if it is none.
std::optional<std::vector<std::string>> elements_of(const std::string& list) {
  int count = 0;
  const char** elements = nullptr;
  if (Tcl_SplitList(nullptr, list.c_str(), &count, &elements) != TCL_OK) return std::nullopt;
  std::vector<std::string> all(elements, elements + count);
  Tcl_Free(reinterpret_cast<char*>(elements));
  return all;
}

/// The numbers of words that a procedure takes, and its usage as Tcl tells it.
struct Signature {
  std::size_t least = 0, most = 0;
  std::string usage;
};

std::optional<Signature> signature_of(const Procedure& procedure) {
  const auto parameters = elements_of(procedure.parameters);
  if (!parameters) return std::nullopt;
  Signature signature{0, parameters->size(), procedure.name};
  for (std::size_t i = 0; i < parameters->size(); ++i) {
    const std::string& parameter = (*parameters)[i];
    const bool is_rest = parameter == "args" && i + 1 == parameters->size();
    const auto parts = elements_of(parameter);
    const bool is_optional = parts && parts->size() == 2;
    if (is_rest)
      signature.most = std::numeric_limits<std::size_t>::max();
    else if (!is_optional)
      ++signature.least;
    signature.usage += is_rest ? " ?arg ...?" : is_optional ? " ?" + parts->front() + "?" : " " + parameter;
  }
  return signature;
}

// The number in "(procedure "NAME" line 3)" or "("foreach" body line 2)"; 0 if there is none.
int line_in(std::string_view level) {
  constexpr std::string_view before = " line ";
  const std::size_t at = level.rfind(before);
  if (at == std::string_view::npos || !level.ends_with(')')) return 0;
  return std::atoi(std::string(level.substr(at + before.size())).c_str());
}

}  // namespace

std::optional<SyntaxError> check_syntax(const std::string& script, ProceduresByName* procedures) {
  Parser parser(script, procedures);
  if (parser.parse(script, 0)) return std::nullopt;
  return parser.error();
}

std::string check_call(const Procedure& procedure, const std::string& arguments) {
  const std::string call = procedure.name + " " + arguments;
  Tcl_Parse command;
  if (Tcl_ParseCommand(nullptr, call.data(), static_cast<int>(call.size()), 0, &command) != TCL_OK)
    return message_of(command.errorType);
  bool expands = false;
  const Tcl_Token* token = command.tokenPtr;
  for (int i = 0; i < command.numWords; ++i, token += token->numComponents + 1)
    expands = expands || token->type == TCL_TOKEN_EXPAND_WORD;
  const auto words = static_cast<std::size_t>(command.numWords - 1);
  const bool is_all = command.commandStart + command.commandSize == call.data() + call.size();
  Tcl_FreeParse(&command);
  if (!is_all) return "expected one command, found '" + call + "'";
  const auto signature = signature_of(procedure);
  if (expands || !signature || (words >= signature->least && words <= signature->most)) return "";
  return "wrong # args: should be \"" + signature->usage + "\"";
}

int line_of_error(const std::string& trace, int line, const ProceduresByName& procedures) {
  std::istringstream levels(trace);
  int beyond = 0;
  for (std::string level; std::getline(levels, level);) {
    const std::size_t start = level.find_first_not_of(' ');
    if (start == 0 || start == std::string::npos || level[start] != '(') continue;
    const int in_body = line_in(level);
    if (in_body == 0) continue;
    constexpr std::string_view procedure = "(procedure \"";
    if (!std::string_view(level).substr(start).starts_with(procedure)) {
      beyond += in_body - 1;
      continue;
    }
    const std::size_t from = start + procedure.size();
    const auto found = procedures.find(level.substr(from, level.find('"', from) - from));
    if (found != procedures.end()) return found->second.line + in_body - 1 + beyond;
    beyond = 0;  // a procedure of another file
  }
  return line + beyond;
}

}  // namespace waitpoint::tcl
