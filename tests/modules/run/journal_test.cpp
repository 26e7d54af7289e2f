// SPDX-License-Identifier: BSD-3-Clause
#include "modules/run/journal.hpp"

#include <gtest/gtest.h>

#include "modules/scenario/scenario_reader.hpp"
#include "tests/modules/scenario/scenario_text.hpp"

namespace waitpoint::run {
namespace {

class JournalTest : public ::testing::Test {
 protected:
  Journal read(const std::string& lines) const { return read_journal(folder_.write("j", lines), head_); }
  std::string complaint(const std::string& lines) const {
    const std::string text = scenario::message_of<BadInput>([&] { read(lines); });
    const std::string file = (folder_.path() / "j").string();
    EXPECT_TRUE(text.starts_with(file)) << text;
    return text.substr(std::min(file.size(), text.size()));
  }

  scenario::TemporaryFolder folder_;
  JournalHead head_{"office", Digest(5), 3, kernel::Order::seeded};
};

TEST_F(JournalTest, ReadsBackAsWritten) {
  const Intervention move = parse_intervention("move rackham 1 2", {"prompt", 0});
  const Time date = Time::from_ns(12'340'000'001);
  const Journal journal =
      read(to_text(head_) + to_text(date, move) + to_text(JournalEnd{Time::from_ns(5), 77, "wp1:00"}));
  ASSERT_EQ(journal.interventions.size(), 1u);
  EXPECT_EQ(journal.interventions[0].date, date);
  EXPECT_EQ(journal.interventions[0].intervention.text, "move rackham 1 2");
  ASSERT_TRUE(journal.end);
  EXPECT_EQ(journal.end->time, Time::from_ns(5));
  EXPECT_EQ(journal.end->events, 77u);
  EXPECT_EQ(journal.end->digest, "wp1:00");
  EXPECT_FALSE(read(to_text(head_)).end);
}

TEST_F(JournalTest, CutOffRunHasItsReason) {
  const std::string lines = to_text(head_) + "at 1 move rackham 1 2\n" + cut_off_line("the process dies\nof SIGFPE");
  const Journal journal = read(lines);
  EXPECT_EQ(journal.interventions.size(), 1u);
  EXPECT_FALSE(journal.end);
  EXPECT_EQ(journal.cut_off, "the process dies?of SIGFPE");
  EXPECT_EQ(complaint(lines + "at 2 move rackham 1 2\n"), ":7: expected nothing after '# cut off'");
  EXPECT_EQ(complaint(to_text(head_) + "# cut off: \n").substr(0, 3), ":5:") << "no reason";
}

TEST_F(JournalTest, LinesMayEndAsOnOtherSystems) {
  std::string text = to_text(head_) + "at 1 move rackham 1 2\nend 5 after 77 events wp1:00\n";
  for (std::size_t end = text.find('\n'); end != std::string::npos; end = text.find('\n', end + 2))
    text.replace(end, 1, "\r\n");
  const Journal journal = read(text);
  EXPECT_EQ(journal.interventions.at(0).intervention.text, "move rackham 1 2");
  EXPECT_EQ(journal.end->digest, "wp1:00");
}

TEST_F(JournalTest, RefusesAJournalOfAnotherRun) {
  JournalHead other = head_;
  other.fingerprint = Digest(6);
  EXPECT_EQ(complaint(to_text(other)).find(":2: the journal of another scenario: expected "), 0u);
  other = head_;
  other.seed = 4;
  EXPECT_EQ(complaint(to_text(other)), ":3: the journal of another seed: expected 'seed 3', found 'seed 4'");
  other = head_;
  other.order = kernel::Order::fifo;
  EXPECT_EQ(complaint(to_text(other)), ":4: the journal of another order: expected 'order seeded', found 'order fifo'");
}

TEST_F(JournalTest, ReportsMalformedLinesWithTheirNumber) {
  const std::string head = to_text(head_);
  EXPECT_EQ(complaint("format: 1\n"), ":1: this is no journal: expected 'waitpoint journal 1', found 'format: 1'");
  EXPECT_EQ(complaint("\x7f"
                      "ELF\x02" +
                      std::string(500, 'x') + "\n"),
            ":1: this is no journal: expected 'waitpoint journal 1', found '?ELF?" + std::string(55, 'x') + "...'");
  EXPECT_EQ(complaint(""), ":1: the journal ends early, expected 'waitpoint journal 1'");
  EXPECT_EQ(complaint(head.substr(0, head.find("order"))), ":4: the journal ends early, expected 'order seeded'");
  EXPECT_EQ(complaint(head + "at 1 move rackham 1 2"), ":5: expected a newline: the line is cut off");
  EXPECT_EQ(complaint(head + "at once move rackham 1 2\n"), ":5: expected a time in seconds, found 'once'");
  EXPECT_EQ(complaint(head + "at 1 move rackham 1\n"), ":5: expected a place, X Y [HEADING_DEG], found ''");
  EXPECT_EQ(complaint(head + "move rackham 1 2\n"), ":5: expected 'at' or 'end', found 'move'");
  EXPECT_EQ(complaint(head + "end 1\n"), ":5: expected 'end TIME after N events DIGEST'");
  EXPECT_EQ(complaint(head + "end 1 after 2 events wp1:0\nat 1 move a 1 2\n"), ":6: expected nothing after 'end'");
}

TEST_F(JournalTest, ScenariosThatSayTheSameHaveOneFingerprint) {
  const auto fingerprint = [&](const std::string& text, const std::vector<std::string>& assignments = {}) {
    return scenario::read_scenario(folder_.write("s.yaml", text), assignments).fingerprint;
  };
  const std::string text(scenario::valid_scenario);
  EXPECT_EQ(fingerprint(text), fingerprint("# a remark\n" + text));
  EXPECT_NE(fingerprint(text), fingerprint(scenario::changed("step_ms: 5", "step_ms: 6")));
  EXPECT_NE(fingerprint(text), fingerprint(scenario::changed("[3, 1]", "[3, 1.5]")));
  EXPECT_EQ(fingerprint(text, {"world.step_ms=6"}), fingerprint(scenario::changed("step_ms: 5", "step_ms: 6")));
}

TEST(JournalTime, IsExactDecimalsOrNothing) {
  EXPECT_EQ(parse_time("12.340000001"), Time::from_ns(12'340'000'001));
  EXPECT_EQ(parse_time("999999999.999999999"), Time::from_ns(999'999'999'999'999'999));
  EXPECT_EQ(parse_time("7"), Time::from_ns(7'000'000'000));
  for (const char* text : {"", ".", "1.", ".5", "-1", "1e3", "1.0000000001", "1000000000", "1 "})
    EXPECT_EQ(parse_time(text), std::nullopt) << text;
}

}  // namespace
}  // namespace waitpoint::run
