// SPDX-License-Identifier: BSD-3-Clause
#include "tools/exec/program_list.hpp"

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <new>
#include <tuple>

#include "core/error.hpp"
#include "tools/exec/program_file.hpp"

namespace waitpoint::tools {
namespace {

constexpr char separator[] = "::";
constexpr char host_name[] = "waitpoint-host";
constexpr std::size_t letters_max = 32;     // the kernel stores names inline, and uses them as prefixes of thread names
constexpr std::size_t told_apart_max = 20;  // limit of programs whose exit statuses are listed one by one

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

}  // namespace

ProgramList::ProgramList(const std::vector<std::string>& words) {
  const bool several = std::find(words.begin(), words.end(), separator) != words.end();
  if (several || name_letters(words.front()) > 0 || is_shared_object(words.front())) {
    read_several(words);
    return;
  }
  words_ = words;
  title_ = std::filesystem::path(words.front()).filename().string();
}

void ProgramList::read_several(const std::vector<std::string>& words) {
  programs_.emplace_back();
  for (const std::string& word : words) {
    if (word == separator)
      programs_.emplace_back();
    else
      programs_.back().words.push_back(word);
  }
  for (std::uint32_t place = 0; place < size(); ++place) {
    Program& program = programs_[place];
    program.place = place;
    if (program.words.empty())
      throw BadInput(
          "exec", "expected a program on both sides of every '::', found none at place " + std::to_string(place + 1));
    std::string& file = program.words.front();
    if (const std::size_t letters = name_letters(file); letters > 0) {
      program.name = file.substr(0, letters);
      program.is_named = true;
      file.erase(0, letters + 1);
    } else {
      program.name = name_of_file(file);
    }
  }
  name_apart();
  words_ = {host_name};
  for (const Program& program : programs_) {
    if (words_.size() > 1) words_.push_back(separator);
    words_.insert(words_.end(), program.words.begin(), program.words.end());
  }
  title_ = size() == 1 ? programs_.front().name : std::to_string(size()) + " programs";
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

std::vector<std::string> ProgramList::files() const {
  std::vector<std::string> files;
  for (const Program& program : programs_) files.push_back(program.words.front());
  return files;
}

void ProgramList::write(posix::Record& record) const {
  if (programs_.empty()) return;
  void* const memory = record.arena.take(programs_.size() * sizeof(posix::ProgramRecord));
  record.programs = static_cast<posix::ProgramRecord*>(memory);
  record.program_count = size();
  for (std::uint32_t i = 0; i < size(); ++i) {
    posix::ProgramRecord& program = *new (record.programs + i) posix::ProgramRecord();
    std::strncpy(program.name, programs_[i].name.c_str(), sizeof program.name - 1);
    program.place = programs_[i].place;
  }
}

std::string ends_of_programs(const posix::Record& record) {
  const bool told_apart = record.program_count <= told_apart_max;
  std::string text;
  std::uint32_t good = 0;
  for (const posix::ProgramRecord& program : record.several()) {
    const bool is_good = program.ended && program.status == 0;
    if (is_good) ++good;
    if (is_good && !told_apart) continue;
    text += (text.empty() ? "" : ", ") + std::string(program.name) + " " +
            (program.ended ? std::to_string(program.status) : "none");
  }
  if (told_apart) return "exit status: " + text;
  const std::string all = good == record.program_count ? "all " : "";
  return "exit status: 0 of " + all + std::to_string(good) + (text.empty() ? "" : ", ") + text;
}

std::string program_of_last_turn(const posix::Record& record) {
  for (const posix::ProgramRecord& program : record.several())
    if (record.scheduler.digest_in_use() == &program.robot.digest) return program.name;
  return "";
}

}  // namespace waitpoint::tools
