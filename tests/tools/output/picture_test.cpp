// SPDX-License-Identifier: BSD-3-Clause
#include "tools/output/picture.hpp"

#include <gtest/gtest.h>

#include "core/xml_text.hpp"
#include "tests/tools/sample_result.hpp"
#include "tests/tools/xml_check.hpp"
#include "tools/output/svg.hpp"

namespace waitpoint::tools {
namespace {

using world::Obstacle;
using world::Shape;

std::vector<Obstacle> boxes(std::size_t count) {
  std::vector<Obstacle> obstacles(count);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t row = i / 100;
    obstacles[i].shape = {
        Shape::Kind::box, {0.1 * static_cast<double>(i % 100), 0.1 * static_cast<double>(row), 0}, 0.1, 0.1, 0, 0, 2};
  }
  return obstacles;
}

TEST(Picture, IsWellFormedForAnyNames) {
  const std::string svg = picture_svg(boxes(3), sample_result(2));
  const XmlCheck check(svg);
  EXPECT_EQ(check.problem(), "");
  EXPECT_EQ(check.count("svg"), 1u);
  EXPECT_NE(svg.find("a &lt;small&gt; &quot;run&quot; &amp; more"), std::string::npos);
}

TEST(Picture, ShowsThreePathsAndTwoGoalsPerRobot) {
  EXPECT_EQ(XmlCheck(picture_svg(boxes(3), sample_result(1))).count("polyline"), 3u);
  EXPECT_EQ(XmlCheck(picture_svg(boxes(3), sample_result(2))).count("polyline"), 6u);
  const std::string svg = picture_svg(boxes(3), sample_result(1));
  EXPECT_NE(svg.find(">1</text>"), std::string::npos);
  EXPECT_NE(svg.find(">2</text>"), std::string::npos);
  EXPECT_EQ(svg.find(">3</text>"), std::string::npos);
  for (const char* label : {"true path", "estimated", "odometry alone", "segments", " m</text>", "wp1:"}) {
    EXPECT_NE(svg.find(label), std::string::npos) << label;
  }
}

TEST(Picture, EqualRunsGiveEqualText) {
  EXPECT_EQ(picture_svg(boxes(9), sample_result(2)), picture_svg(boxes(9), sample_result(2)));
}

TEST(Picture, StaysSmallWithThousandsOfBoxes) {
  const std::string svg = picture_svg(boxes(5000), sample_result(1));
  const XmlCheck check(svg);
  EXPECT_EQ(check.problem(), "");
  EXPECT_LT(svg.size(), 600'000u);
  EXPECT_LT(check.count("path"), 20u) << "one path for all boxes of a kind";
}

TEST(Picture, EmptyRunGivesAPicture) {
  bridge::RunResult nothing;
  EXPECT_EQ(XmlCheck(picture_svg({}, nothing)).problem(), "");
  nothing.robots.resize(1);
  EXPECT_EQ(XmlCheck(picture_svg({}, nothing)).problem(), "");
}

TEST(Svg, NumbersHaveAtMostTwoDecimals) {
  EXPECT_EQ(svg_number(1), "1");
  EXPECT_EQ(svg_number(0.5), "0.5");
  EXPECT_EQ(svg_number(2.678), "2.68");
  EXPECT_EQ(svg_number(-0.001), "0");
  EXPECT_EQ(svg_number(100), "100");
}

TEST(Svg, EscapesReservedAndDropsControlCharacters) {
  EXPECT_EQ(xml_escaped("a<b & \"c\">\x01é"), "a&lt;b &amp; &quot;c&quot;&gt;é");
}

TEST(XmlCheck, FindsErrors) {
  EXPECT_EQ(XmlCheck("<a b=\"1\"><c/>x &amp; y</a>").problem(), "");
  for (const char* bad : {"<a>", "<a></b>", "<a b=1/>", "<a b=\"<\"/>", "<a>&</a>", "<a b=\"1\" b=\"2\"/>", "<a/>x"}) {
    EXPECT_NE(XmlCheck(bad).problem(), "") << bad;
  }
}

}  // namespace
}  // namespace waitpoint::tools
