// SPDX-License-Identifier: BSD-3-Clause
// A module that changes state of the process, and another robot's whose times follow from floating-point numbers, and,
// on request, from a format of std::cout, which it should not read.
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <xmmintrin.h>

#include <cfenv>
#include <cfloat>
#include <clocale>
#include <csignal>
#include <cstdlib>
#include <functional>
#include <iostream>
#include <map>
#include <string>
#include <waitpoint/fibers/sync/threads.hpp>
#include <waitpoint/modules/genom/module.hpp>
#include <waitpoint/tools/main.hpp>

using namespace std::chrono_literals;

namespace {

void flush_to_zero() { _mm_setcsr(_mm_getcsr() | 0x8040); }

const std::map<std::string, std::function<void()>> changes = {
    {"rounding", [] { std::fesetround(FE_UPWARD); }},
    {"flushing", flush_to_zero},
    {"exceptions", [] { feenableexcept(FE_DIVBYZERO | FE_INVALID | FE_OVERFLOW); }},
    {"locale", [] { std::setlocale(LC_ALL, "C.UTF-8"); }},
    {"locale of C++", [] { std::locale::global(std::locale("C.UTF-8")); }},
    {"mask",
     [] {
       sigset_t all;
       sigfillset(&all);
       pthread_sigmask(SIG_SETMASK, &all, nullptr);
     }},
    {"closed output", [] { close(STDOUT_FILENO); }},
    {"other output", [] { dup2(open("/dev/null", O_WRONLY), STDOUT_FILENO); }},
    {"format", [] { std::cout.precision(2), std::cerr << std::hex; }},
    {"buffer", [] { std::cout.rdbuf(nullptr); }},
    {"folder", [] { (void)!chdir("/"); }},
    {"permissions", [] { umask(0777); }},
};

void change(const std::string& what) {
  if (const auto found = changes.find(what); found != changes.end()) found->second();
}

// A library's constructor, as of those that are built with -ffast-math.
[[gnu::constructor]] void begin() {
  if (std::getenv("MEDDLING_EARLY") != nullptr) flush_to_zero();
}

struct Parameters {
  std::string change = "none", place = "constructor";
  static void fields(auto field) {
    field("change", &Parameters::change);
    field("place", &Parameters::place);
  }
};

class Meddler : public waitpoint::genom::Module {
 public:
  explicit Meddler(waitpoint::genom::ModuleSetup& setup)
      : Module(setup, 42), task_(add_task("main", {.period_ms = 100ms})) {
    setup.settings.read(parameters_);
    task_.set_permanent([this] { meddle("codel"); });
    meddle("constructor");
    if (parameters_.place == "throwing constructor") {
      change(parameters_.change);
      throw std::runtime_error("no such device");
    }
  }
  ~Meddler() { meddle("destructor"); }

 private:
  void meddle(const std::string& place) const {
    if (parameters_.place == place) change(parameters_.change);
  }

  Parameters parameters_;
  waitpoint::genom::ExecutionTask& task_;
};

struct ComputerParameters {
  bool reads_format = false;
  static void fields(auto field) { field("reads_format", &ComputerParameters::reads_format); }
};

class Computer : public waitpoint::genom::Module {
 public:
  explicit Computer(waitpoint::genom::ModuleSetup& setup)
      : Module(setup, 43), task_(add_task("main", {.period_ms = 100ms})) {
    setup.settings.read(parameters_);
    task_.set_permanent([this] { compute(); });
  }

 private:
  // Another rounding or flushing gives another sum, and so another time.
  void compute() const {
    volatile double sum = 0, small = DBL_MIN, zero = 0;
    for (int i = 0; i < 1000; ++i) sum = sum + 0.1;
    const bool is_flushed = small / 2 == 0;
    const bool is_infinite = 1 / zero > DBL_MAX;
    auto ns = static_cast<std::int64_t>(sum * 1e16) % 1000 + (is_flushed ? 1000 : 0) + (is_infinite ? 1 : 0);
    if (parameters_.reads_format) ns += 10000 * std::cout.precision();
    waitpoint::threads::compute(waitpoint::Duration::from_ns(ns));
  }

  ComputerParameters parameters_;
  waitpoint::genom::ExecutionTask& task_;
};

}  // namespace

int main(int argc, char** argv) {
  return waitpoint::main(
      argc, argv,
      {waitpoint::genom::module_type<Meddler>("meddler"), waitpoint::genom::module_type<Computer>("computer")});
}
