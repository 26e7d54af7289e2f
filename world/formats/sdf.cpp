// SPDX-License-Identifier: BSD-3-Clause
#include "world/formats/sdf.hpp"

#include <tinyxml2.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <string_view>
#include <utility>

#include "core/confinement.hpp"
#include "core/error.hpp"
#include "core/exact_math.hpp"
#include "core/xml/xml_reader.hpp"
#include "world/formats/beside.hpp"
#include "world/formats/included_files.hpp"
#include "world/formats/limits.hpp"
#include "world/formats/mesh_file.hpp"
#include "world/formats/upright.hpp"

namespace waitpoint::world {
namespace {

using Element = XmlReader::Element;

constexpr std::string_view model_scheme = "model://";

class SdfReader {
 public:
  SdfReader(IncludedFiles& included, LeftOut& left_out) : included_(included), left_out_(left_out) {}

  // A file's first world, or the models of a file without one.
  void read(const std::string& contents, const std::string& file, const SpacePose& outer, const std::string& name) {
    const XmlReader document(contents, file, "sdf");
    const XmlReader* const above = std::exchange(xml_, &document);
    const Element* root = &document.root();
    const Element* world = root->FirstChildElement("world");
    for (const Element* child = root->FirstChildElement(); child != nullptr; child = child->NextSiblingElement()) {
      if (child == world) {
        read_parts(*world, outer, name);
      } else if (!read_part(*child, outer, name)) {
        leave_out(*child);
      }
    }
    xml_ = above;
  }

  SdfWorld world() { return std::move(world_); }

 private:
  void leave_out(const Element& element) {
    left_out_.add(xml_->file(), element.GetLineNum(), "<" + std::string(element.Name()) + ">", "is left out");
  }
  void tell(const Element& element, std::string_view what, std::string_view consequence) {
    left_out_.add(xml_->file(), element.GetLineNum(), what, consequence);
  }

  void read_parts(const Element& holder, const SpacePose& outer, const std::string& name) {
    for (const Element* child = holder.FirstChildElement(); child != nullptr; child = child->NextSiblingElement())
      if (!read_part(*child, outer, name)) leave_out(*child);
  }

  // False for an element that is neither a model nor an include. `name` is an include's name for its models; may be
  // empty.
  bool read_part(const Element& element, const SpacePose& outer, const std::string& name) {
    const std::string_view kind = element.Name();
    if (kind == "model") {
      read_model(element, outer, name);
    } else if (kind == "include") {
      read_include(element, outer);
    } else {
      return false;
    }
    return true;
  }

  void read_model(const Element& model, const SpacePose& outer, const std::string& given) {
    SpacePose pose;
    if (!read_pose(model, outer, pose)) return;
    const char* own = model.Attribute("name");
    const std::string name = !given.empty() ? given : own != nullptr ? own : "model";
    const std::string above = std::exchange(model_, name);
    const std::size_t count_above = std::exchange(count_, 0);
    bool is_static = false;
    for (const Element* child = model.FirstChildElement(); child != nullptr; child = child->NextSiblingElement()) {
      const std::string_view kind = child->Name();
      if (kind == "static") {
        is_static = xml_->flag(*child);
      } else if (kind == "link") {
        read_link(*child, pose);
      } else if (kind != "pose" && !read_part(*child, pose, "")) {
        leave_out(*child);
      }
    }
    if (!is_static && count_ > 0) tell(model, "a model that is not <static>", "is fixed here");
    model_ = above;
    count_ = count_above;
  }

  void read_link(const Element& link, const SpacePose& outer) {
    SpacePose pose;
    if (!read_pose(link, outer, pose)) return;
    for (const Element* child = link.FirstChildElement(); child != nullptr; child = child->NextSiblingElement()) {
      const std::string_view kind = child->Name();
      if (kind == "collision") {
        read_collision(*child, pose);
      } else if (kind != "pose") {
        leave_out(*child);
      }
    }
  }

  void read_collision(const Element& collision, const SpacePose& outer) {
    SpacePose pose;
    if (!read_pose(collision, outer, pose)) return;
    for (const Element* child = collision.FirstChildElement(); child != nullptr; child = child->NextSiblingElement()) {
      const std::string_view kind = child->Name();
      if (kind == "geometry") {
        const Element* shape = child->FirstChildElement();
        if (shape == nullptr) xml_->fail(*child, "expected a shape in <geometry>");
        read_shape(*shape, pose);
      } else if (kind != "pose") {
        leave_out(*child);
      }
    }
  }

  void read_shape(const Element& shape, const SpacePose& pose) {
    const std::string_view kind = shape.Name();
    if (kind == "box") {
      const Element& size = xml_->required(shape, "size");
      const std::array<double, 3> edges = xml_->numbers<3>(size);
      for (const double edge : edges)
        if (!(edge > 0)) xml_->fail(size, "expected <size> to be positive");
      add(shape, upright_box(pose, {edges[0], edges[1], edges[2]}));
    } else if (kind == "cylinder") {
      const double radius = xml_->positive(xml_->required(shape, "radius"));
      add(shape, upright_cylinder(pose, radius, xml_->positive(xml_->required(shape, "length"))));
    } else if (kind == "sphere") {
      add(shape, upright_sphere(pose, xml_->positive(xml_->required(shape, "radius"))));
    } else if (kind == "mesh") {
      read_mesh(shape, pose);
    } else if (kind == "plane") {
      read_plane(shape, pose);
    } else {
      leave_out(shape);
    }
  }

  void read_plane(const Element& plane, const SpacePose& pose) {
    SpaceVector normal = {0, 0, 1};
    if (const Element* given = plane.FirstChildElement("normal")) {
      const std::array<double, 3> n = xml_->numbers<3>(*given);
      normal = {n[0], n[1], n[2]};
    }
    normal = pose.turned(normal);
    const bool level = std::fabs(normal.z) > 0 && std::hypot(normal.x, normal.y) < tilt_max_rad * std::fabs(normal.z);
    tell(plane, level ? "a level <plane>" : "a <plane> that is not level",
         level ? "is left out: robots drive on the floor, at height 0" : "is left out");
  }

  void read_mesh(const Element& mesh, const SpacePose& pose) {
    MeshPlacement placement = {{1, 1, 1}, pose};
    for (const Element* child = mesh.FirstChildElement(); child != nullptr; child = child->NextSiblingElement()) {
      const std::string_view kind = child->Name();
      if (kind == "scale") {
        const std::array<double, 3> scale = xml_->scale(*child);
        placement.scale = {scale[0], scale[1], scale[2]};
      } else if (kind == "submesh") {
        return tell(mesh, "a <mesh> with a <submesh>", "is left out");
      } else if (kind != "uri") {
        leave_out(*child);
      }
    }
    const std::string uri = xml_->text(xml_->required(mesh, "uri")), file = found_file(uri);
    std::error_code error;
    if (file.empty() || !std::filesystem::is_regular_file(file, error)) {
      return tell(mesh, "the <mesh> '" + uri + "'", "is left out: there is no such file");
    }
    if (!reads_meshes_like(file)) {
      return tell(mesh, "the <mesh> '" + uri + "'", "is left out: this program does not read its kind");
    }
    add(mesh, read_mesh_file(file, placement, left_out_));
  }

  void add(const Element& element, TriangleMesh mesh) {
    const auto is_above = [](const SpaceVector& corner) { return corner.z > 0; };
    if (std::none_of(mesh.corners.begin(), mesh.corners.end(), is_above)) {
      return tell(element, "an obstacle below the floor", "is left out");
    }
    triangle_count_ += mesh.triangles.size();
    if (triangle_count_ > triangle_count_max || world_.meshes.size() == mesh_count_max) {
      xml_->fail(element, "expected at most " + std::to_string(mesh_count_max) + " meshes, of " +
                              std::to_string(triangle_count_max) + " triangles in all");
    }
    world_.meshes.push_back({next_name(), std::make_shared<const TriangleMesh>(std::move(mesh)), true});
  }

  // The model's name, with a number from its second part on.
  std::string next_name() {
    const std::size_t number = count_++;
    return number == 0 ? model_ : model_ + " " + std::to_string(number);
  }

  void add(const Element& element, const UprightSolid& solid) {
    if (solid.shape.z_high_m <= 0) {
      tell(element, "an obstacle below the floor", "is left out");
      return;
    }
    const std::string_view kind = element.Name();
    if (!solid.exact && kind == "sphere") {
      tell(element, "a <sphere>", "is taken as the upright cylinder about it");
    } else if (!solid.exact) {
      tell(element, "a tilted <" + std::string(kind) + ">", "is taken as the upright box about it");
    }
    if (world_.obstacles.size() == obstacle_count_max) {
      xml_->fail(element, "expected at most " + std::to_string(obstacle_count_max) + " obstacles");
    }
    world_.obstacles.push_back({next_name(), solid.shape, true});
  }

  void read_include(const Element& include, const SpacePose& outer) {
    SpacePose pose;
    if (!read_pose(include, outer, pose)) return;
    std::string name;
    for (const Element* child = include.FirstChildElement(); child != nullptr; child = child->NextSiblingElement()) {
      const std::string_view kind = child->Name();
      if (kind == "name") {
        name = xml_->text(*child);
      } else if (kind == "static") {
        xml_->flag(*child);
      } else if (kind != "uri" && kind != "pose") {
        leave_out(*child);
      }
    }
    const Element& uri = xml_->required(include, "uri");
    const std::string file = included_file(uri);
    if (file.empty()) return;
    const std::string from = xml_->file();
    read(included_.enter(file, from, uri.GetLineNum()), file, pose, name);
    included_.leave();
  }

  // The file of a URI, or the model of a folder; empty for a model:// that is not found, and for other schemes.
  std::string found_file(const std::string& uri) const {
    namespace fs = std::filesystem;
    std::error_code error;
    constexpr std::string_view file_scheme = "file://";
    if (!uri.starts_with(model_scheme)) {
      if (uri.find("://") != uri.npos && !uri.starts_with(file_scheme)) return "";
      const std::string path = uri.starts_with(file_scheme) ? uri.substr(file_scheme.size()) : uri;
      const std::string file = beside(xml_->file(), path);
      Confinement::require_allowed(file);
      return fs::is_directory(file, error) ? (fs::path(file) / "model.sdf").string() : file;
    }
    const std::string model = uri.substr(model_scheme.size());
    for (const char* folder : {"", "models", "../models", ".."}) {
      const fs::path path = beside(xml_->file(), (fs::path(folder) / model).string());
      if (!Confinement::allows(path)) continue;
      if (fs::is_regular_file(path, error)) return path.string();
      if (fs::is_regular_file(path / "model.sdf", error)) return (path / "model.sdf").string();
    }
    return "";
  }

  // The file of an <include>'s <uri>; empty, with a warning, for one that is not on this machine.
  std::string included_file(const Element& element) {
    const std::string uri = xml_->text(element);
    std::string file = found_file(uri);
    if (!file.empty()) return file;
    if (uri == "model://sun" || uri == "model://ground_plane") {
      tell(element, "'" + uri + "'", "is left out");
    } else if (uri.starts_with(model_scheme)) {
      tell(element, "'" + uri + "'", "is left out: it is not beside the file, in 'models' or in '../models'");
    } else {
      tell(element, "'" + uri + "'", "is left out: only files are read");
    }
    return "";
  }

  // The element's own <pose> in the outer frame. False, with a warning, if it refers to a named frame.
  bool read_pose(const Element& holder, const SpacePose& outer, SpacePose& pose) {
    const Element* element = holder.FirstChildElement("pose");
    pose = outer;
    if (element == nullptr) return true;
    for (const char* attribute : {"frame", "relative_to"}) {
      const char* frame = element->Attribute(attribute);
      if (frame == nullptr || *frame == '\0') continue;
      tell(*element, "an element with a <pose> in a named frame", "is left out");
      return false;
    }
    if (XmlReader::text_or_nothing(*element).empty()) return true;
    std::array<double, 6> p = xml_->numbers<6>(*element);
    const char* degrees = element->Attribute("degrees");
    const bool in_degrees = degrees != nullptr && std::string_view(degrees) == "true";
    for (std::size_t i = 3; in_degrees && i < 6; ++i) p[i] = p[i] / 180 * exact::pi;
    for (std::size_t i = 3; i < 6; ++i)
      if (std::fabs(p[i]) > angle_rad_max) xml_->fail(*element, "expected angles in radians in <pose>");
    pose = compose(outer, space_pose({p[0], p[1], p[2]}, p[3], p[4], p[5]));
    if (!pose.position.is_within(coordinate_m_max)) {
      xml_->fail(*element, "expected a <pose> within 100 km of the world's origin");
    }
    return true;
  }

  IncludedFiles& included_;
  LeftOut& left_out_;
  const XmlReader* xml_ = nullptr;  // of the current file
  std::string model_;               // the current model,
  std::size_t count_ = 0;           // and the number of its solids so far
  std::size_t triangle_count_ = 0;  // of all meshes
  SdfWorld world_;
};

}  // namespace

SdfWorld parse_sdf(const std::string& contents, const std::string& file, LeftOut& left_out) {
  IncludedFiles included(file, contents, tree_bytes_max);
  SdfReader reader(included, left_out);
  reader.read(contents, file, {}, "");
  return reader.world();
}

}  // namespace waitpoint::world
