// SPDX-License-Identifier: BSD-3-Clause
#include "tools/record/foxglove.hpp"

#include <nlohmann/json.hpp>

namespace waitpoint::tools::foxglove {
namespace {

using Json = nlohmann::ordered_json;

constexpr int information = 2, warning = 3;  // levels of foxglove.Log

Json number() { return {{"type", "number"}}; }
Json whole() { return {{"type", "integer"}}; }
Json text() { return {{"type", "string"}}; }
Json flag() { return {{"type", "boolean"}}; }
Json list(const Json& items) { return {{"type", "array"}, {"items", items}}; }
Json object(const Json& properties) { return {{"type", "object"}, {"properties", properties}}; }

Json instant() { return object({{"sec", whole()}, {"nsec", whole()}}); }
Json vector() { return object({{"x", number()}, {"y", number()}, {"z", number()}}); }
Json quaternion() { return object({{"x", number()}, {"y", number()}, {"z", number()}, {"w", number()}}); }
Json placement() { return object({{"position", vector()}, {"orientation", quaternion()}}); }
Json colour() { return object({{"r", number()}, {"g", number()}, {"b", number()}, {"a", number()}}); }

Schema schema(const std::string& name, const Json& properties) {
  Json all = object(properties);
  all["title"] = "foxglove." + name;
  return {"foxglove." + name, all.dump()};
}

Json of(Time time) {
  constexpr std::int64_t second = 1'000'000'000;
  return {{"sec", time.ns() / second}, {"nsec", time.ns() % second}};
}
Json of(double x, double y, double z) { return {{"x", x}, {"y", y}, {"z", z}}; }
Json turned_by(double heading_rad) {
  const auto [s, c] = exact::sincos(heading_rad / 2);
  return {{"x", 0.0}, {"y", 0.0}, {"z", s}, {"w", c}};
}
Json of(const Pose& pose, double z_m = 0) {
  return {{"position", of(pose.x, pose.y, z_m)}, {"orientation", turned_by(pose.heading)}};
}

Json grey() { return {{"r", 0.6}, {"g", 0.6}, {"b", 0.65}, {"a", 1.0}}; }

}  // namespace

Schema clock() {
  Json all{{"title", "waitpoint.Clock"}};
  all.update(object({{"clock", instant()}}));
  return {"waitpoint.Clock", all.dump()};
}

std::string clock(Time time) { return Json{{"clock", of(time)}}.dump(); }

Schema frame_transform() {
  return schema("FrameTransform", {{"timestamp", instant()},
                                   {"parent_frame_id", text()},
                                   {"child_frame_id", text()},
                                   {"translation", vector()},
                                   {"rotation", quaternion()}});
}

std::string frame_transform(Time time, const std::string& parent, const std::string& child, const Pose& pose,
                            double z_m) {
  return Json{{"timestamp", of(time)},
              {"parent_frame_id", parent},
              {"child_frame_id", child},
              {"translation", of(pose.x, pose.y, z_m)},
              {"rotation", turned_by(pose.heading)}}
      .dump();
}

Schema laser_scan() {
  return schema("LaserScan", {{"timestamp", instant()},
                              {"frame_id", text()},
                              {"pose", placement()},
                              {"start_angle", number()},
                              {"end_angle", number()},
                              {"ranges", list(number())},
                              {"intensities", list(number())}});
}

std::string laser_scan(const posters::LaserReading& scan, const std::string& frame) {
  Json ranges = Json::array();
  for (const float range : scan.range_m) ranges.push_back(range);
  const auto steps = static_cast<double>(scan.range_m.size() > 0 ? scan.range_m.size() - 1 : 0);
  return Json{{"timestamp", of(scan.date)},
              {"frame_id", frame},
              {"pose", of(Pose())},
              {"start_angle", scan.first_angle_rad},
              {"end_angle", scan.first_angle_rad + steps * scan.angle_step_rad},
              {"ranges", std::move(ranges)},
              {"intensities", Json::array()}}
      .dump();
}

Schema log() {
  return schema("Log", {{"timestamp", instant()},
                        {"level", whole()},
                        {"message", text()},
                        {"name", text()},
                        {"file", text()},
                        {"line", whole()}});
}

std::string log(Time time, const std::string& who, const std::string& words, bool is_warning) {
  return Json{{"timestamp", of(time)},
              {"level", is_warning ? warning : information},
              {"message", words},
              {"name", who},
              {"file", ""},
              {"line", 0}}
      .dump();
}

Schema pose_in_frame() {
  return schema("PoseInFrame", {{"timestamp", instant()}, {"frame_id", text()}, {"pose", placement()}});
}

std::string pose_in_frame(Time time, const std::string& frame, const Pose& pose) {
  return Json{{"timestamp", of(time)}, {"frame_id", frame}, {"pose", of(pose)}}.dump();
}

Schema poses_in_frame() {
  return schema("PosesInFrame", {{"timestamp", instant()}, {"frame_id", text()}, {"poses", list(placement())}});
}

std::string poses_in_frame(Time time, const std::string& frame, std::span<const Pose> poses) {
  Json all = Json::array();
  for (const Pose& pose : poses) all.push_back(of(pose));
  return Json{{"timestamp", of(time)}, {"frame_id", frame}, {"poses", std::move(all)}}.dump();
}

Schema scene_update() {
  const Json cube = object({{"pose", placement()}, {"size", vector()}, {"color", colour()}});
  const Json cylinder = object({{"pose", placement()},
                                {"size", vector()},
                                {"bottom_scale", number()},
                                {"top_scale", number()},
                                {"color", colour()}});
  const Json entity = object({{"timestamp", instant()},
                              {"frame_id", text()},
                              {"id", text()},
                              {"lifetime", instant()},
                              {"frame_locked", flag()},
                              {"cubes", list(cube)},
                              {"cylinders", list(cylinder)}});
  return schema("SceneUpdate", {{"entities", list(entity)}});
}

std::string scene_update(Time time, const std::string& frame, std::span<const world::Shape> shapes) {
  Json cubes = Json::array(), cylinders = Json::array();
  for (const world::Shape& shape : shapes) {
    const double height_m = shape.z_high_m - shape.z_low_m;
    Json part{{"pose", of(shape.pose, (shape.z_low_m + shape.z_high_m) / 2)}};
    if (shape.kind != world::Shape::Kind::cylinder) {
      part["size"] = of(shape.length_m, shape.width_m, height_m);
    } else {
      part["size"] = of(2 * shape.radius_m, 2 * shape.radius_m, height_m);
      part["bottom_scale"] = part["top_scale"] = 1.0;
    }
    part["color"] = grey();
    (shape.kind != world::Shape::Kind::cylinder ? cubes : cylinders).push_back(std::move(part));
  }
  const Json entity{{"timestamp", of(time)},
                    {"frame_id", frame},
                    {"id", "world"},
                    {"lifetime", of(Time())},
                    {"frame_locked", true},
                    {"cubes", std::move(cubes)},
                    {"cylinders", std::move(cylinders)}};
  return Json{{"entities", Json::array({entity})}}.dump();
}

}  // namespace waitpoint::tools::foxglove
