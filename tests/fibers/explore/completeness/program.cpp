// SPDX-License-Identifier: BSD-3-Clause
#include "tests/fibers/explore/completeness/program.hpp"

#include <algorithm>

#include "core/error.hpp"

namespace waitpoint::completeness {
namespace {

constexpr std::string_view letters = "cjlLtuwWnbaAqrvgpfxzsek";

bool is_digit(char letter) { return letter >= '0' && letter <= '9'; }
std::uint8_t digit(char letter) { return static_cast<std::uint8_t>(letter - '0'); }

bool is_about_thread(const Instruction& instruction) {
  return instruction.step == Step::create || instruction.step == Step::join;
}

// True if the object exists: another thread, or one of the objects of its kind.
bool is_valid(const Instruction& instruction, std::size_t threads) {
  if (is_about_thread(instruction)) return instruction.object > 0 && instruction.object < threads;
  const bool is_timed =
      instruction.step == Step::lock_for || instruction.step == Step::wait_for || instruction.step == Step::acquire_for;
  return instruction.object < objects && (!is_timed || instruction.operand > 0);
}

Program without_thread(const Program& program, std::size_t which) {
  Program less = program;
  less.threads.erase(less.threads.begin() + static_cast<std::ptrdiff_t>(which));
  for (std::vector<Instruction>& thread : less.threads) {
    std::erase_if(thread, [&](const Instruction& instruction) {
      return is_about_thread(instruction) && instruction.object == which;
    });
    for (Instruction& instruction : thread)
      if (is_about_thread(instruction) && instruction.object > which) --instruction.object;
  }
  return less;
}

}  // namespace

std::size_t Program::size() const {
  std::size_t sum = 0;
  for (const std::vector<Instruction>& thread : threads) sum += thread.size();
  return sum;
}

std::string to_text(const Program& program) {
  std::string text;
  for (const std::uint8_t units : program.units) text += std::to_string(units);
  for (const std::vector<Instruction>& thread : program.threads) {
    text += '|';
    for (const Instruction& instruction : thread) {
      if (text.back() != '|') text += ' ';
      text += static_cast<char>(instruction.step) + std::to_string(instruction.object) +
              std::to_string(instruction.operand);
    }
  }
  return text;
}

Program read_program(std::string_view text) {
  const auto refused = [text] {
    return BadInput("program", "expected a text such as '01|c10 g00|p02', found '" + std::string(text) + "'");
  };
  Program program;
  if (text.size() <= objects || !std::all_of(text.begin(), text.begin() + objects, is_digit)) throw refused();
  for (std::size_t i = 0; i < objects; ++i) program.units[i] = digit(text[i]);
  for (std::size_t at = objects; at < text.size();) {
    if (text[at] == '|') program.threads.emplace_back();
    if (program.threads.empty() || (text[at] != '|' && text[at] != ' ')) throw refused();
    ++at;
    if (at == text.size() || text[at] == '|') continue;
    if (at + 3 > text.size() || letters.find(text[at]) == letters.npos || !is_digit(text[at + 1]) ||
        !is_digit(text[at + 2]))
      throw refused();
    program.threads.back().push_back({static_cast<Step>(text[at]), digit(text[at + 1]), digit(text[at + 2])});
    at += 3;
  }
  if (program.threads.size() > threads_max) throw refused();
  std::size_t created[threads_max] = {};
  for (const std::vector<Instruction>& thread : program.threads)
    for (const Instruction& instruction : thread) {
      if (!is_valid(instruction, program.threads.size())) throw refused();
      if (instruction.step == Step::create && ++created[instruction.object] > 1) throw refused();
    }
  return program;
}

std::vector<Program> smaller(const Program& program) {
  std::vector<Program> all;
  for (std::size_t i = 1; i < program.threads.size(); ++i) all.push_back(without_thread(program, i));
  for (std::size_t i = 0; i < program.threads.size(); ++i)
    for (std::size_t k = 0; k < program.threads[i].size(); ++k) {
      Program& less = all.emplace_back(program);
      less.threads[i].erase(less.threads[i].begin() + static_cast<std::ptrdiff_t>(k));
    }
  for (std::size_t i = 0; i < objects; ++i) {
    if (program.units[i] == 0) continue;
    --all.emplace_back(program).units[i];
  }
  return all;
}

}  // namespace waitpoint::completeness
