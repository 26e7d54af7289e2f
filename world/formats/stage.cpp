// SPDX-License-Identifier: BSD-3-Clause
#include "world/formats/stage.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "world/formats/beside.hpp"
#include "world/formats/image_file.hpp"
#include "world/formats/limits.hpp"
#include "world/formats/merged_cells.hpp"
#include "world/formats/segments.hpp"
#include "world/formats/stage_robot.hpp"
#include "world/formats/stage_values.hpp"

namespace waitpoint::world {
namespace {

constexpr int dark_below = 128;  // of 255
// Floor plans are written so for a plane world, where height means nothing.
constexpr double flat_height_m = 2;

// An axis-parallel box of a model, in the model's units.
struct Part {
  double low_x, low_y, high_x, high_y, low_z, high_z;
};

class StageReader {
 public:
  explicit StageReader(LeftOut& left_out) : left_out_(left_out), robots_(left_out, thing_count_) {}

  StageWorld read(const StageThing& world) {
    for (const StageProperty& property : world.properties) tell(property);
    for (const StageThing& thing : world.things) read_thing(thing, {});
    return std::move(world_);
  }

 private:
  void tell(const StageProperty& property) {
    left_out_.add(*property.place.file, property.place.line, "'" + std::string(property.name.substr(0, 40)) + "'",
                  "is left out");
  }
  void tell(const StageThing& thing, std::string_view what, std::string_view consequence) {
    left_out_.add(*thing.place.file, thing.place.line, what, consequence);
  }

  // Warns about properties and parts of the thing, and of its type, that are not supported; once per definition.
  void tell_unread(const StageThing& thing) {
    for (const StageThing* at = &thing; at != nullptr; at = at->base) {
      if (!reported_.insert(at).second) return;
      for (const StageProperty& property : at->properties)
        if (!is_read(thing.built_in, property.name)) tell(property);
      for (const StageThing& inner : at->things)
        if (inner.built_in != "model") tell_unread(inner);
    }
  }

  static bool is_read(std::string_view kind, std::string_view property) {
    static const std::map<std::string_view, std::vector<std::string_view>> read = {
        {"model", {"name", "pose", "size", "origin", "bitmap", "boundary", "obstacle_return", "ranger_return"}},
        {"position",
         {"name", "pose", "size", "origin", "drive", "velocity_bounds", "acceleration_bounds", "obstacle_return",
          "ranger_return", "wheelbase"}},
        {"ranger", {"name", "pose", "size", "update_interval", "scount", "sview"}},
        {"laser", {"name", "pose", "size", "update_interval", "samples", "fov", "range_max", "range_min"}},
        {"sensor", {"pose", "range", "fov", "samples"}},
        {"block", {"points", "z"}}};
    const auto names = read.find(kind);
    if (names == read.end() || (kind == "block" && property.starts_with("point["))) return true;
    if (kind == "ranger" && (property.starts_with("spose[") || property.starts_with("sview["))) return true;
    return std::find(names->second.begin(), names->second.end(), property) != names->second.end();
  }

  void read_thing(const StageThing& thing, const StageFrame& outer) {
    count_stage_thing(thing, thing_count_);
    if (thing.built_in == "model") {
      tell_unread(thing);
      read_model(thing, outer);
    } else if (thing.built_in == "position") {
      tell_unread(thing);
      is_there(thing);
      StageRobot robot = robots_.read(thing);
      robot.body.name = name_of_robot(thing);
      world_.bodies.push_back(std::move(robot.body));
      world_.origins.push_back(std::move(robot.origin));
    } else {
      tell(thing, "'" + std::string(thing.built_in) + "'", "is left out");
    }
  }

  void read_model(const StageThing& model, const StageFrame& outer) {
    const StageFrame frame = stage_frame(model, outer);
    StageSize size = stage_size(model);
    if (size.z_m == 0) {
      size.z_m = flat_height_m;
      tell(model, "a model of height 0", "is taken as 2 m high");
    }
    if (is_there(model)) {
      const std::string name =
          model.find(StageKey::name) != nullptr ? stage_text(*model.find(StageKey::name)) : std::string(model.type);
      const Pose middle = compose(frame.pose, stage_origin(model));
      std::vector<Part> parts = parts_of(model);
      for (const Part& part : parts) add(model, shape_of(part, middle, frame.z_m, size), name);
      if (stage_number_or(model, StageKey::boundary, 0, 1, 0) != 0) add_boundary(model, middle, frame.z_m, size, name);
    }
    read_models_on(model, {frame.pose, frame.z_m + size.z_m});
  }

  void read_models_on(const StageThing& model, const StageFrame& top) {
    if (model.base != nullptr) read_models_on(*model.base, top);
    for (const StageThing& thing : model.things) {
      if (thing.built_in == "position") {
        tell(thing, "a robot on a model", "is left out");
      } else if (thing.built_in != "block") {
        read_thing(thing, top);
      }
    }
  }

  // True if the thing stops bodies or beams, with a warning if it stops only one of them.
  bool is_there(const StageThing& thing) {
    const StageProperty* bodies = thing.find(StageKey::obstacle_return);
    const StageProperty* beams = thing.find(StageKey::ranger_return);
    const bool stops_bodies = bodies == nullptr || stage_return(*bodies) > 0;
    const bool stops_beams = beams == nullptr || stage_return(*beams) >= 0;
    if (stops_bodies != stops_beams) {
      const StagePlace& place = (stops_bodies ? beams : bodies)->place;
      left_out_.add(*place.file, place.line, stops_bodies ? "a 'ranger_return' below 0" : "an 'obstacle_return' of 0",
                    "is left out: a model that stops only bodies or only beams stops both");
    }
    return stops_bodies || stops_beams;
  }

  // The model's parts, scaled to the unit square; heights are fractions, too.
  std::vector<Part> parts_of(const StageThing& model) {
    if (const StageProperty* bitmap = model.find(StageKey::bitmap)) return parts_of_bitmap(*bitmap);
    std::vector<Part> parts;
    add_blocks(model, parts);
    if (parts.empty()) return {{0, 0, 1, 1, 0, 1}};
    Part all = parts.front();
    for (const Part& part : parts) {
      all = {std::min(all.low_x, part.low_x),   std::min(all.low_y, part.low_y), std::max(all.high_x, part.high_x),
             std::max(all.high_y, part.high_y), std::min(all.low_z, part.low_z), std::max(all.high_z, part.high_z)};
    }
    const double width = all.high_x - all.low_x, depth = all.high_y - all.low_y;
    if (!(width > 0 && depth > 0 && all.high_z > 0)) refuse(model.place, "expected blocks with a volume");
    for (Part& part : parts) {
      part = {(part.low_x - all.low_x) / width,  (part.low_y - all.low_y) / depth, (part.high_x - all.low_x) / width,
              (part.high_y - all.low_y) / depth, part.low_z / all.high_z,          part.high_z / all.high_z};
    }
    return parts;
  }

  std::vector<Part> parts_of_bitmap(const StageProperty& property) {
    const std::string file = beside(*property.place.file, stage_text(property));
    const GreyImage image = read_grey_image(file);
    pixel_count_ += std::int64_t{image.width} * image.height;
    if (pixel_count_ > OccupancyGrid::cells_max) refuse(property.place, "expected smaller or fewer bitmaps");
    OccupancyGrid grid(image.width, image.height, 1, {}, Cell::free);
    std::size_t pixel = 0;
    for (int y = image.height - 1; y >= 0; --y) {
      for (int x = 0; x < image.width; ++x, ++pixel) {
        const bool hidden = !image.transparency.empty() && image.transparency[pixel] != 0;
        if (!hidden && image.grey[pixel] < dark_below) grid[{x, y}] = Cell::occupied;
      }
    }
    std::vector<Part> parts;
    const double width = image.width, height = image.height;
    for (const CellBlock& b : merged_occupied_cells(grid, file))
      parts.push_back({b.x / width, b.y / height, (b.x + b.width) / width, (b.y + b.height) / height, 0, 1});
    return parts;
  }

  void add_blocks(const StageThing& model, std::vector<Part>& parts) {
    if (model.base != nullptr) add_blocks(*model.base, parts);
    for (const StageThing& thing : model.things) {
      if (thing.built_in != "block") continue;
      count_stage_thing(thing, thing_count_);
      parts.push_back(read_block(thing));
    }
  }

  Part read_block(const StageThing& block) {
    std::vector<Point> points;
    for (const StageThing* at = &block; at != nullptr; at = at->base) {
      for (const StageProperty& property : at->properties) {
        if (!property.name.starts_with("point[")) continue;
        const std::vector<double> xy = stage_numbers(property, 2, 2);
        points.push_back({xy[0], xy[1]});
      }
    }
    const double count = stage_number_or(block, StageKey::points, 3, 1e5, static_cast<double>(points.size()));
    if (points.size() < 3 || static_cast<double>(points.size()) != count) {
      refuse(block.place, "expected a block of 'points' N (at least 3) with point[0] to point[N-1]");
    }
    Part part = {points[0].x, points[0].y, points[0].x, points[0].y, 0, 1};
    for (const Point p : points) {
      part.low_x = std::min(part.low_x, p.x);
      part.low_y = std::min(part.low_y, p.y);
      part.high_x = std::max(part.high_x, p.x);
      part.high_y = std::max(part.high_y, p.y);
    }
    if (const StageProperty* z = block.find(StageKey::z)) {
      const std::vector<double> heights = stage_numbers(*z, 2, 2);
      if (!(heights[0] < heights[1])) refuse(z->place, "expected heights [low high] in 'z'");
      part.low_z = heights[0];
      part.high_z = heights[1];
    }
    const bool corners = std::all_of(points.begin(), points.end(), [&](Point p) {
      return (p.x == part.low_x || p.x == part.high_x) && (p.y == part.low_y || p.y == part.high_y);
    });
    if (!corners || points.size() != 4) tell(block, "a 'block' that is no rectangle", "is taken as the box about it");
    return part;
  }

  static Shape shape_of(const Part& part, const Pose& middle, double z_m, const StageSize& size) {
    Shape shape;
    const Pose centre = {(0.5 * (part.low_x + part.high_x) - 0.5) * size.x_m,
                         (0.5 * (part.low_y + part.high_y) - 0.5) * size.y_m, 0};
    shape.pose = compose(middle, centre);
    shape.length_m = (part.high_x - part.low_x) * size.x_m;
    shape.width_m = (part.high_y - part.low_y) * size.y_m;
    shape.z_low_m = z_m + part.low_z * size.z_m;
    shape.z_high_m = z_m + part.high_z * size.z_m;
    return shape;
  }

  void add_boundary(const StageThing& model, const Pose& middle, double z_m, const StageSize& size,
                    const std::string& name) {
    const double x = 0.5 * size.x_m, y = 0.5 * size.y_m;
    const Point corners[] = {{-x, -y}, {x, -y}, {x, y}, {-x, y}};
    for (std::size_t i = 0; i < 4; ++i) {
      const Point from = transform(middle, corners[i]), to = transform(middle, corners[(i + 1) % 4]);
      add(model, wall_between(from, to, z_m, z_m + size.z_m), name);
    }
  }

  void add(const StageThing& model, const Shape& shape, const std::string& name) {
    if (world_.obstacles.size() == obstacle_count_max) {
      refuse(model.place, "expected at most " + std::to_string(obstacle_count_max) + " obstacles");
    }
    if (!(shape.length_m > 0 && shape.width_m > 0 && shape.z_high_m > shape.z_low_m)) {
      refuse(model.place, "expected a model with a volume");
    }
    std::size_t& count = name_counts_[name];
    world_.obstacles.push_back({count == 0 ? name : name + " " + std::to_string(count), shape, true});
    ++count;
  }

  // The given name, or one from its type; the second of a name gets "_2".
  std::string name_of_robot(const StageThing& thing) {
    const StageProperty* given = thing.find(StageKey::name);
    const std::string stem = given != nullptr ? stage_text(*given) : std::string(thing.type) + "_";
    std::string name;
    do {
      std::size_t& count = robot_counts_[stem];
      name = given != nullptr && count == 0 ? stem : stem + (given != nullptr ? "_" : "") + std::to_string(count);
      ++count;
    } while (!robot_names_.insert(name).second);
    return name;
  }

  LeftOut& left_out_;
  std::size_t thing_count_ = 0;
  std::int64_t pixel_count_ = 0;
  StageRobotReader robots_;
  StageWorld world_;
  std::set<const StageThing*> reported_;  // for membership only: the order of pointers varies from run to run
  std::map<std::string, std::size_t> name_counts_, robot_counts_;
  std::set<std::string> robot_names_;
};

}  // namespace

StageWorld parse_stage(const std::string& contents, const std::string& file, LeftOut& left_out) {
  const StageText text(contents, file);
  return StageReader(left_out).read(text.world());
}

}  // namespace waitpoint::world
