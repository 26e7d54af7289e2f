// SPDX-License-Identifier: BSD-3-Clause
#include "tools/output/picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <vector>

#include "core/number_text.hpp"
#include "core/polyline.hpp"
#include "tools/output/occupied_shapes.hpp"
#include "tools/output/picture_frame.hpp"
#include "tools/output/svg.hpp"

namespace waitpoint::tools {
namespace {

using bridge::DatedPose;
using bridge::RobotResult;
using bridge::RunResult;
using world::Obstacle;
using world::Shape;

/// Obstacles of at least this height are drawn as walls, the others as furniture.
constexpr double wall_height_m = 1.9;
constexpr Duration outline_period = std::chrono::seconds(15);

/// Distinguishable with the common colour blindnesses, as far as ten colours can be.
constexpr std::array<std::string_view, 10> robot_colours = {"#1c7ed6", "#d9480f", "#2b8a3e", "#9c36b5", "#0b7285",
                                                            "#c2255c", "#5c940d", "#5f3dc4", "#e67700", "#495057"};

constexpr std::string_view ink = "#212529", wall = "#495057", furniture = "#d6c7ae", furniture_edge = "#a8957a";
constexpr std::string_view unknown = "#f08c00", estimate_single = "#f76707", odometry_single = "#c2255c";
constexpr std::string_view segment_colour = "#2f9e44", paper = "#ffffff", floor_colour = "#f8f7f4";

/// Colours and widths of one robot's lines: a single robot has a colour for each line, one of several a colour for all.
struct Pen {
  std::string truth, estimate, odometry, segments, colour;
};

Pen pen_of(std::size_t robot, std::size_t robots) {
  const std::string_view colour = robot_colours[robot % robot_colours.size()];
  const bool alone = robots == 1;
  const std::string_view round = "fill=\"none\" stroke-linejoin=\"round\" stroke-linecap=\"round\"";
  return {
      fmt::format("{} stroke=\"{}\" stroke-width=\"3.4\"", round, colour),
      fmt::format("{} stroke=\"{}\" stroke-width=\"1.6\" stroke-dasharray=\"6 5\"", round,
                  alone ? estimate_single : ink),
      fmt::format("{} stroke=\"{}\" stroke-width=\"1.3\" stroke-dasharray=\"1.5 4\" opacity=\"{}\"", round,
                  alone ? odometry_single : colour, alone ? 0.85 : 0.6),
      fmt::format("{} stroke=\"{}\" stroke-width=\"2.4\" opacity=\"{}\"", round, segment_colour, alone ? 0.95 : 0.6),
      std::string(colour)};
}

std::string outline_path(const PictureFrame& frame, const Shape& shape) {
  if (shape.kind == Shape::Kind::cylinder) {
    const Point c = frame.pixel(shape.pose.position());
    const std::string r = svg_number(frame.pixels(shape.radius_m)),
                      across = svg_number(2 * frame.pixels(shape.radius_m));
    return fmt::format("M{},{}a{r},{r} 0 1 0 {d},0a{r},{r} 0 1 0 -{d},0z",
                       svg_number(c.x - frame.pixels(shape.radius_m)), svg_number(c.y), fmt::arg("r", r),
                       fmt::arg("d", across));
  }
  std::vector<Point> points = corners(shape);
  for (Point& p : points) p = frame.pixel(p);
  return svg_polygon(points);
}

/// One path for all obstacles of a kind: a map may have thousands.
void draw_floor(Svg& svg, const PictureFrame& frame, std::span<const Obstacle> obstacles) {
  std::string walls, low, unknowns;
  for (const Obstacle& obstacle : obstacles) {
    const bool high = obstacle.shape.z_high_m >= wall_height_m;
    (!obstacle.known ? unknowns : high ? walls : low) += outline_path(frame, obstacle.shape);
  }
  svg.path(low, fmt::format("fill=\"{}\" stroke=\"{}\" stroke-width=\"1\"", furniture, furniture_edge));
  // The stroke closes the seams between the merged boxes of a map's cells.
  svg.path(walls, fmt::format("fill=\"{0}\" stroke=\"{0}\" stroke-width=\"0.6\"", wall));
  svg.path(unknowns, fmt::format("fill=\"url(#unknown)\" stroke=\"{}\" stroke-width=\"1.5\"", unknown));
}

void draw_path(Svg& svg, const PictureFrame& frame, std::span<const DatedPose> path, const std::string& style) {
  std::vector<Point> points, drawn;
  for (const DatedPose& at : path) points.push_back(frame.pixel(at.pose.position()));
  for (const std::size_t i : simplified(points, 0.25)) drawn.push_back(points[i]);
  svg.polyline(drawn, style);
}

void draw_robot_at(Svg& svg, const PictureFrame& frame, const RobotResult& robot, const Pose& pose,
                   const std::string& style) {
  Shape shape = robot.shape;
  shape.pose = compose(pose, shape.pose);
  svg.path(outline_path(frame, shape), style);
  const double nose_m = shape.kind == Shape::Kind::cylinder ? shape.radius_m : shape.length_m / 2;
  svg.line(frame.pixel(pose.position()), frame.pixel(transform(pose, {nose_m, 0})), style);
}

std::string faint_style(const Pen& pen) {
  return fmt::format("fill=\"{0}\" fill-opacity=\"0.10\" stroke=\"{0}\" stroke-width=\"1\" stroke-opacity=\"0.55\"",
                     pen.colour);
}

void draw_outlines(Svg& svg, const PictureFrame& frame, const RobotResult& robot, const Pen& pen) {
  if (robot.true_path.empty()) return;
  const std::string faint = faint_style(pen);
  Time next = robot.true_path.front().date + outline_period;
  for (const DatedPose& at : robot.true_path) {
    if (at.date < next) continue;
    draw_robot_at(svg, frame, robot, at.pose, faint);
    next = at.date + outline_period;
  }
  const std::string strong = fmt::format("fill=\"{}\" stroke=\"{}\" stroke-width=\"1.6\"", pen.colour, ink);
  draw_robot_at(svg, frame, robot, robot.true_path.back().pose, strong);
}

void draw_marks(Svg& svg, const PictureFrame& frame, const RobotResult& robot, const Pen& pen, bool named) {
  if (!robot.true_path.empty()) {
    const Point start = frame.pixel(robot.true_path.front().pose.position());
    svg.rectangle(start - Point{5, 5}, 10, 10,
                  fmt::format("fill=\"{}\" stroke=\"{}\" stroke-width=\"2\"", paper, pen.colour));
    svg.text(start + Point{0, -13}, named ? robot.name : "start",
             fmt::format("text-anchor=\"middle\" font-size=\"13\" font-weight=\"bold\" fill=\"{}\" stroke=\"{}\" "
                         "stroke-width=\"3\" paint-order=\"stroke\"",
                         pen.colour, paper));
  }
  for (std::size_t i = 0; i < robot.goals.size(); ++i) {
    const Point at = frame.pixel(robot.goals[i].position);
    const bool reached = robot.goals[i].reached();
    svg.circle(
        at, 11,
        fmt::format("fill=\"{}\" stroke=\"{}\" stroke-width=\"2.2\"{}", reached ? pen.colour : std::string(paper),
                    reached ? std::string(paper) : pen.colour, reached ? "" : " stroke-dasharray=\"3 2\""));
    svg.text(at + Point{0, 4.5}, std::to_string(i + 1),
             fmt::format("text-anchor=\"middle\" font-size=\"13\" font-weight=\"bold\" fill=\"{}\"",
                         reached ? std::string(paper) : pen.colour));
  }
}

/// Draws entries of the legend from left to right.
class Legend {
 public:
  Legend(Svg& svg, Point at) : svg_(svg), at_(at) {}

  void line(std::string_view style, std::string_view label) {
    svg_.line(at_, at_ + Point{34, 0}, style);
    write(42, label);
  }
  void box(std::string_view style, std::string_view label) {
    svg_.rectangle(at_ - Point{0, 7}, 20, 14, style);
    write(28, label);
  }
  void disc(std::string_view style, std::string_view label) {
    svg_.circle(at_ + Point{9, 0}, 9, style);
    write(26, label);
  }

 private:
  void write(double indent, std::string_view label) {
    svg_.text(at_ + Point{indent, 5}, label, fmt::format("font-size=\"14\" fill=\"{}\"", ink));
    // An estimate without font metrics: Helvetica's average letter is a little over half as wide as the font is high.
    at_.x += indent + 7.3 * static_cast<double>(label.size()) + 20;
  }

  Svg& svg_;
  Point at_;
};

constexpr std::string_view path_style = "fill=\"none\" stroke=\"#0ca678\" stroke-width=\"2\" stroke-dasharray=\"2 3\"";
constexpr std::string_view cloud_style = "fill=\"#e8590c\" fill-opacity=\"0.5\"";
constexpr std::string_view grid_style = "fill=\"#7048e8\" fill-opacity=\"0.35\"";

// Topics of nodes: below the robots' paths.
void draw_shown(Svg& svg, const PictureFrame& frame, std::span<const nodes::ShownMessage> shown) {
  for (const nodes::ShownMessage& message : shown) {
    std::string cells;
    for (const Shape& shape : occupied_shapes(message)) cells += outline_path(frame, shape);
    svg.path(cells, grid_style);
    std::vector<Point> points;
    points.reserve(message.poses.size());
    for (const Pose& pose : message.poses) points.push_back(frame.pixel(pose.position()));
    if (message.kind == nodes::ShownMessage::Kind::path)
      svg.polyline(points, path_style);
    else
      for (const Point& at : points) svg.circle(at, 1.6, cloud_style);
  }
}

void draw_legend(Svg& svg, const PictureFrame& frame, const RunResult& result,
                 std::span<const nodes::ShownMessage> shown) {
  const std::size_t robots = result.robots.size();
  const Pen pen = pen_of(0, robots);
  const double y = PictureFrame::top + frame.map_height();
  Legend lines(svg, {PictureFrame::left, y + 26});
  lines.line(pen.truth, robots > 1 ? "true path, a colour per robot" : "true path");
  lines.line(pen.estimate, "estimated (fused) path");
  lines.line(pen.odometry, "odometry alone");
  lines.line(pen.segments, "segments mapped by segloc");
  const auto has = [&](nodes::ShownMessage::Kind kind) {
    return std::any_of(shown.begin(), shown.end(), [&](const auto& message) { return message.kind == kind; });
  };
  if (has(nodes::ShownMessage::Kind::path)) lines.line(path_style, "paths of nodes");
  Legend areas(svg, {PictureFrame::left, y + 54});
  if (has(nodes::ShownMessage::Kind::grid)) areas.box(grid_style, "grid of a node");
  if (has(nodes::ShownMessage::Kind::cloud)) areas.disc(cloud_style, "poses of a node");
  areas.box(fmt::format("fill=\"{}\"", wall), "wall");
  areas.box(fmt::format("fill=\"{}\" stroke=\"{}\"", furniture, furniture_edge), "furniture");
  areas.box(fmt::format("fill=\"url(#unknown)\" stroke=\"{}\" stroke-width=\"1.5\"", unknown),
            "not on the robot's map");
  areas.disc(fmt::format("fill=\"{}\"", pen.colour), "goal, in order");
  areas.disc(faint_style(pen), fmt::format("robot, every {:.0f} s", outline_period.seconds()));
}

/// The roundest length of about a tenth of the map.
void draw_scale_bar(Svg& svg, const PictureFrame& frame) {
  double length_m = 0.1;
  for (const double candidate : {0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0, 200.0, 500.0, 1000.0}) {
    if (frame.pixels(candidate) <= 0.16 * frame.map_width()) length_m = candidate;
  }
  const double length = frame.pixels(length_m), right = frame.width() - PictureFrame::left;
  const double y = PictureFrame::top + frame.map_height() + 56;
  const std::string style = fmt::format("stroke=\"{}\" stroke-width=\"2\"", ink);
  svg.line({right - length, y}, {right, y}, style);
  for (const double x : {right - length, right - length / 2, right}) svg.line({x, y - 5}, {x, y + 5}, style);
  svg.text({right - length / 2, y - 11}, fmt::format("{:g} m", length_m),
           fmt::format("text-anchor=\"middle\" font-size=\"14\" fill=\"{}\"", ink));
}

void draw_title(Svg& svg, const RunResult& result) {
  svg.text({PictureFrame::left, 36}, result.scenario,
           fmt::format("font-size=\"24\" font-weight=\"bold\" fill=\"{}\"", ink));
  const bridge::RunTotals sum = totals(result);
  const std::string line =
      fmt::format("seed {} · {} after {:.1f} s · {} of {} goals · {:.1f} m driven · {} · {}", result.seed,
                  bridge::to_string(result.outcome), result.simulated.seconds(), sum.goals_reached, sum.goals,
                  sum.distance_m, counted(sum.collisions, "collision"), to_string(result.digest));
  svg.text({PictureFrame::left, 60}, line, "font-size=\"14\" fill=\"#495057\"");
}

}  // namespace

std::string picture_svg(std::span<const Obstacle> obstacles, const RunResult& result,
                        std::span<const nodes::ShownMessage> shown) {
  const PictureFrame frame(obstacles, result);
  Svg svg(frame.width(), frame.height());
  svg.define(
      fmt::format("<pattern id=\"unknown\" width=\"6\" height=\"6\" patternUnits=\"userSpaceOnUse\" "
                  "patternTransform=\"rotate(45)\"><rect width=\"6\" height=\"6\" fill=\"#ffe8cc\"/><line y2=\"6\" "
                  "stroke=\"{}\" stroke-width=\"4\"/></pattern>",
                  unknown));
  svg.define(fmt::format("<clipPath id=\"map\"><rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"/></clipPath>",
                         PictureFrame::left, PictureFrame::top, svg_number(frame.map_width()),
                         svg_number(frame.map_height())));
  svg.rectangle({0, 0}, frame.width(), frame.height(), fmt::format("fill=\"{}\"", paper));
  draw_title(svg, result);
  svg.begin_group("clip-path=\"url(#map)\"");
  svg.rectangle({PictureFrame::left, PictureFrame::top}, frame.map_width(), frame.map_height(),
                fmt::format("fill=\"{}\"", floor_colour));
  draw_floor(svg, frame, obstacles);
  draw_shown(svg, frame, shown);
  const std::size_t robots = result.robots.size();
  for (std::size_t i = 0; i < robots; ++i) {
    const RobotResult& robot = result.robots[i];
    const Pen pen = pen_of(i, robots);
    for (const bridge::Line& segment : robot.segments) {
      svg.line(frame.pixel(segment.start), frame.pixel(segment.end), pen.segments);
    }
    draw_path(svg, frame, robot.odometry_path, pen.odometry);
    draw_outlines(svg, frame, robot, pen);
    draw_path(svg, frame, robot.true_path, pen.truth);
    draw_path(svg, frame, robot.estimated_path, pen.estimate);
  }
  for (std::size_t i = 0; i < robots; ++i) draw_marks(svg, frame, result.robots[i], pen_of(i, robots), robots > 1);
  svg.end_group();
  draw_legend(svg, frame, result, shown);
  draw_scale_bar(svg, frame);
  return svg.finish();
}

}  // namespace waitpoint::tools
