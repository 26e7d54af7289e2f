// SPDX-License-Identifier: BSD-3-Clause
#include "modules/scenario/yaml_tree.hpp"

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

TEST(YamlTree, keeps_order_kinds_and_lines) {
  const YamlNode node = parse("b: 1\na:\n  - x\n  - {c: '2', d: }\n");
  EXPECT_EQ(flat(node), "{b: 1, a: [x, {c: 2, d: ~}]}");
  EXPECT_EQ(node.entries[1].written.line, 2);
  EXPECT_EQ(node.find("a")->items[1].written.text(), "f.yaml:4");
  EXPECT_TRUE(node.find("a")->items[1].find("c")->quoted);
  EXPECT_FALSE(node.find("b")->quoted);
  EXPECT_EQ(node.find("a")->items[1].find("d"), nullptr) << "nothing written is the same as no key";
}

TEST(YamlTree, anchors_are_copied_to_where_they_are_used) {
  EXPECT_EQ(flat(parse("a: &x {c: 1}\nb: *x\n")), "{a: {c: 1}, b: {c: 1}}");
}

TEST(YamlTree, a_document_that_multiplies_itself_is_refused) {
  std::string text = "a0: &a0 [x, x, x, x, x, x, x, x, x, x]\n";
  for (int i = 1; i < 12; ++i) {
    const std::string last = "*a" + std::to_string(i - 1);
    text += "a" + std::to_string(i) + ": &a" + std::to_string(i) + " [" + last + ", " + last + ", " + last + ", " +
            last + ", " + last + ", " + last + "]\n";
  }
  EXPECT_NE(message_of<BadInput>([&] { parse(text); }).find("an anchor that multiplies itself?"), std::string::npos);
}

TEST(YamlTree, a_document_that_contains_itself_is_refused) {
  EXPECT_EQ(message_of<BadInput>([] { parse("a: &x [*x]\n"); }), "f.yaml:1: values are nested more than 32 deep");
}

TEST(YamlTree, a_second_document_is_refused) {
  EXPECT_EQ(message_of<BadInput>([] { parse("a: 1\n---\nb: 2\n"); }),
            "f.yaml:3: expected one YAML document, found a second");
  EXPECT_EQ(flat(parse("---\na: 1\n---\n")), "{a: 1}") << "nothing is in the second";
}

TEST(YamlTree, text_that_the_parser_takes_for_documents_without_end_is_refused) {
  EXPECT_EQ(message_of<BadInput>([] { parse(",1"); }), "f.yaml:1: expected one YAML document, found a second");
}

TEST(YamlTree, a_key_that_is_no_word_is_refused) {
  EXPECT_EQ(message_of<BadInput>([] { parse("a: 1\n[x, y]: 2\n"); }), "f.yaml:2: expected a word as key");
}

TEST(YamlTree, a_folder_is_no_file) {
  const TemporaryFolder folder;
  EXPECT_EQ(message_of<BadInput>([&] { load_yaml(folder.path()); }),
            folder.path().string() + ": is a folder, expected a file");
}

TEST(YamlTree, a_file_nested_deeply_cut_short_or_of_junk_is_refused) {
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
  EXPECT_THROW(parse(std::string("a: \0\x01\xff\n b", 10)), BadInput);
}

TEST(YamlTree, a_file_without_end_is_refused) {
  if (!std::filesystem::exists("/dev/zero")) GTEST_SKIP() << "no /dev/zero";
  EXPECT_EQ(message_of<BadInput>([] { load_yaml("/dev/zero"); }), "/dev/zero: expected a file of at most 4 MiB");
}

TEST(YamlOverride, maps_are_merged_key_by_key) {
  EXPECT_EQ(flat(laid_over(parse("{a: 1, b: {c: 2, d: 3}}"), parse("{b: {d: 4}, e: 5}"))),
            "{a: 1, b: {c: 2, d: 4}, e: 5}");
}

TEST(YamlOverride, lists_of_named_elements_are_merged_by_name_others_replaced) {
  const YamlNode base = parse("{l: [{name: a, x: 1}, {name: b, x: 2}], p: [1, 2, 3]}");
  EXPECT_EQ(flat(laid_over(base, parse("{l: [{name: b, y: 5}, {name: c}], p: [4]}"))),
            "{l: [{name: a, x: 1}, {name: b, x: 2, y: 5}, {name: c}], p: [4]}");
  EXPECT_EQ(flat(laid_over(base, parse("{l: []}"))), "{l: [], p: [1, 2, 3]}");
}

TEST(YamlOverride, what_is_laid_over_brings_its_own_lines) {
  const YamlNode node = laid_over(parse("a: 1\nb: 2\n"), parse_yaml("\n\nb: 3\n", "g.yaml"));
  EXPECT_EQ(node.find("a")->written.text(), "f.yaml:1");
  EXPECT_EQ(node.find("b")->written.text(), "g.yaml:3");
}

TEST(YamlOverride, an_assignment_reaches_into_lists_and_makes_maps) {
  YamlNode node = parse("{l: [{name: a, x: 1}, 7]}");
  assign(node, Assignment("l.a.x=2"));
  assign(node, Assignment("l.1=[8, 9]"));
  assign(node, Assignment("m.n.o='p'"));
  EXPECT_EQ(flat(node), "{l: [{name: a, x: 2}, [8, 9]], m: {n: {o: p}}}");
  EXPECT_EQ(node.find("m")->find("n")->find("o")->written.text(), "--set m.n.o='p'");
}

}  // namespace
}  // namespace waitpoint::scenario
