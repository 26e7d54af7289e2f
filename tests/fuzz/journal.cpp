// SPDX-License-Identifier: BSD-3-Clause
// Journals of interventions. Inputs lack the head, which names the run.
#include <cstddef>
#include <cstdint>
#include <string>

#include "modules/run/journal.hpp"
#include "tests/fuzz/input_folder.hpp"
#include "tests/fuzz/refusal.hpp"

using namespace waitpoint;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const fuzz::InputFolder folder;
  static const run::JournalHead head = {"office", Digest(1), 1, kernel::Order::fifo};
  std::string contents(reinterpret_cast<const char*>(data), size);
  // One in 256 inputs has a head of its own.
  if (size == 0 || data[0] != 0) contents.insert(0, to_text(head));
  const std::filesystem::path file = folder.file("journal", contents);
  fuzz::reads_or_refuses([&] {
    for (const run::DatedIntervention& read : run::read_journal(file, head).interventions)
      to_text(read.date, read.intervention);
  });
  return 0;
}
