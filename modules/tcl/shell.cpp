// SPDX-License-Identifier: BSD-3-Clause
#include "modules/tcl/shell.hpp"

#include <filesystem>
#include <mutex>
#include <utility>

namespace waitpoint::tcl {
namespace {

constexpr std::uint32_t seed_of_shells = 1;  // of rand()

}  // namespace

Shell::Shell(genom::NameSpace& names, const Library& library, const std::string& robot, Tell tell)
    : library_(library),
      robot_(robot),
      tell_(std::move(tell)),
      link_(names, robot, "tcl", [this](Time date, const std::string& line) { tell_(date, line, false); },
            {std::filesystem::current_path().string(), "/"}) {}  // a person's own: any file

void Shell::submit(const std::string& command) {
  {
    const std::lock_guard guard(mutex_);
    commands_.push_back(command);
  }
  submitted_.release();
}

void Shell::run() {
  const std::unique_ptr<Interpreter> interpreter = library_.make(link_, seed_of_shells, &threads::now);
  for (;;) {
    submitted_.acquire();
    std::string command;
    {
      const std::lock_guard guard(mutex_);
      command = std::move(commands_.front());
      commands_.pop_front();
    }
    const ScriptEnd outcome = interpreter->evaluate(command);
    tell_(threads::now(), outcome.ok ? outcome.text : "error: " + outcome.text, true);
  }
}

}  // namespace waitpoint::tcl
