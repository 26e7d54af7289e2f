// SPDX-License-Identifier: BSD-3-Clause
// Stores failures, or replays those stored by another program built from the same code: `./dev test --replays`.
//
//   zoo-failures store FILE [SEEDS]    stores the portfolio's failures of each specimen, for SEEDS seeds (default: 15)
//   zoo-failures replay FILE           counts the replays equal to the stored runs; status 1 unless all are
//
// A line is "TOKEN DIGEST NAME": one with seed and number, and one with the choices, if they fit into a token.
#include <cinttypes>
#include <cstdio>
#include <fstream>
#include <sstream>
#include <string>

#include "core/error.hpp"
#include "core/number_text.hpp"
#include "fibers/explore/schedules/token.hpp"
#include "tests/zoo/search.hpp"
#include "tests/zoo/zoo.hpp"

namespace waitpoint::zoo {
namespace {

using exploration::Token;

constexpr std::uint64_t schedules_max = 10'000;

void store(const std::string& file, std::uint64_t seeds) {
  std::ofstream out(file);
  std::uint64_t failures = 0;
  for (const Specimen& specimen : specimens()) {
    Search search(specimen.buggy);
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
      const auto found = search.find("portfolio", seed, schedules_max);
      if (!found) continue;
      ++failures;
      const exploration::Finding& failure = found->failure;
      const auto line = [&](const Token& token) {
        const std::string text = to_text(token);
        char digest[17];
        std::snprintf(digest, sizeof digest, "%016" PRIx64, failure.digest);
        if (text.size() <= exploration::token_length_max) out << text << ' ' << digest << ' ' << specimen.name << '\n';
      };
      const std::uint32_t digest = exploration::token_digest(failure.digest);
      line({1, digest, "portfolio", seed, found->schedules - 1, {}});
      line({1, digest, "", 0, 0, failure.deviations});
    }
  }
  if (!out.flush()) throw BadInput(file, "cannot be written");
  std::printf("%" PRIu64 " failures stored\n", failures);
}

bool replay(const std::string& file) {
  std::ifstream in(file);
  if (!in) throw BadInput(file, "cannot be read");
  std::uint64_t replays = 0, same = 0;
  for (std::string line; std::getline(in, line); ++replays) {
    std::istringstream words(line);
    std::string name, token;
    std::uint64_t digest = 0;
    words >> token >> std::hex >> digest >> std::ws;
    std::getline(words, name);
    for (const Specimen& specimen : specimens()) {
      if (specimen.name != name) continue;
      const exploration::RunVerdict verdict = Search(specimen.buggy).play(exploration::read_token(token));
      const bool is_same = verdict.digest == digest && !verdict.passed();
      same += is_same;
      if (!is_same) std::printf("another run: %s\n", line.c_str());
    }
  }
  std::printf("%" PRIu64 " of %" PRIu64 " replays came to the same run\n", same, replays);
  return replays > 0 && same == replays;
}

int main(int count, char** words) {
  const std::string verb = count > 2 ? words[1] : "";
  std::uint64_t seeds = 15;
  if (verb == "store" && (count == 3 || (count == 4 && parse_number(words[3], seeds))))
    return store(words[2], seeds), 0;
  if (verb == "replay" && count == 3) return replay(words[2]) ? 0 : 1;
  std::fprintf(stderr, "zoo-failures: expected store FILE [SEEDS], or replay FILE\n");
  return 2;
}

}  // namespace
}  // namespace waitpoint::zoo

int main(int count, char** words) {
  try {
    return waitpoint::zoo::main(count, words);
  } catch (const waitpoint::BadInput& error) {
    std::fprintf(stderr, "zoo-failures: %s\n", error.what());
    return 2;
  }
}
