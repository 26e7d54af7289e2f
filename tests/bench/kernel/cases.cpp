// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/kernel/cases.hpp"

namespace waitpoint::bench {
namespace {

const char systemc[] = "libsystemc-dev", simgrid[] = "libsimgrid-dev", threads[] = "threads", limit[] = "limit",
           cimba[] = "cimba";

Bound faster_than(const char* whom, double times) { return {"ns", whom, times}; }
Bound within(double times) { return {"ns", limit, times}; }
Bound ns(double most) { return {"ns", "", most}; }

Case sleepers(const char* workload, int tasks, const char* what, std::vector<Bound> musts, std::vector<Bound> aims) {
  return {workload, tasks, what, "ns a wake-up", std::move(musts), std::move(aims)};
}

}  // namespace

const std::vector<Subject>& subjects() {
  static const std::vector<Subject> all = {
      {"waitpoint", "waitpoint", false, 0}, {"limit", limit, false, 0},
      {"systemc", systemc, true, 100'000},  {"simgrid", simgrid, true, 100'000},
      {"cimba", cimba, true, 100'000},      {"boost-fiber", "libboost-fiber-dev", true, 100'000},
      {"threads", threads, true, 100},
  };
  return all;
}

const std::vector<Case>& cases() {
  static const std::vector<Case> all = {
      sleepers("periods", 10, "timed wake-ups", {faster_than(systemc, 3), faster_than(simgrid, 15)}, {within(1.3)}),
      sleepers("periods", 100, "timed wake-ups", {faster_than(systemc, 3), faster_than(simgrid, 15)}, {within(1.3)}),
      sleepers("periods", 1'000, "timed wake-ups", {faster_than(systemc, 5)}, {within(1.3)}),
      sleepers("periods", 10'000, "timed wake-ups", {faster_than(systemc, 8)}, {within(1.3)}),
      sleepers("exponential", 1'000, "increments exponential", {faster_than(systemc, 4)}, {ns(30)}),
      sleepers("exponential", 10'000, "increments exponential", {faster_than(systemc, 6)}, {ns(30)}),
      sleepers("bimodal", 1'000, "increments bimodal", {faster_than(systemc, 4)}, {ns(30)}),
      sleepers("bimodal", 10'000, "increments bimodal", {faster_than(systemc, 6)}, {ns(30)}),
      sleepers("far", 1'000, "1 % far in the future", {faster_than(systemc, 4)}, {ns(30)}),
      sleepers("far", 10'000, "1 % far in the future", {faster_than(systemc, 6)}, {ns(30)}),
      sleepers("harmonic", 1'000, "all due together", {faster_than(systemc, 1), faster_than(simgrid, 8)},
               {faster_than(systemc, 2)}),
      sleepers("common", 1'000, "all due at one instant", {faster_than(systemc, 2)}, {}),
      {"timeouts", 2, "timeouts cancelled", "ns a wait", {faster_than(systemc, 5)}, {ns(15)}},
      {"timeouts", 1'000, "timeouts cancelled", "ns a wait", {faster_than(systemc, 5)}, {ns(15)}},
      {"short timeouts", 1'000, "short timeouts cancelled", "ns a wait", {faster_than(systemc, 5)}, {}},
      {"short timeouts", 10'000, "short timeouts cancelled", "ns a wait", {faster_than(systemc, 5)}, {}},
      sleepers("periods", 100'000, "timed wake-ups", {faster_than(systemc, 10)}, {faster_than(systemc, 25)}),
      sleepers("periods", 1'000'000, "timed wake-ups", {{"resident_gb", "", 6}}, {ns(110)}),
      {"handover",
       2,
       "semaphore hand-over",
       "ns a hand-over",
       {faster_than(systemc, 4), faster_than(threads, 150)},
       {ns(8)}},
      {"mutex",
       8,
       "mutex, sleep inside",
       "ns a locking",
       {faster_than(systemc, 10), {"served_apart", "", 1}},
       {ns(12)}},
      {"buffer", 2, "bounded buffer", "ns an item", {faster_than(systemc, 2), faster_than(threads, 150)}, {ns(7)}},
      {"buffer without mutex", 2, "buffer, no mutex", "ns an item", {}, {}},
      {"free mutex", 1, "free mutex", "ns a lock + unlock", {ns(15)}, {ns(4)}},
      {"parked", 10'000, "parked task", "", {{"bytes", "", 5 * 1024}}, {{"bytes", "", 4.4 * 1024}}},
  };
  return all;
}

}  // namespace waitpoint::bench
