// SPDX-License-Identifier: BSD-3-Clause
#include "modules/scenario/yaml_tree.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "modules/scenario/yaml_override.hpp"
#include "tests/modules/scenario/scenario_text.hpp"

namespace waitpoint::scenario {
namespace {

using Kind = YamlNode::Kind;

/// The node as text in one line, to compare trees.
std::string flat(const YamlNode& node) {
  std::string text;
  switch (node.kind) {
    case Kind::null: return "~";
    case Kind::scalar: return node.text;
    case Kind::list:
      for (const YamlNode& item : node.items) text += (text.empty() ? "" : ", ") + flat(item);
      return "[" + text + "]";
    case Kind::map:
      for (const YamlEntry& entry : node.entries) {
        text += (text.empty() ? "" : ", ") + entry.key + ": " + flat(entry.value);
      }
      return "{" + text + "}";
  }
  return text;
}

YamlNode parse(const std::string& text) { return parse_yaml(text, "f.yaml"); }

TEST(YamlTree, KeepsOrderKindsAndLines) {
  const YamlNode node = parse("b: 1\na:\n  - x\n  - {c: '2', d: }\n");
  EXPECT_EQ(flat(node), "{b: 1, a: [x, {c: 2, d: ~}]}");
  EXPECT_EQ(node.entries[1].written.line, 2);
  EXPECT_EQ(node.find("a")->items[1].written.text(), "f.yaml:4");
  EXPECT_TRUE(node.find("a")->items[1].find("c")->quoted);
  EXPECT_FALSE(node.find("b")->quoted);
  EXPECT_EQ(node.find("a")->items[1].find("d"), nullptr) << "nothing written is the same as no key";
}

TEST(YamlTree, CopiesAnchorsToTheirAliases) {
  EXPECT_EQ(flat(parse("a: &x {c: 1}\nb: *x\n")), "{a: {c: 1}, b: {c: 1}}");
}

TEST(YamlTree, MergeKeyAddsMissingKeys) {
  EXPECT_EQ(flat(parse("a: &x {c: 1, d: 2}\nb: {<<: *x, d: 3, e: 4}\n")), "{a: {c: 1, d: 2}, b: {d: 3, e: 4, c: 1}}");
  EXPECT_EQ(flat(parse("a: &x {c: 1}\ny: &y {c: 2, d: 2}\nb: {<<: [*x, *y]}\n")),
            "{a: {c: 1}, y: {c: 2, d: 2}, b: {c: 1, d: 2}}")
      << "the first one counts";
  EXPECT_EQ(flat(parse("{'<<': 1}")), "{<<: 1}") << "a word in quotes";
  EXPECT_EQ(message_of<BadInput>([] { parse("a: 1\nb:\n  <<: 5\n"); }),
            "f.yaml:3: expected the value of '<<' to be a map, or a list of maps");
  EXPECT_EQ(message_of<BadInput>([] { parse("{<<: {a: 1}, <<: {a: 1}}"); }),
            "f.yaml:1: key '<<' is given twice: expected a list of maps");
}

TEST(YamlTree, FindsADuplicateAmongManyKeys) {
  std::string text;
  for (int i = 0; i < 100; ++i) text += "k" + std::to_string(i) + ": " + std::to_string(i) + "\n";
  EXPECT_EQ(message_of<BadInput>([&] { parse(text + "k10: 1\n"); }),
            "f.yaml:101: key 'k10' is given twice, first at f.yaml:11");
  EXPECT_EQ(message_of<BadInput>([&] { parse(text + "k70: 1\n"); }),
            "f.yaml:101: key 'k70' is given twice, first at f.yaml:71");
}

TEST(YamlTree, CountsNestingThroughAliases) {
  std::string text = "a: &a ";
  for (int i = 0; i < 20; ++i) text += "[";
  text += std::string(20, ']') + "\nb: ";
  const std::string end = "*a";
  EXPECT_NO_THROW(parse(text + std::string(10, '[') + end + std::string(10, ']')));
  EXPECT_EQ(message_of<BadInput>([&] { parse(text + std::string(15, '[') + end + std::string(15, ']')); }),
            "f.yaml:2: values are nested more than 32 deep");
}

TEST(YamlTree, ReadsManyAliasesOfOneAnchor) {
  std::string text = "kind: &kind {a: 1, b: [2, 3], c: {d: 4, e: 5}, f: 6}\nrobots:\n";
  constexpr int robots = 20'000;
  for (int i = 0; i < robots; ++i) text += "  - {<<: *kind, name: r" + std::to_string(i) + ", start: [1.5, 2.5, 90]}\n";
  const YamlNode node = parse(text);
  ASSERT_EQ(node.find("robots")->items.size(), std::size_t{robots});
  EXPECT_EQ(flat(node.find("robots")->items.back()),
            "{name: r19999, start: [1.5, 2.5, 90], a: 1, b: [2, 3], c: {d: 4, e: 5}, f: 6}");
}

TEST(YamlTree, RefusesExponentialAliases) {
  std::string text = "a0: &a0 [x, x, x, x, x, x, x, x, x, x]\n";
  for (int i = 1; i < 12; ++i) {
    text += fmt::format("a{0}: &a{0} [*a{1}, *a{1}, *a{1}, *a{1}, *a{1}, *a{1}]\n", i, i - 1);
  }
  EXPECT_NE(message_of<BadInput>([&] { parse(text); }).find("an anchor that multiplies itself?"), std::string::npos);
}

TEST(YamlTree, RefusesRecursiveAliases) {
  EXPECT_EQ(message_of<BadInput>([] { parse("a: &x [*x]\n"); }),
            "f.yaml:1: expected no alias inside of its own anchor");
}

TEST(YamlTree, RefusesASecondDocument) {
  EXPECT_EQ(message_of<BadInput>([] { parse("a: 1\n---\nb: 2\n"); }),
            "f.yaml:3: expected one YAML document, found a second");
  EXPECT_EQ(flat(parse("---\na: 1\n---\n")), "{a: 1}") << "nothing is in the second";
}

TEST(YamlTree, RefusesEndlessDocuments) {
  EXPECT_EQ(message_of<BadInput>([] { parse(",1"); }), "f.yaml:1: expected one YAML document, found a second");
}

TEST(YamlTree, RefusesKeysThatAreNotScalars) {
  EXPECT_EQ(message_of<BadInput>([] { parse("a: 1\n[x, y]: 2\n"); }), "f.yaml:2: expected a word as key");
}

TEST(YamlTree, RefusesAFolder) {
  const TemporaryFolder folder;
  EXPECT_EQ(message_of<BadInput>([&] { load_yaml(folder.path()); }),
            folder.path().string() + ": is a folder, expected a file");
}

TEST(YamlTree, RefusesDeepTruncatedAndJunkFiles) {
  for (const char* open : {"[", "{a: ", "- ", "? "})
    EXPECT_THROW(parse([&] {
                   std::string text;
                   for (int i = 0; i < 20000; ++i) text += open;
                   return text;
                 }()),
                 BadInput)
        << open;
  EXPECT_THROW(parse("a: [1, 2"), BadInput);
  EXPECT_THROW(parse("a: \"cut"), BadInput);
  EXPECT_THROW(parse(std::string("a: \0\x01\xff\n b", 9)), BadInput);
}

TEST(YamlTree, RefusesAnEndlessFile) {
  if (!std::filesystem::exists("/dev/zero")) GTEST_SKIP() << "no /dev/zero";
  EXPECT_EQ(message_of<BadInput>([] { load_yaml("/dev/zero"); }), "/dev/zero: expected a file of at most 64 MiB");
}

TEST(YamlOverride, MergesMapsByKey) {
  EXPECT_EQ(flat(laid_over(parse("{a: 1, b: {c: 2, d: 3}}"), parse("{b: {d: 4}, e: 5}"))),
            "{a: 1, b: {c: 2, d: 4}, e: 5}");
}

TEST(YamlOverride, MergesListsOfNamedElementsByName) {
  const YamlNode base = parse("{l: [{name: a, x: 1}, {name: b, x: 2}], p: [1, 2, 3]}");
  EXPECT_EQ(flat(laid_over(base, parse("{l: [{name: b, y: 5}, {name: c}], p: [4]}"))),
            "{l: [{name: a, x: 1}, {name: b, x: 2, y: 5}, {name: c}], p: [4]}");
  EXPECT_EQ(flat(laid_over(base, parse("{l: []}"))), "{l: [], p: [1, 2, 3]}");
}

TEST(YamlOverride, KeepsTheLinesOfOverridingValues) {
  const YamlNode node = laid_over(parse("a: 1\nb: 2\n"), parse_yaml("\n\nb: 3\n", "g.yaml"));
  EXPECT_EQ(node.find("a")->written.text(), "f.yaml:1");
  EXPECT_EQ(node.find("b")->written.text(), "g.yaml:3");
}

TEST(YamlOverride, AssignmentReachesIntoListsAndMakesMaps) {
  YamlNode node = parse("{l: [{name: a, x: 1}, 7]}");
  assign(node, Assignment("l.a.x=2"));
  assign(node, Assignment("l.1=[8, 9]"));
  assign(node, Assignment("m.n.o='p'"));
  EXPECT_EQ(flat(node), "{l: [{name: a, x: 2}, [8, 9]], m: {n: {o: p}}}");
  EXPECT_EQ(node.find("m")->find("n")->find("o")->written.text(), "--set m.n.o='p'");
}

}  // namespace
}  // namespace waitpoint::scenario
