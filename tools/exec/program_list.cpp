// SPDX-License-Identifier: BSD-3-Clause
#include "tools/exec/program_list.hpp"

#include <algorithm>
#include <filesystem>
#include <tuple>

#include "core/error.hpp"
#include "core/hosting/start_condition.hpp"
#include "tools/exec/program_file.hpp"

namespace waitpoint::tools {
namespace {

constexpr char separator[] = "::";
constexpr std::string_view after = "after:";
constexpr std::size_t letters_max = 32;  // the kernel stores names inline, and uses them as prefixes of thread names

bool fits_names(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
}

// "NAME=FILE": the length of the name; 0 for a word that is only a file.
std::size_t name_letters(const std::string& word) {
  const std::size_t end = word.find('=');
  const bool is_name = end != std::string::npos && end > 0 && end <= letters_max &&
                       std::all_of(word.begin(), word.begin() + static_cast<std::ptrdiff_t>(end), fits_names);
  return is_name && !std::filesystem::exists(word) ? end : 0;
}

std::string name_of_file(const std::string& file) {
  return std::filesystem::path(file).stem().string().substr(0, letters_max);
}

StartCondition condition_of(const std::string& text) {
  StartCondition condition;
  if (!parse(text, condition))
    throw BadInput(
        "exec",
        "expected after:NAME, after:NAME.started, after:tcp:PORT or after:PATH with a '/', got 'after:" + text + "'");
  return condition;
}

}  // namespace

ProgramList::ProgramList(const std::vector<std::string>& words) {
  const bool are_several = std::find(words.begin(), words.end(), separator) != words.end();
  is_session_ = are_several || words.front().starts_with(after) || name_letters(words.front()) > 0;
  read(words);
  name_apart();
  check_conditions();
}

void ProgramList::read(const std::vector<std::string>& words) {
  programs_.emplace_back();
  for (const std::string& word : words) {
    Program& program = programs_.back();
    if (word == separator)
      programs_.emplace_back();
    else if (program.words.empty() && word.starts_with(after))
      program.conditions.push_back(word.substr(after.size()));
    else
      program.words.push_back(word);
  }
  for (std::size_t place = 0; place < programs_.size(); ++place) {
    Program& program = programs_[place];
    program.place = static_cast<int>(place);
    if (program.words.empty())
      throw BadInput(
          "exec", "expected a program on both sides of every '::', found none at place " + std::to_string(place + 1));
    std::string& file = program.words.front();
    if (const std::size_t letters = is_session_ ? name_letters(file) : 0; letters > 0) {
      program.name = file.substr(0, letters);
      program.is_named = true;
      file.erase(0, letters + 1);
    } else {
      program.name =
          is_session_ || is_shared_object(file) ? name_of_file(file) : std::filesystem::path(file).filename().string();
    }
  }
}

// The order of equal programs with equal arguments does not matter.
void ProgramList::name_apart() {
  std::sort(programs_.begin(), programs_.end(), [](const Program& a, const Program& b) {
    return std::tie(a.name, a.words, a.place) < std::tie(b.name, b.words, b.place);
  });
  for (std::size_t i = 0, end = 0; i < programs_.size(); i = end) {
    const std::string name = programs_[i].name;
    while (end < programs_.size() && programs_[end].name == name) ++end;
    if (end - i == 1) continue;
    for (std::size_t k = i; k < end; ++k) {
      if (programs_[k].is_named) throw BadInput("exec", "two programs are called '" + name + "'");
      programs_[k].name += "#" + std::to_string(k - i + 1);
    }
  }
}

void ProgramList::check_conditions() const {
  std::vector<std::vector<StartCondition>> conditions;
  std::vector<ConditionedStart> starts;
  conditions.reserve(programs_.size());
  for (const Program& program : programs_) {
    std::vector<StartCondition>& after = conditions.emplace_back();
    for (const std::string& text : program.conditions) after.push_back(condition_of(text));
    starts.push_back({program.name, after});
  }
  waitpoint::check_conditions(starts, [&](std::size_t refused, const StartCondition* unknown) {
    if (unknown != nullptr)
      throw BadInput("exec", "after:" + in_words(*unknown) + ": there is no program '" + unknown->of + "'");
    throw BadInput("exec", "'" + programs_[refused].name + "' can never start: the conditions after: form a cycle");
  });
}

std::string ProgramList::title() const {
  return programs_.size() == 1 ? programs_.front().name : std::to_string(programs_.size()) + " programs";
}

std::vector<std::string> ProgramList::words_of_session(const std::string& loader, bool quiet) const {
  std::vector<std::string> words;
  if (quiet) words.emplace_back("--quiet");
  for (const Program& program : programs_) {
    if (program.place != programs_.front().place) words.emplace_back(separator);
    words.push_back(program.name);
    words.push_back(std::to_string(program.place));
    for (const std::string& condition : program.conditions) words.push_back(std::string(after).append(condition));
    words.emplace_back("--");
    if (is_shared_object(program.words.front())) words.push_back(loader);
    words.insert(words.end(), program.words.begin(), program.words.end());
  }
  return words;
}

}  // namespace waitpoint::tools
