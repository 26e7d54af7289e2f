// SPDX-License-Identifier: BSD-3-Clause
#include "world/formats/map_server.hpp"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <string_view>
#include <vector>

#include "core/confinement.hpp"
#include "core/error.hpp"
#include "core/file_contents.hpp"
#include "core/nearest_name.hpp"
#include "world/formats/beside.hpp"
#include "world/formats/image_file.hpp"
#include "world/formats/limits.hpp"

namespace waitpoint::world {
namespace {

enum class Mode { trinary, scale, raw };

struct MapFile {
  std::string image;  // its path
  double resolution_m = 0;
  Pose origin;
  bool negate = false;
  double occupied_threshold = 0.65, free_threshold = 0.196;
  Mode mode = Mode::trinary;
};

constexpr std::array<std::string_view, 7> known_keys = {"image",           "resolution",  "origin", "negate",
                                                        "occupied_thresh", "free_thresh", "mode"};

class MapFileReader {
 public:
  MapFileReader(const std::string& contents, const std::string& file, LeftOut& left_out)
      : contents_(contents), file_(file), left_out_(left_out) {}

  MapFile read() {
    const YAML::Node root = load();
    if (!root.IsMap()) fail(root, "expected a map's keys: image, resolution, origin, ...");
    check_keys(root);
    MapFile map;
    map.image = image_file(required(root, "image"));
    map.resolution_m = number(required(root, "resolution"), "resolution");
    if (!(map.resolution_m >= 1e-4 && map.resolution_m <= 1e3))
      fail(root["resolution"], "resolution: expected metres a pixel, from 0.0001 to 1000");
    map.origin = pose(required(root, "origin"));
    if (root["negate"]) map.negate = flag(root["negate"]);
    if (root["occupied_thresh"]) map.occupied_threshold = threshold(root, "occupied_thresh");
    if (root["free_thresh"]) map.free_threshold = threshold(root, "free_thresh");
    if (map.free_threshold > map.occupied_threshold) {
      tell(root[root["free_thresh"] ? "free_thresh" : "occupied_thresh"], "'free_thresh' above 'occupied_thresh'",
           "leaves no cell unknown");
    }
    if (root["mode"]) map.mode = mode(root["mode"]);
    return map;
  }

 private:
  [[noreturn]] void fail(const YAML::Node& at, const std::string& message) const {
    throw BadInput(file_, line_of(at), message);
  }
  void tell(const YAML::Node& at, const std::string& what, const std::string& consequence) const {
    left_out_.add(file_, line_of(at), what, consequence);
  }
  static int line_of(const YAML::Node& at) { return std::max(at.Mark().line + 1, 1); }

  YAML::Node load() const {
    if (contents_.size() > yaml_bytes_max) {
      throw BadInput(file_,
                     "expected a map_server YAML file of at most " + std::to_string(yaml_bytes_max >> 20) + " MiB");
    }
    try {
      return YAML::Load(contents_);
    } catch (const YAML::Exception& e) {
      throw BadInput(file_, std::max(e.mark.line + 1, 1), "expected YAML: " + e.msg);
    }
  }

  void check_keys(const YAML::Node& root) const {
    std::vector<std::string> seen;
    for (const auto& entry : root) {
      const std::string key = text(entry.first, "a key");
      if (std::find(known_keys.begin(), known_keys.end(), key) == known_keys.end()) {
        tell(entry.first, "the key '" + key + "'", "is left out" + did_you_mean(key, known_keys));
        continue;
      }
      if (std::find(seen.begin(), seen.end(), key) != seen.end())
        fail(entry.first, "the key '" + key + "' comes twice");
      seen.push_back(key);
    }
  }

  YAML::Node required(const YAML::Node& root, const char* key) const {
    if (!root[key]) fail(root, std::string("expected the key '") + key + "'");
    return root[key];
  }

  std::string text(const YAML::Node& node, const std::string& what) const {
    if (!node.IsScalar() || node.Scalar().empty()) fail(node, what + ": expected a text");
    return node.Scalar();
  }

  double number(const YAML::Node& node, const std::string& what) const {
    double value = 0;
    if (!node.IsScalar() || !YAML::convert<double>::decode(node, value) || !std::isfinite(value)) {
      fail(node, what + ": expected a number");
    }
    return value;
  }

  double threshold(const YAML::Node& root, const char* key) const {
    const double value = number(root[key], key);
    if (value < 0 || value > 1) fail(root[key], std::string(key) + ": expected a probability from 0 to 1");
    return value;
  }

  Pose pose(const YAML::Node& node) const {
    if (!node.IsSequence() || node.size() != 3) fail(node, "origin: expected [x, y, yaw] in metres and radians");
    const Pose pose = {number(node[0], "origin"), number(node[1], "origin"), number(node[2], "origin")};
    if (std::fabs(pose.x) > 1e7 || std::fabs(pose.y) > 1e7) fail(node, "origin: expected metres within 10000 km");
    if (std::fabs(pose.heading) > 1e6) fail(node, "origin: expected a yaw in radians");
    return pose;
  }

  bool flag(const YAML::Node& node) const {
    const std::string value = text(node, "negate");
    if (value == "0" || value == "false") return false;
    if (value == "1" || value == "true") return true;
    fail(node, "negate: expected 0 or 1");
  }

  Mode mode(const YAML::Node& node) const {
    const std::string value = text(node, "mode");
    if (value == "trinary") return Mode::trinary;
    if (value == "scale") return Mode::scale;
    if (value == "raw") return Mode::raw;
    fail(node, "mode: expected trinary, scale or raw");
  }

  // The image; one that is not there, as after a move of the map from another machine, is sought beside the file.
  std::string image_file(const YAML::Node& named) const {
    namespace fs = std::filesystem;
    const std::string given = text(named, "image"), file = beside(file_, given);
    std::error_code error;
    const auto is_there = [&](const std::string& path) { return Confinement::allows(path) && fs::exists(path, error); };
    const std::string near = beside(file_, fs::path(given).filename().string());
    if (is_there(file) || near == file || !is_there(near)) return file;
    tell(named, "'" + given + "', which is not there,", "is read from beside the map");
    return near;
  }

  const std::string& contents_;
  const std::string& file_;
  LeftOut& left_out_;
};

Cell cell_of(const MapFile& map, int grey) {
  const int darkness = map.negate ? grey : 255 - grey;
  if (map.mode == Mode::raw && grey > 100) return Cell::unknown;
  const double probability = map.mode == Mode::raw ? grey / 100.0 : darkness / 255.0;
  if (probability > map.occupied_threshold) return Cell::occupied;
  return probability < map.free_threshold ? Cell::free : Cell::unknown;
}

}  // namespace

OccupancyGrid read_map_server_map(const std::string& yaml_file) {
  LeftOut left_out;
  return parse_map_server_map(file_contents(yaml_file, "a map_server YAML file", yaml_bytes_max), yaml_file, left_out);
}

OccupancyGrid parse_map_server_map(const std::string& contents, const std::string& yaml_file, LeftOut& left_out) {
  const MapFile map = MapFileReader(contents, yaml_file, left_out).read();
  const GreyImage image = read_grey_image(map.image);
  std::array<Cell, 256> cells;
  for (int grey = 0; grey < 256; ++grey) cells[static_cast<std::size_t>(grey)] = cell_of(map, grey);
  OccupancyGrid grid(image.width, image.height, map.resolution_m, map.origin);
  std::size_t pixel = 0;
  for (int y = image.height - 1; y >= 0; --y) {
    for (int x = 0; x < image.width; ++x, ++pixel) {
      const bool hidden = map.mode == Mode::scale && !image.transparency.empty() && image.transparency[pixel] != 0;
      grid[{x, y}] = hidden ? Cell::unknown : cells[image.grey[pixel]];
    }
  }
  return grid;
}

}  // namespace waitpoint::world
