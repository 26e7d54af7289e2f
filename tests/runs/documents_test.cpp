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

TEST(Documents, ALatePositionIsWhyTheRobotHitsTheWall) {
  const auto outcome_with = [](const std::string& cost_us) {
    return outcome_of(
        run_command("late-pom.yaml", "120", {"--set", "robots.rackham.modules.pom.tasks.fusing.cost_us=" + cost_us}));
  };
  const Outcome late = outcome_with("800000"), early = outcome_with("1000");
  EXPECT_NE(late.output.find("collisions        1"), std::string::npos) << late.output << late.errors;
  EXPECT_NE(early.output.find("collisions        0"), std::string::npos) << early.output << early.errors;
}

/// What the page has of its run, without the scripts that show it.
std::string run_of_page(const std::string& page) {
  const std::size_t begin = page.find("<script id=\"run\""), end = page.find("</script>", begin);
  return begin == std::string::npos ? "" : page.substr(begin, end - begin);
}

TEST(Documents, ThePageIsThatOfTheRun) {
  const tools::Folder folder;
  const Outcome outcome = outcome_of(run_command("office.yaml", "900", {"--page", folder / "office.html"}));
  ASSERT_EQ(outcome.status, 0) << outcome.errors;
  const std::string shown = run_of_page(text_of("docs/office.html"));
  EXPECT_NE(shown, "");
  EXPECT_TRUE(shown == run_of_page(folder.read("office.html")))
      << "renew it: waitpoint run scenarios/office.yaml --page docs/office.html";
}

}  // namespace
}  // namespace waitpoint::runs
