// SPDX-License-Identifier: BSD-3-Clause
// Embree: the walls of the solids as triangles, rays in coherent packets of 16. Discs are prisms of 16 sides. Static
// and moving solids are in two scenes, both queried, so that a step refits only the robots.
#include <embree3/rtcore.h>

#include <algorithm>
#include <array>

#include "core/error.hpp"
#include "tests/bench/world/contenders.hpp"

namespace waitpoint::bench {
namespace {

constexpr std::size_t packet = 16;

class ByEmbree : public Contender {
 public:
  explicit ByEmbree(const Place& place)
      : device_(rtcNewDevice("threads=1")), standing_(rtcNewScene(device_)), moving_(rtcNewScene(device_)) {
    WAITPOINT_CHECK(device_ != nullptr, "Embree does not start");
    rtcSetSceneBuildQuality(standing_, RTC_BUILD_QUALITY_HIGH);
    if (!place.obstacles.empty()) attach(standing_, place.obstacles, RTC_BUILD_QUALITY_HIGH);
    for (const world::MeshObstacle& mesh : place.meshes) attach(*mesh.mesh);
    if (place.robots.empty()) return;
    rtcSetSceneFlags(moving_, RTC_SCENE_FLAG_DYNAMIC);
    robots_ = attach(moving_, place.robots, RTC_BUILD_QUALITY_REFIT);
  }
  ~ByEmbree() override {
    rtcReleaseScene(standing_);
    rtcReleaseScene(moving_);
    rtcReleaseDevice(device_);
  }

  void place(std::span<const world::Shape> robots) override {
    if (robots_ == nullptr) return;
    write(static_cast<float*>(rtcGetGeometryBufferData(robots_, RTC_BUFFER_TYPE_VERTEX, 0)), robots);
    rtcUpdateGeometryBuffer(robots_, RTC_BUFFER_TYPE_VERTEX, 0);
    rtcCommitGeometry(robots_);
    rtcCommitScene(moving_);
  }

  void scan(const Pose& at, std::uint32_t own, std::span<double, beams> ranges_m) override {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    const auto [s, c] = exact::sincos(at.heading);
    for (std::size_t first = 0; first < beams; first += packet) {
      alignas(64) RTCRayHit16 rays;
      alignas(64) std::array<int, packet> valid;
      for (std::size_t k = 0; k < packet; ++k) {
        valid[k] = first + k < beams ? -1 : 0;
        const Point d = directions()[std::min(first + k, beams - 1)];
        rays.ray.org_x[k] = static_cast<float>(at.x);
        rays.ray.org_y[k] = static_cast<float>(at.y);
        rays.ray.org_z[k] = height_m;
        rays.ray.dir_x[k] = static_cast<float>(c * d.x - s * d.y);
        rays.ray.dir_y[k] = static_cast<float>(s * d.x + c * d.y);
        rays.ray.dir_z[k] = 0;
        rays.ray.tnear[k] = own == ~0u ? 0 : static_cast<float>(own_radius_m);
        rays.ray.tfar[k] = range_max_m;
        rays.ray.time[k] = 0;
        rays.ray.mask[k] = ~0u;
        rays.ray.flags[k] = 0;
        rays.hit.geomID[k] = RTC_INVALID_GEOMETRY_ID;
        rays.hit.instID[0][k] = RTC_INVALID_GEOMETRY_ID;
      }
      rtcIntersect16(valid.data(), standing_, &context, &rays);
      if (robots_ != nullptr) rtcIntersect16(valid.data(), moving_, &context, &rays);
      for (std::size_t k = 0; k < packet && first + k < beams; ++k)
        ranges_m[first + k] = static_cast<double>(rays.ray.tfar[k]);
    }
  }

 private:
  // Two vertices per corner: at the floor and at the top.
  static void write(float* to, std::span<const world::Shape> shapes) {
    for (const world::Shape& shape : shapes) {
      for (const Point& corner : corners(shape)) {
        for (const double z : {shape.z_low_m, shape.z_high_m}) {
          *to++ = static_cast<float>(corner.x);
          *to++ = static_cast<float>(corner.y);
          *to++ = static_cast<float>(z);
        }
      }
    }
  }

  void attach(const world::TriangleMesh& mesh) {
    RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    rtcSetGeometryBuildQuality(geometry, RTC_BUILD_QUALITY_HIGH);
    auto* corner = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                               3 * sizeof(float), mesh.corners.size()));
    for (const world::SpaceVector& c : mesh.corners)
      for (const double coordinate : {c.x, c.y, c.z}) *corner++ = static_cast<float>(coordinate);
    auto* number = static_cast<unsigned*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                                  3 * sizeof(unsigned), mesh.triangles.size()));
    for (const auto& triangle : mesh.triangles) number = std::copy(triangle.begin(), triangle.end(), number);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(standing_, geometry);
    rtcReleaseGeometry(geometry);  // the scene keeps it
    rtcCommitScene(standing_);
  }

  RTCGeometry attach(RTCScene scene, std::span<const world::Shape> shapes, RTCBuildQuality quality) {
    std::vector<unsigned> indices;
    unsigned base = 0;
    for (const world::Shape& shape : shapes) {
      const auto count = static_cast<unsigned>(corners(shape).size());
      for (unsigned i = 0; i < count; ++i) {
        const unsigned a = base + 2 * i, b = base + 2 * ((i + 1) % count);
        for (const unsigned vertex : {a, b, b + 1, a, b + 1, a + 1}) indices.push_back(vertex);
      }
      base += 2 * count;
    }
    RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    rtcSetGeometryBuildQuality(geometry, quality);
    write(static_cast<float*>(
              rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), base)),
          shapes);
    void* to = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(unsigned),
                                       indices.size() / 3);
    std::copy(indices.begin(), indices.end(), static_cast<unsigned*>(to));
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene, geometry);
    rtcReleaseGeometry(geometry);  // the scene keeps it
    rtcCommitScene(scene);
    return geometry;
  }

  RTCDevice device_;
  RTCScene standing_, moving_;
  RTCGeometry robots_ = nullptr;
};

}  // namespace

std::unique_ptr<Contender> embree(const Place& place) { return std::make_unique<ByEmbree>(place); }

}  // namespace waitpoint::bench
