// SPDX-License-Identifier: BSD-3-Clause
#include "world/formats/urdf.hpp"

#include <tinyxml2.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <map>
#include <string_view>
#include <utility>

#include "core/confinement.hpp"
#include "core/xml/xml_reader.hpp"
#include "world/formats/beside.hpp"
#include "world/formats/enclosing_solid.hpp"
#include "world/formats/limits.hpp"
#include "world/formats/mesh_file.hpp"
#include "world/formats/upright.hpp"

namespace waitpoint::world {
namespace {

using Element = XmlReader::Element;

constexpr std::size_t link_count_max = 10'000;
constexpr int folders_up_max = 32;

struct Link {
  const Element* element;
  std::string name;
  const Element* joint = nullptr;  // to its parent; null for the root
  std::vector<std::size_t> children;
};

class UrdfReader {
 public:
  UrdfReader(const std::string& contents, const std::string& file, LeftOut& left_out)
      : xml_(contents, file, "robot"),
        left_out_(left_out),
        xacro_(contents.find("<xacro:") == contents.npos ? ""
                                                         : "; xacro's elements are not expanded, run xacro first") {}

  UrdfRobot read() {
    robot_.name = xml_.text(xml_.root(), "name");
    read_links();
    read_joints();
    place(root(), {});
    read_solids("collision");
    if (solids_.empty()) {
      read_solids("visual");
      if (!solids_.empty()) tell(xml_.root(), "a <robot> without <collision>", "has the shape of its <visual>");
    }
    if (solids_.empty())
      xml_.fail(xml_.root(), "expected a <collision> or a <visual> in some <link>: the robot has no geometry" + xacro_);
    if (solids_.size() == 1) {
      robot_.shape = solids_[0];
    } else {
      const EnclosingSolid about = enclosing_solid(solids_);
      robot_.shape = about.shape;
      tell(xml_.root(), "a <robot> of several solids", "is taken as " + std::string(about.name));
    }
    stand_on_floor();
    return std::move(robot_);
  }

 private:
  void tell(const Element& element, std::string_view what, std::string_view consequence) {
    left_out_.add(xml_.file(), element.GetLineNum(), what, consequence);
  }
  void leave_out(const Element& element) { tell(element, "<" + std::string(element.Name()) + ">", "is left out"); }

  void read_links() {
    const Element* child = xml_.root().FirstChildElement();
    for (; child != nullptr; child = child->NextSiblingElement()) {
      const std::string_view kind = child->Name();
      if (kind == "link") {
        const std::string name = xml_.text(*child, "name");
        if (!numbers_.emplace(name, links_.size()).second) {
          xml_.fail(*child, "expected links of different names, '" + name + "' is there already");
        }
        if (links_.size() == link_count_max) {
          xml_.fail(*child, "expected at most " + std::to_string(link_count_max) + " links");
        }
        links_.push_back({child, name, nullptr, {}});
      } else if (kind != "joint") {
        leave_out(*child);
      }
    }
    if (links_.empty()) xml_.fail(xml_.root(), "expected a <link> in <robot>" + xacro_);
  }

  std::size_t link_of(const Element& joint, const char* end) const {
    const Element& element = xml_.required(joint, end);
    const std::string name = xml_.text(element, "link");
    const auto found = numbers_.find(name);
    if (found == numbers_.end()) xml_.fail(element, "expected a link of the robot, found '" + name + "'" + xacro_);
    return found->second;
  }

  void read_joints() {
    for (const Element* joint = xml_.root().FirstChildElement("joint"); joint != nullptr;
         joint = joint->NextSiblingElement("joint")) {
      const std::size_t parent = link_of(*joint, "parent");
      Link& child = links_[link_of(*joint, "child")];
      if (child.joint != nullptr) xml_.fail(*joint, "expected one joint above each link, '" + child.name + "' has two");
      child.joint = joint;
      links_[parent].children.push_back(static_cast<std::size_t>(&child - links_.data()));
      if (xml_.text(*joint, "type") != "fixed") tell(*joint, "a <joint> that is not fixed", "is held at 0");
    }
  }

  std::size_t root() const {
    std::size_t found = links_.size();
    for (std::size_t i = 0; i < links_.size(); ++i) {
      if (links_[i].joint != nullptr) continue;
      if (found != links_.size()) {
        xml_.fail(*links_[i].element, "expected one root: neither '" + links_[found].name + "' nor '" + links_[i].name +
                                          "' is the child of a joint" + xacro_);
      }
      found = i;
    }
    if (found == links_.size()) xml_.fail(*links_[0].element, "expected a tree of links, found a circle");
    return found;
  }

  // Does not reach links in a cycle apart from the tree.
  void place(std::size_t first, const SpacePose& pose) {
    std::vector<std::pair<std::size_t, SpacePose>> open = {{first, pose}};
    for (std::size_t next = 0; next < open.size(); ++next) {
      const auto [number, frame] = open[next];
      const Link& link = links_[number];
      robot_.frames.push_back({link.name, frame});
      placed_.push_back(link.element);
      for (const std::size_t child : link.children) open.emplace_back(child, origin(*links_[child].joint, frame));
    }
    if (open.size() == links_.size()) return;
    const auto is_apart = [&](const Link& link) {
      return std::none_of(robot_.frames.begin(), robot_.frames.end(),
                          [&](const UrdfFrame& frame) { return frame.link == link.name; });
    };
    const Link& apart = *std::find_if(links_.begin(), links_.end(), is_apart);
    xml_.fail(*apart.joint, "expected a tree of links, found a circle");
  }

  // The shapes of all elements of that name in the links.
  void read_solids(std::string_view kind) {
    for (std::size_t i = 0; i < placed_.size(); ++i) {
      for (const Element* child = placed_[i]->FirstChildElement(); child != nullptr;
           child = child->NextSiblingElement()) {
        if (child->Name() == kind) {
          const Element& geometry = xml_.required(*child, "geometry");
          const Element* shape = geometry.FirstChildElement();
          if (shape == nullptr) xml_.fail(geometry, "expected a shape in <geometry>");
          read_shape(*shape, origin(*child, robot_.frames[i].pose));
        } else if (kind == "collision") {
          leave_out(*child);
        }
      }
    }
  }

  void read_shape(const Element& shape, const SpacePose& pose) {
    const std::string_view kind = shape.Name();
    UprightSolid solid;
    if (kind == "box") {
      const std::array<double, 3> edges = xml_.numbers<3>(shape, "size");
      for (const double edge : edges)
        if (!(edge > 0)) xml_.fail(shape, "expected 'size' of <box> to be positive");
      solid = upright_box(pose, {edges[0], edges[1], edges[2]});
    } else if (kind == "cylinder") {
      const double radius = xml_.positive(shape, "radius");
      solid = upright_cylinder(pose, radius, xml_.positive(shape, "length"));
    } else if (kind == "sphere") {
      solid = upright_sphere(pose, xml_.positive(shape, "radius"));
    } else if (kind == "mesh") {
      return read_mesh(shape, pose);
    } else {
      return leave_out(shape);
    }
    solids_.push_back(solid.shape);
  }

  void read_mesh(const Element& mesh, const SpacePose& pose) {
    MeshPlacement placement;
    if (mesh.Attribute("scale") != nullptr) {
      const std::array<double, 3> scale = xml_.scale(mesh, "scale");
      placement.scale = {scale[0], scale[1], scale[2]};
    }
    const std::string uri = xml_.text(mesh, "filename"), file = found_file(uri);
    std::error_code error;
    if (file.empty() || !std::filesystem::is_regular_file(file, error)) {
      return tell(mesh, "the <mesh> '" + uri + "'", "is left out: there is no such file");
    }
    if (!reads_meshes_like(file)) {
      return tell(mesh, "the <mesh> '" + uri + "'", "is left out: this program does not read its kind");
    }
    if (++mesh_count_ > mesh_count_max)
      xml_.fail(mesh, "expected at most " + std::to_string(mesh_count_max) + " meshes");
    const std::vector<SpaceVector> corners = read_mesh_file(file, placement, left_out_).corners;
    std::vector<SpaceVector> placed;
    placed.reserve(corners.size());
    for (const SpaceVector& corner : corners) placed.push_back(pose.position + pose.turned(corner));
    if (const std::optional<Shape> hull = upright_hull(placed)) {
      tell(mesh, "a <mesh>", "is taken as the upright prism over its convex outline");
      solids_.push_back(*hull);
    } else {
      tell(mesh, "a <mesh>", "is taken as the box about it");
      solids_.push_back(enclosing_box(corners, pose));
    }
  }

  // Empty for a package that is not found.
  std::string found_file(const std::string& uri) const {
    namespace fs = std::filesystem;
    constexpr std::string_view file_scheme = "file://", package_scheme = "package://";
    if (!uri.starts_with(package_scheme)) {
      const std::string path = uri.starts_with(file_scheme) ? uri.substr(file_scheme.size()) : uri;
      std::string file = beside(xml_.file(), path);
      Confinement::require_allowed(file);
      return file;
    }
    const fs::path wanted = uri.substr(package_scheme.size());
    std::error_code error;
    fs::path folder = fs::absolute(xml_.file(), error).parent_path();
    for (int up = 0; up < folders_up_max && !folder.empty(); ++up, folder = folder.parent_path()) {
      const bool may_read = Confinement::allows(folder / wanted);
      if (may_read && fs::is_regular_file(folder / wanted, error)) return (folder / wanted).string();
      if (folder == folder.root_path()) break;
    }
    return "";
  }

  // The <origin> of a joint or a collision, in the outer frame.
  SpacePose origin(const Element& holder, const SpacePose& outer) const {
    const Element* element = holder.FirstChildElement("origin");
    if (element == nullptr) return outer;
    std::array<double, 3> xyz{}, rpy{};
    if (element->Attribute("xyz") != nullptr) xyz = xml_.numbers<3>(*element, "xyz");
    if (element->Attribute("rpy") != nullptr) rpy = xml_.numbers<3>(*element, "rpy");
    for (const double angle : rpy)
      if (std::fabs(angle) > angle_rad_max) xml_.fail(*element, "expected angles in radians in 'rpy' of <origin>");
    const SpacePose pose = compose(outer, space_pose({xyz[0], xyz[1], xyz[2]}, rpy[0], rpy[1], rpy[2]));
    if (!pose.position.is_within(coordinate_m_max)) xml_.fail(*element, "expected an <origin> within 100 km");
    return pose;
  }

  void stand_on_floor() {
    const double below_m = -std::min(robot_.shape.z_low_m, 0.0);
    robot_.shape.z_low_m += below_m;
    robot_.shape.z_high_m += below_m;
    for (UrdfFrame& frame : robot_.frames) frame.pose.position.z += below_m;
  }

  XmlReader xml_;
  LeftOut& left_out_;
  UrdfRobot robot_;
  std::string xacro_;  // the end of messages about what a file lacks
  std::vector<Link> links_;
  std::vector<const Element*> placed_;          // the links of the frames
  std::map<std::string, std::size_t> numbers_;  // of the links, by name
  std::vector<Shape> solids_;
  std::size_t mesh_count_ = 0;
};

}  // namespace

UrdfRobot parse_urdf(const std::string& contents, const std::string& file, LeftOut& left_out,
                     const XacroArguments& arguments) {
  return UrdfReader(with_xacro_arguments(contents, file, arguments, left_out), file, left_out).read();
}

}  // namespace waitpoint::world
