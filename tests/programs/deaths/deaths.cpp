// SPDX-License-Identifier: BSD-3-Clause
// A module that ends the process, or holds up the run, in its codel at 0.3 s: all ways in which `waitpoint run` must
// still say what happened. The setting `end` selects one.
#include <unistd.h>

#include <cassert>
#include <csignal>
#include <cstdlib>
#include <map>
#include <mutex>
#include <stdexcept>
#include <string>
#include <waitpoint/modules/genom/module.hpp>
#include <waitpoint/tools/main.hpp>

using namespace std::chrono_literals;

namespace {

volatile int zero = 0;
int* volatile nowhere = reinterpret_cast<int*>(64);
std::mutex of_the_system;

[[gnu::noinline]] void fail_an_assertion() { assert(zero != 0); }
[[gnu::noinline]] void divide() { zero = 100 / zero; }
[[gnu::noinline]] void write_nowhere() { *nowhere = 1; }
[[gnu::noinline]] void throw_out_of_noexcept() noexcept { throw std::logic_error("nobody catches this"); }
[[gnu::noinline]] void spin() {
  while (zero == 0) {
  }
}
[[gnu::noinline]] void free_twice() {
  void* volatile block = std::malloc(2000);
  void* volatile next = std::malloc(2000);
  std::free(block);
  std::free(next);
  std::free(next);
}

void die(const std::string& way) {
  static const std::map<std::string, void (*)()> ways = {
      {"abort", [] { std::abort(); }},
      {"assert", fail_an_assertion},
      {"terminate", throw_out_of_noexcept},
      {"illegal", [] { __builtin_trap(); }},
      {"division", divide},
      {"address", write_nowhere},
      {"heap", free_twice},
      {"exit", [] { std::exit(0); }},
      {"_exit", [] { _exit(0); }},
      {"exception", [] { throw std::runtime_error("out of the codel"); }},
      {"loop", spin},
      {"lock",
       [] {
         of_the_system.lock();
         of_the_system.lock();
       }},
  };
  if (const auto found = ways.find(way); found != ways.end()) found->second();
}

struct Parameters {
  std::string end = "none";
  static void fields(auto field) { field("end", &Parameters::end); }
};

class Mortal : public waitpoint::genom::Module {
 public:
  explicit Mortal(waitpoint::genom::ModuleSetup& setup)
      : Module(setup, 42), task_(add_task("main", {.period_ms = 100ms})) {
    setup.settings.read(parameters_);
    if (parameters_.end == "constructor throws") throw std::runtime_error("no such device");
    if (parameters_.end == "constructor crashes") write_nowhere();
    task_.set_permanent([this] {
      if (++periods_ == 3) die(parameters_.end);
    });
  }
  ~Mortal() {
    if (parameters_.end == "destructor crashes") write_nowhere();
  }

 private:
  Parameters parameters_;
  waitpoint::genom::ExecutionTask& task_;
  int periods_ = 0;
};

}  // namespace

int main(int argc, char** argv) {
  return waitpoint::main(argc, argv, {waitpoint::genom::module_type<Mortal>("mortal")});
}
