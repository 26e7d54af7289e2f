// SPDX-License-Identifier: BSD-3-Clause
// The digests in the documents are those of the commands that they show.
#include <gtest/gtest.h>

#include <fstream>

#include "tests/project.hpp"
#include "tests/runs/program.hpp"
#include "tests/tools/folder.hpp"

namespace waitpoint::runs {
namespace {

std::string text_of(const std::string& document) {
  std::ifstream file(test::project_root() / document);
  return {std::istreambuf_iterator<char>(file), {}};
}

void expect_shown(const std::string& document, const std::string& scenario, const std::string& until_s) {
  const Outcome outcome = outcome_of(run_command(scenario, until_s));
  ASSERT_NE(outcome.digest(), "") << outcome.errors;
  EXPECT_NE(text_of(document).find("digest            " + outcome.digest()), std::string::npos)
      << document << " does not show what " << scenario << " until " << until_s << " s ends with: " << outcome.output;
}

TEST(Documents, ShowTheDigestsThatThereAre) {
  expect_shown("README.md", "office.yaml", "900");
  expect_shown("docs/robots.md", "office.yaml", "20");
  expect_shown("docs/clocks.md", "office-one-processor.yaml", "900");
}

TEST(Documents, ThePictureIsThatOfTheRun) {
  const tools::Folder folder;
  const std::string picture = folder / "office.svg";
  const Outcome outcome = outcome_of(run_command("office.yaml", "900", {"--picture", picture}));
  ASSERT_EQ(outcome.status, 0) << outcome.errors;
  EXPECT_NE(text_of("docs/office.svg").find(outcome.digest()), std::string::npos);
  EXPECT_TRUE(text_of("docs/office.svg") == folder.read("office.svg"))
      << "renew it: waitpoint run scenarios/office.yaml --picture docs/office.svg";
}

}  // namespace
}  // namespace waitpoint::runs
