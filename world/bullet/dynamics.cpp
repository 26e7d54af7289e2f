// SPDX-License-Identifier: BSD-3-Clause
#include "world/bullet/dynamics.hpp"

#include <btBulletDynamicsCommon.h>

#include <algorithm>
#include <deque>

namespace waitpoint::world {
namespace {

static_assert(sizeof(btScalar) == sizeof(double), "Bullet is to compute in double precision");

// Bullet rounds the edges of what it finds contacts of, other than of two boxes, by this much.
constexpr double rounding_m = 0.002;
// Slower than this for two seconds (of Bullet's own), something is at rest.
constexpr double rest_m_s = 1e-3, rest_rad_s = 1e-3;
constexpr int iterations = 50;

enum Group : int { of_floor = 1, of_standing = 2, of_rolling = 4, of_flying = 8, of_loose = 16 };

btVector3 vector(SpaceVector v) { return {v.x, v.y, v.z}; }
SpaceVector space_vector(const btVector3& v) { return {v.x(), v.y(), v.z()}; }

btMatrix3x3 upright(double heading_rad) {
  const auto [s, c] = exact::sincos(heading_rad);
  return {c, -s, 0, s, c, 0, 0, 0, 1};
}

std::unique_ptr<btCollisionShape> collision_shape(Shape::Kind kind, SpaceVector size_m) {
  const btVector3 half = 0.5 * vector(size_m);
  std::unique_ptr<btConvexInternalShape> shape;
  if (kind == Shape::Kind::cylinder)
    shape = std::make_unique<btCylinderShapeZ>(half);
  else
    shape = std::make_unique<btBoxShape>(half);
  shape->setMargin(std::min(rounding_m, 0.1 * half[half.minAxis()]));
  return shape;
}

// Bullet's own way there takes the C library's sine, whose bits depend on the processor.
btQuaternion turned(const btQuaternion& now, const btVector3& spin_rad_s, double step_s) {
  const double rate = spin_rad_s.length();
  if (rate == 0) return now;
  const auto [s, c] = exact::sincos(0.5 * rate * step_s);
  const btVector3 axis = (s / rate) * spin_rad_s;
  return (btQuaternion(axis.x(), axis.y(), axis.z(), c) * now).normalized();
}

// Of length 1, on which a body turns by so much. Turns of a step are below half a turn, but for blows.
double chord_of_arc(double turn_rad) {
  const double half = 0.5 * turn_rad;
  return half == 0 ? 1 : std::max(exact::sin(half) / half, 0.5);
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

/// A drive: motors between a hull and the floor, each as strong as it is.
///
/// Its rows are velocities of the hull: along, across, about (and upwards, in the air). The solver finds the impulses
/// that bring them to their targets, each within force times step, together with all contacts: so a drive that is held
/// by a wall gives its greatest force and no more, and one that nothing holds reaches its target exactly.
class Drive final : public btTypedConstraint {
 public:
  Drive(btRigidBody& hull, bool flies) : btTypedConstraint(MAX_CONSTRAINT_TYPE, hull), flies_(flies) {}

  /// What it tries from now on. The motors act at `from_centre`, a level vector of the world from the hull's centre,
  /// along and across that direction.
  void aim(const DriveAim& aim, Point direction, Point from_centre) {
    aim_ = aim;
    direction_ = direction;
    from_centre_ = from_centre;
  }

  void getInfo1(btConstraintInfo1* info) override {
    info->m_numConstraintRows = flies_ ? 4 : 3;
    info->nub = 0;
  }

  void getInfo2(btConstraintInfo2* info) override {
    const btVector3 at(from_centre_.x, from_centre_.y, 0);
    const btVector3 along(direction_.x, direction_.y, 0), across(-direction_.y, direction_.x, 0), up(0, 0, 1);
    set(*info, 0, along, at.cross(along), aim_.velocity.v_m_s, aim_.force_n);
    set(*info, 1, across, at.cross(across), aim_.velocity.side_m_s, aim_.side_force_n);
    set(*info, 2, btVector3(0, 0, 0), up, aim_.velocity.w_rad_s, aim_.torque_nm);
    if (flies_) set(*info, 3, up, btVector3(0, 0, 0), aim_.velocity.climb_m_s, aim_.climb_force_n);
  }

  void setParam(int, btScalar, int) override {}
  btScalar getParam(int, int) const override { return 0; }

 private:
  static void set(btConstraintInfo2& info, int row, const btVector3& way, const btVector3& turn, double target,
                  double force) {
    const int first = row * info.rowskip;
    for (int k = 0; k < 3; ++k) {
      info.m_J1linearAxis[first + k] = way[k];
      info.m_J1angularAxis[first + k] = turn[k];
    }
    info.m_constraintError[first] = target;
    info.m_upperLimit[first] = force / info.fps;
    info.m_lowerLimit[first] = -force / info.fps;
  }

  bool flies_;
  DriveAim aim_;
  Point direction_ = {1, 0}, from_centre_;
};

struct Hull {
  Shape in_body;
  std::unique_ptr<btCollisionShape> shape;
  btRigidBody body;
  Drive drive;
  double heading_rad = 0;  // of the body
  btVector3 placed = {0, 0, 0};
  double placed_heading_rad = 0, turned_rad = 0, last_turn_rad = 0;
  bool touched = false;

  Hull(const Shape& s, double mass_kg, bool flies)
      : in_body(s),
        shape(collision_shape(s.kind, size_of(s))),
        body(info(s, mass_kg, shape.get())),
        drive(body, flies) {
    body.setFriction(flies ? 0 : hull_friction);
    body.setActivationState(DISABLE_DEACTIVATION);
    body.setAngularFactor({0, 0, 1});
    if (flies)
      body.setFlags(body.getFlags() | BT_DISABLE_WORLD_GRAVITY);
    else
      body.setLinearFactor({1, 1, 0});
  }
  static btRigidBody::btRigidBodyConstructionInfo info(const Shape& s, double mass_kg, btCollisionShape* shape) {
    // No inertia is an infinite one, to Bullet.
    return {mass_kg, nullptr, shape, {0, 0, inertia_kg_m2(s, mass_kg)}};
  }

  // From the shape's centre to the body's origin, in the world.
  Point origin_from_centre(double at_heading_rad) const {
    const Point p = transform({0, 0, at_heading_rad}, in_body.pose.position());
    return {-p.x, -p.y};
  }
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
  // As Bullet does, but for where sines come from.
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
  std::deque<Hull> hulls;  // Bullet keeps their addresses
  std::deque<Loose> loose;
  BulletSteps steps{&dispatcher, &broad_phase, &solver, &configuration};

  explicit Bodies(std::span<const Shape> shapes) {
    // Contacts within 2 cm, whatever the size of a body: what comes nearer in a step is met before it is inside.
    dispatcher.setDispatcherFlags(dispatcher.getDispatcherFlags() &
                                  ~btCollisionDispatcher::CD_USE_RELATIVE_CONTACT_BREAKING_THRESHOLD);
    steps.setGravity({0, 0, -gravity_m_s2});
    steps.getDispatchInfo().m_deterministicOverlappingPairs = true;
    steps.getDispatchInfo().m_useContinuous = false;
    steps.setForceUpdateAllAabbs(false);
    btContactSolverInfo& info = steps.getSolverInfo();
    info.m_numIterations = iterations;
    info.m_minimumSolverBatchSize = 1;
    // With one alone, what is pushed against its friction creeps.
    info.m_solverMode |= SOLVER_USE_2_FRICTION_DIRECTIONS;
    // What is pushed out of another one must not leave at that speed.
    info.m_splitImpulse = true;
    info.m_splitImpulsePenetrationThreshold = 0;
    floor.setCollisionShape(&plane);
    floor.setFriction(1);
    steps.addCollisionObject(&floor, of_floor, of_flying | of_loose);
    for (const Shape& shape : shapes) {
      const btVector3 centre(shape.pose.x, shape.pose.y, 0.5 * (shape.z_low_m + shape.z_high_m));
      standing.emplace_back(collision_shape(shape.kind, size_of(shape)),
                            btTransform(upright(shape.pose.heading), centre));
      steps.addCollisionObject(&standing.back().object, of_standing, of_rolling | of_flying | of_loose);
    }
  }
  ~Bodies() {
    for (Hull& hull : hulls) steps.removeConstraint(&hull.drive);
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
        if (body->getUserIndex() >= 0) hulls[static_cast<std::size_t>(body->getUserIndex())].touched = true;
    }
  }
};

Dynamics::Dynamics(std::span<const Shape> standing) : bodies_(std::make_unique<Bodies>(standing)) {}
Dynamics::~Dynamics() = default;

void Dynamics::add_hull(const Shape& shape, double mass_kg, bool flies) {
  Hull& hull = bodies_->hulls.emplace_back(shape, mass_kg, flies);
  hull.body.setUserIndex(static_cast<int>(bodies_->hulls.size()) - 1);
  const int meets = of_standing | of_rolling | of_flying | of_loose | (flies ? of_floor : 0);
  bodies_->steps.addRigidBody(&hull.body, flies ? of_flying : of_rolling, meets);
  bodies_->steps.addConstraint(&hull.drive);
}

void Dynamics::add_loose(const LooseSolid& solid) {
  Loose& loose = bodies_->loose.emplace_back(solid);
  bodies_->steps.addRigidBody(&loose.body, of_loose, of_floor | of_standing | of_rolling | of_flying | of_loose);
}

void Dynamics::place_hull(std::uint32_t number, const Pose& body, double height_m) {
  Hull& hull = bodies_->hulls[number];
  const Pose centre = compose(body, hull.in_body.pose);
  const double z_m = height_m + 0.5 * (hull.in_body.z_low_m + hull.in_body.z_high_m);
  hull.placed = {centre.x, centre.y, z_m};
  hull.heading_rad = hull.placed_heading_rad = body.heading;
  hull.turned_rad = hull.last_turn_rad = 0;
  hull.touched = false;
  hull.body.setWorldTransform(btTransform(upright(centre.heading), hull.placed));
}

void Dynamics::set_velocity(std::uint32_t number, const Velocity& velocity) {
  Hull& hull = bodies_->hulls[number];
  const auto [s, c] = exact::sincos(hull.heading_rad);
  const Point arm = hull.origin_from_centre(hull.heading_rad);
  const double w = velocity.w_rad_s;
  hull.body.setLinearVelocity({c * velocity.v_m_s - s * velocity.side_m_s + w * arm.y,
                               s * velocity.v_m_s + c * velocity.side_m_s - w * arm.x, velocity.climb_m_s});
  hull.body.setAngularVelocity({0, 0, w});
}

void Dynamics::aim(std::uint32_t number, const DriveAim& aim, double step_s) {
  Hull& hull = bodies_->hulls[number];
  const double middle_rad = hull.heading_rad + 0.5 * aim.velocity.w_rad_s * step_s;
  const auto [s, c] = exact::sincos(middle_rad);
  DriveAim along_chord = aim;
  const double shortening = chord_of_arc(aim.velocity.w_rad_s * step_s);
  along_chord.velocity.v_m_s *= shortening;
  along_chord.velocity.side_m_s *= shortening;
  hull.drive.aim(along_chord, {c, s}, hull.origin_from_centre(middle_rad));
}

void Dynamics::push_hull(std::uint32_t hull, Point force_n) {
  bodies_->hulls[hull].body.applyCentralForce({force_n.x, force_n.y, 0});
}

void Dynamics::push_loose(std::uint32_t loose, Point force_n) {
  bodies_->loose[loose].body.activate();
  bodies_->loose[loose].body.applyCentralForce({force_n.x, force_n.y, 0});
}

void Dynamics::step(double step_s) {
  bodies_->steps.stepSimulation(step_s, 0);
  for (Hull& hull : bodies_->hulls) {
    hull.last_turn_rad = step_s * hull.body.getAngularVelocity().z();
    hull.turned_rad += hull.last_turn_rad;
    hull.heading_rad = hull.placed_heading_rad + hull.turned_rad;
    btTransform at = hull.body.getWorldTransform();
    at.setBasis(upright(hull.heading_rad + hull.in_body.pose.heading));
    hull.body.setWorldTransform(at);
  }
  for (Loose& loose : bodies_->loose) loose.read();
  bodies_->find_touches();
}

BodyMotion Dynamics::motion(std::uint32_t number) const {
  const Hull& hull = bodies_->hulls[number];
  const btVector3 moved = hull.body.getWorldTransform().getOrigin() - hull.placed;
  const Point before = hull.origin_from_centre(hull.placed_heading_rad),
              now = hull.origin_from_centre(hull.heading_rad);
  const btVector3& v = hull.body.getLinearVelocity();
  const double w = hull.body.getAngularVelocity().z();
  // Of the origin, as the drive saw it.
  const double middle_rad = hull.heading_rad - 0.5 * hull.last_turn_rad;
  const double shortening = chord_of_arc(hull.last_turn_rad);
  const Point arm = hull.origin_from_centre(middle_rad);
  const Point velocity = {v.x() - w * arm.y, v.y() + w * arm.x};
  const auto [s, c] = exact::sincos(middle_rad);
  return {{moved.x() + (now.x - before.x), moved.y() + (now.y - before.y)},
          hull.turned_rad,
          moved.z(),
          {(c * velocity.x + s * velocity.y) / shortening, w, (c * velocity.y - s * velocity.x) / shortening, v.z()},
          hull.touched};
}

const LooseSolid& Dynamics::loose(std::uint32_t number) const { return bodies_->loose[number].solid; }
bool Dynamics::awake(std::uint32_t loose) const { return bodies_->loose[loose].body.isActive(); }

bool Dynamics::any_awake() const {
  return std::any_of(bodies_->loose.begin(), bodies_->loose.end(), [](const Loose& l) { return l.body.isActive(); });
}

}  // namespace waitpoint::world
