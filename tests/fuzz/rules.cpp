// SPDX-License-Identifier: BSD-3-Clause
// Rules of execution control: read, compiled, searched for contradictions, and evaluated for some steps.
#include <cstddef>
#include <cstdint>
#include <string>

#include "modules/control/contradictions.hpp"
#include "modules/control/parser.hpp"
#include "tests/fuzz/refusal.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace waitpoint::control;
  const std::string contents(reinterpret_cast<const char*>(data), size);
  waitpoint::fuzz::reads_or_refuses([&] {
    const Rules rules = parse_rules(contents, "rules");
    const Automaton automaton(rules);
    check_contradictions(rules, automaton);
    std::vector<bool> values = automaton.initial_values();
    for (std::size_t step = 0; step < size && step < 4; ++step) {
      for (std::size_t v = 0; v < values.size(); ++v)
        if (automaton.predicates()[v].kind != Predicate::Kind::memory) values[v] = (data[step] >> (v % 8) & 1) != 0;
      for (std::size_t i = 0; i < automaton.checks(); ++i) automaton.is_forbidden(i, values);
      automaton.remember(values);
    }
  });
  return 0;
}
