// SPDX-License-Identifier: BSD-3-Clause
// A change that makes the valid scenario invalid, and the error that it gives.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>

#include "modules/scenario/scenario_reader.hpp"
#include "tests/modules/scenario/scenario_text.hpp"

namespace waitpoint::scenario {

struct BadCase {
  std::string name, from, to;
  int line;
  std::string expected;  ///< FILE and FOLDER stand for the scenario's
};

inline std::string with_paths(std::string message, const std::filesystem::path& file) {
  for (const auto& [word, path] : {std::pair("FILE", file), std::pair("FOLDER", file.parent_path())}) {
    const std::size_t at = message.find(word);
    if (at != std::string::npos) message.replace(at, std::string_view(word).size(), path.string());
  }
  return message;
}

/// Reading the changed scenario gives an error of one line, with file, line and the expected value.
inline void expect_complaint(const BadCase& bad) {
  const TemporaryFolder folder;
  const auto file = folder.write("s.yaml", changed(bad.from, bad.to));
  EXPECT_EQ(message_of<BadInput>([&] { read_scenario(file); }),
            file.string() + ":" + std::to_string(bad.line) + ": " + with_paths(bad.expected, file));
}

}  // namespace waitpoint::scenario
