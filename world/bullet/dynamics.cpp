// SPDX-License-Identifier: BSD-3-Clause
#include "world/bullet/dynamics.hpp"

#include <algorithm>
#include <deque>
#include <optional>

#include "core/exact_math.hpp"
#include "world/bullet/bullet_shapes.hpp"
#include "world/bullet/hull.hpp"

namespace waitpoint::world {
namespace {

// A body slower than this for two seconds (Bullet's default) is at rest.
constexpr double rest_m_s = 1e-3, rest_rad_s = 1e-3;
constexpr int iterations = 50;
// Triangles of a mesh up to this height are floor, on which wheels roll.
constexpr double floor_m = 1e-3;

enum Group : int { of_floor = 1, of_standing = 2, of_rolling = 4, of_flying = 8, of_loose = 16 };

// In place of Bullet's integration, which uses the C library's sine: its bits depend on the processor.
btQuaternion turned(const btQuaternion& now, const btVector3& spin_rad_s, double step_s) {
  const double rate = spin_rad_s.length();
  if (rate == 0) return now;
  const auto [s, c] = exact::sincos(0.5 * rate * step_s);
  const btVector3 axis = (s / rate) * spin_rad_s;
  return (btQuaternion(axis.x(), axis.y(), axis.z(), c) * now).normalized();
}

struct Standing {
  std::unique_ptr<btCollisionShape> shape;
  btCollisionObject object;

  Standing(std::unique_ptr<btCollisionShape> of, const btTransform& at) : shape(std::move(of)) {
    object.setCollisionShape(shape.get());
    object.setWorldTransform(at);
    object.setFriction(1);
  }
};

struct StandingMesh {
  btTriangleMesh triangles;
  std::optional<Standing> standing;  // none if all of it is floor

  explicit StandingMesh(const TriangleMesh& mesh) {
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
      const Triangle triangle = mesh.triangle(i);
      if (triangle.high_m() <= floor_m) continue;
      triangles.addTriangle(vector(triangle.corners[0]), vector(triangle.corners[1]), vector(triangle.corners[2]));
    }
    if (triangles.getNumTriangles() > 0)
      standing.emplace(std::make_unique<btBvhTriangleMeshShape>(&triangles, true), btTransform::getIdentity());
  }
  StandingMesh(const StandingMesh&) = delete;
  StandingMesh& operator=(const StandingMesh&) = delete;
};

struct Loose {
  LooseSolid solid;
  std::unique_ptr<btCollisionShape> shape;
  btRigidBody body;

  explicit Loose(const LooseSolid& s)
      : solid(s), shape(collision_shape(s.kind, s.size_m)), body(info(s.mass_kg, shape.get())) {
    body.setFriction(s.friction);
    body.setSleepingThresholds(rest_m_s, rest_rad_s);
    const auto& a = s.pose.axes;
    const btMatrix3x3 axes(a[0].x, a[1].x, a[2].x, a[0].y, a[1].y, a[2].y, a[0].z, a[1].z, a[2].z);
    body.setWorldTransform(btTransform(axes, vector(s.pose.position)));
    body.setLinearVelocity(vector(s.velocity_m_s));
    body.setAngularVelocity(vector(s.spin_rad_s));
  }
  static btRigidBody::btRigidBodyConstructionInfo info(double mass_kg, btCollisionShape* shape) {
    btVector3 inertia;
    shape->calculateLocalInertia(mass_kg, inertia);
    return {mass_kg, nullptr, shape, inertia};
  }

  void read() {
    const btTransform& at = body.getWorldTransform();
    solid.pose.position = space_vector(at.getOrigin());
    for (int i = 0; i < 3; ++i) solid.pose.axes[static_cast<std::size_t>(i)] = space_vector(at.getBasis().getColumn(i));
    solid.velocity_m_s = space_vector(body.getLinearVelocity());
    solid.spin_rad_s = space_vector(body.getAngularVelocity());
  }
};

class BulletSteps final : public btDiscreteDynamicsWorld {
 public:
  using btDiscreteDynamicsWorld::btDiscreteDynamicsWorld;

 private:
  // As in Bullet, but with exact sines.
  void integrateTransforms(btScalar step_s) override {
    for (int i = 0; i < m_nonStaticRigidBodies.size(); ++i) {
      btRigidBody& body = *m_nonStaticRigidBodies[i];
      if (!body.isActive()) continue;
      btTransform at = body.getWorldTransform();
      at.setOrigin(at.getOrigin() + step_s * body.getLinearVelocity());
      at.setRotation(turned(at.getRotation(), body.getAngularVelocity(), step_s));
      body.proceedToTransform(at);
    }
  }
};

}  // namespace

struct Dynamics::Bodies {
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher{&configuration};
  btDbvtBroadphase broad_phase;
  btSequentialImpulseConstraintSolver solver;
  btStaticPlaneShape plane{{0, 0, 1}, 0};
  btCollisionObject floor;
  std::deque<Standing> standing;
  std::deque<StandingMesh> meshes;
  std::deque<Hull> hulls;  // Bullet keeps their addresses
  std::deque<Loose> loose;
  BulletSteps steps{&dispatcher, &broad_phase, &solver, &configuration};

  Bodies(std::span<const Shape> shapes, std::span<const MeshObstacle> of_meshes) {
    // Contacts within 2 cm, for bodies of any size: an approach of less per step is found before an overlap.
    dispatcher.setDispatcherFlags(dispatcher.getDispatcherFlags() &
                                  ~btCollisionDispatcher::CD_USE_RELATIVE_CONTACT_BREAKING_THRESHOLD);
    steps.setGravity({0, 0, -gravity_m_s2});
    steps.getDispatchInfo().m_deterministicOverlappingPairs = true;
    steps.getDispatchInfo().m_useContinuous = false;
    steps.setForceUpdateAllAabbs(false);
    btContactSolverInfo& info = steps.getSolverInfo();
    info.m_numIterations = iterations;
    info.m_minimumSolverBatchSize = 1;
    // With a single direction, bodies creep under forces below their friction.
    info.m_solverMode |= SOLVER_USE_2_FRICTION_DIRECTIONS;
    // The correction of an overlap must not become a velocity.
    info.m_splitImpulse = true;
    info.m_splitImpulsePenetrationThreshold = 0;
    floor.setCollisionShape(&plane);
    floor.setFriction(1);
    steps.addCollisionObject(&floor, of_floor, of_flying | of_loose);
    for (const Shape& shape : shapes) {
      const btVector3 centre(shape.pose.x, shape.pose.y, 0.5 * (shape.z_low_m + shape.z_high_m));
      standing.emplace_back(collision_shape(shape), btTransform(upright(shape.pose.heading), centre));
      steps.addCollisionObject(&standing.back().object, of_standing, of_rolling | of_flying | of_loose);
    }
    for (const MeshObstacle& mesh : of_meshes) {
      meshes.emplace_back(*mesh.mesh);
      if (meshes.back().standing)
        steps.addCollisionObject(&meshes.back().standing->object, of_standing, of_rolling | of_flying | of_loose);
    }
  }
  ~Bodies() {
    for (Hull& hull : hulls) steps.removeConstraint(&hull.drive());
    while (steps.getNumCollisionObjects() > 0)
      steps.removeCollisionObject(steps.getCollisionObjectArray()[steps.getNumCollisionObjects() - 1]);
  }
  Bodies(const Bodies&) = delete;
  Bodies& operator=(const Bodies&) = delete;

  void find_touches() {
    for (int i = 0; i < dispatcher.getNumManifolds(); ++i) {
      const btPersistentManifold& manifold = *dispatcher.getManifoldByIndexInternal(i);
      if (manifold.getBody0() == &floor || manifold.getBody1() == &floor) continue;
      bool presses = false;
      for (int k = 0; k < manifold.getNumContacts(); ++k)
        presses = presses || manifold.getContactPoint(k).getAppliedImpulse() > 0;
      if (!presses) continue;
      for (const btCollisionObject* body : {manifold.getBody0(), manifold.getBody1()})
        if (body->getUserIndex() >= 0) hulls[static_cast<std::size_t>(body->getUserIndex())].touch();
    }
  }
};

Dynamics::Dynamics(std::span<const Shape> standing, std::span<const MeshObstacle> meshes)
    : bodies_(std::make_unique<Bodies>(standing, meshes)) {}
Dynamics::~Dynamics() = default;

void Dynamics::add_hull(const Shape& shape, double mass_kg, bool flies) {
  Hull& hull = bodies_->hulls.emplace_back(shape, mass_kg, flies);
  hull.body().setUserIndex(static_cast<int>(bodies_->hulls.size()) - 1);
  const int meets = of_standing | of_rolling | of_flying | of_loose | (flies ? of_floor : 0);
  bodies_->steps.addRigidBody(&hull.body(), flies ? of_flying : of_rolling, meets);
  bodies_->steps.addConstraint(&hull.drive());
}

void Dynamics::add_loose(const LooseSolid& solid) {
  Loose& loose = bodies_->loose.emplace_back(solid);
  bodies_->steps.addRigidBody(&loose.body, of_loose, of_floor | of_standing | of_rolling | of_flying | of_loose);
}

void Dynamics::place_hull(std::uint32_t hull, const Pose& body, double height_m) {
  bodies_->hulls[hull].place(body, height_m);
}
void Dynamics::set_velocity(std::uint32_t hull, const Velocity& velocity) {
  bodies_->hulls[hull].set_velocity(velocity);
}
void Dynamics::aim(std::uint32_t hull, const DriveAim& aim, double step_s) { bodies_->hulls[hull].aim(aim, step_s); }
BodyMotion Dynamics::motion(std::uint32_t hull) const { return bodies_->hulls[hull].motion(); }

void Dynamics::push_hull(std::uint32_t hull, Point force_n) {
  bodies_->hulls[hull].body().applyCentralForce({force_n.x, force_n.y, 0});
}

void Dynamics::push_loose(std::uint32_t loose, Point force_n) {
  bodies_->loose[loose].body.activate();
  bodies_->loose[loose].body.applyCentralForce({force_n.x, force_n.y, 0});
}

void Dynamics::step(double step_s) {
  bodies_->steps.stepSimulation(step_s, 0);
  for (Hull& hull : bodies_->hulls) hull.stepped(step_s);
  for (Loose& loose : bodies_->loose) loose.read();
  bodies_->find_touches();
}

const LooseSolid& Dynamics::loose(std::uint32_t number) const { return bodies_->loose[number].solid; }
bool Dynamics::awake(std::uint32_t loose) const { return bodies_->loose[loose].body.isActive(); }

bool Dynamics::any_awake() const {
  return std::any_of(bodies_->loose.begin(), bodies_->loose.end(), [](const Loose& l) { return l.body.isActive(); });
}

}  // namespace waitpoint::world
