// SPDX-License-Identifier: BSD-3-Clause
#include "modules/tcl/library/surroundings.hpp"

#include <cmath>
#include <string>

#include "core/exact_math.hpp"
#include "modules/tcl/library/guarded_commands.hpp"

namespace waitpoint::tcl {
namespace {

constexpr std::int64_t ns_per_s = 1'000'000'000, ns_per_us = 1'000;

Time (*clock_of_task)() = nullptr;

void get_time(Tcl_Time* time, ClientData) {
  const std::int64_t ns = clock_of_task().since_start().ns();
  time->sec = static_cast<long>(ns / ns_per_s);
  time->usec = static_cast<long>(ns % ns_per_s / ns_per_us);
}
void scale_time(Tcl_Time*, ClientData) {}

// The interpreters' commands have their own events (task_interpreter.hpp): Tcl's own are never waited for.
Tcl_NotifierProcs without_events() {
  Tcl_NotifierProcs procs{};
  procs.setTimerProc = [](CONST86 Tcl_Time*) {};
  procs.waitForEventProc = [](CONST86 Tcl_Time*) { return -1; };
  procs.createFileHandlerProc = [](int, int, Tcl_FileProc*, ClientData) {};
  procs.deleteFileHandlerProc = [](int) {};
  procs.initNotifierProc = []() -> ClientData { return nullptr; };
  procs.finalizeNotifierProc = [](ClientData) {};
  procs.alertNotifierProc = [](ClientData) {};
  procs.serviceModeHookProc = [](int) {};
  return procs;
}

struct Function {
  const char* name;
  int arguments;
  double least, most;  // of the arguments
  double (*of)(double x, double y);
};

constexpr double all = 1e300, angles = 1e6;

double half_circle(double x) { return std::sqrt(1 - x * x); }

constexpr double ln_10 = 2.302585092994046;

// Those of libm differ between its versions and processors.
constexpr Function functions[] = {
    {"sin", 1, -angles, angles, [](double x, double) { return exact::sincos(x).sin; }},
    {"cos", 1, -angles, angles, [](double x, double) { return exact::sincos(x).cos; }},
    {"tan", 1, -angles, angles, [](double x, double) { return exact::sincos(x).sin / exact::sincos(x).cos; }},
    {"atan", 1, -all, all, [](double x, double) { return exact::atan2(x, 1); }},
    {"asin", 1, -1, 1, [](double x, double) { return exact::atan2(x, half_circle(x)); }},
    {"acos", 1, -1, 1, [](double x, double) { return exact::atan2(half_circle(x), x); }},
    {"atan2", 2, -all, all, [](double y, double x) { return exact::atan2(y, x); }},
    {"exp", 1, -700, 700, [](double x, double) { return exact::exp(x); }},
    {"log", 1, 1e-300, all, [](double x, double) { return exact::log(x); }},
    {"log10", 1, 1e-300, all, [](double x, double) { return exact::log(x) / ln_10; }},
    {"hypot", 2, -all, all, [](double x, double y) { return exact::hypot(x, y); }},
};

int call_function(ClientData data, Tcl_Interp* tcl, int count, Tcl_Obj* const* words) {
  const auto& function = *static_cast<const Function*>(data);
  if (count != function.arguments + 1) {
    Tcl_WrongNumArgs(tcl, 1, words, function.arguments == 1 ? "x" : "x y");
    return TCL_ERROR;
  }
  double values[2] = {};
  for (int i = 0; i < function.arguments; ++i) {
    if (Tcl_GetDoubleFromObj(tcl, words[i + 1], &values[i]) != TCL_OK) return TCL_ERROR;
    if (values[i] >= function.least && values[i] <= function.most) continue;
    Tcl_SetObjResult(tcl, Tcl_NewStringObj("domain error: argument not in valid range", -1));
    return TCL_ERROR;
  }
  Tcl_SetObjResult(tcl, Tcl_NewDoubleObj(function.of(values[0], values[1])));
  return TCL_OK;
}

// While it is not yet safe.
constexpr const char* process_script = "encoding system utf-8";
constexpr const char* script = R"(
  array set ::env {TZ :UTC}
  proc ::tcl::clock::getenv {name} { expr {$name eq {TZ} ? {:UTC} : {}} }  ;# of Tcl in C: the process's
  set ::auto_path [list $::tcl_library]
  foreach name {sinh cosh tanh pow} { rename ::tcl::mathfunc::$name {} }
  rename ::puts ::waitpoint::puts_to_channel
)";

}  // namespace

void set_up_process(Time (*now)()) {
  clock_of_task = now;
  static bool is_done = false;
  if (is_done) return;
  is_done = true;
  Tcl_NotifierProcs procs = without_events();
  Tcl_SetNotifier(&procs);
  Tcl_SetTimeProc(get_time, scale_time, nullptr);
  Tcl_FindExecutable(nullptr);
}

void set_up_interpreter(Tcl_Interp* tcl, std::uint32_t seed, RobotLink& link) {
  Tcl_CreateNamespace(tcl, "::waitpoint", nullptr, nullptr);
  Tcl_Eval(tcl, process_script);
  guard_commands(tcl, link);
  Tcl_Eval(tcl, script);
  for (const Function& function : functions)
    Tcl_CreateObjCommand(tcl, (std::string("::tcl::mathfunc::") + function.name).c_str(), call_function,
                         const_cast<Function*>(&function), nullptr);
  set_seed(tcl, seed);
}

// Tcl keeps it where only a script can reach it: the state of the script that is under way is put aside.
void set_seed(Tcl_Interp* tcl, std::uint32_t seed) {
  // From 1 to 2^31 - 2.
  constexpr std::uint32_t seeds = 2147483646;
  const Tcl_InterpState state = Tcl_SaveInterpState(tcl, TCL_OK);
  Tcl_Eval(tcl, ("::tcl::mathfunc::srand " + std::to_string(1 + seed % seeds)).c_str());
  Tcl_RestoreInterpState(tcl, state);
}

}  // namespace waitpoint::tcl
