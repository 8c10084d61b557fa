#include "core/physics/collider.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "core/base/units.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;

/** Directions in which the object's outermost vertices are looked for. */
constexpr int kSupportDirections = 4000;
/** Vertices this much higher than the lowest one do not carry the object [m]. */
constexpr double kSupportBand = 2e-4;
constexpr int kMaxTableContacts = 8;

/** Vertices that can touch a plane: outermost ones over a Fibonacci lattice of directions. */
std::vector<Vector3d> FindSupportPoints(const TriMesh& mesh) {
  std::set<size_t> chosen;
  const double golden_angle = kPi * (3.0 - std::sqrt(5.0));
  for (int k = 0; k < kSupportDirections; ++k) {
    const double z = 1.0 - (2.0 * k + 1.0) / kSupportDirections;
    const double r = std::sqrt(1.0 - z * z);
    const Vector3d direction(r * std::cos(golden_angle * k), r * std::sin(golden_angle * k), z);
    size_t best = 0;
    double most = -std::numeric_limits<double>::infinity();
    for (size_t i = 0; i < mesh.vertices.size(); ++i) {
      const double extent = direction.dot(mesh.vertices[i]);
      if (extent > most) {
        most = extent;
        best = i;
      }
    }
    chosen.insert(best);
  }
  std::vector<Vector3d> points;
  for (size_t i : chosen) points.push_back(mesh.vertices[i]);
  return points;
}

struct ClosestPoints {
  Vector3d on_a, on_b;
};

/** Nearest points of two segments (Ericson 2005, section 5.1.9). */
ClosestPoints FindClosestPoints(const Vector3d& a0, const Vector3d& a1, const Vector3d& b0,
                                const Vector3d& b1) {
  const Vector3d da = a1 - a0, db = b1 - b0, r = a0 - b0;
  const double aa = da.squaredNorm(), bb = db.squaredNorm(), br = db.dot(r);
  constexpr double kPoint = 1e-18;
  double s = 0.0, t = 0.0;
  if (aa <= kPoint) {
    t = bb <= kPoint ? 0.0 : std::clamp(br / bb, 0.0, 1.0);
  } else {
    const double ar = da.dot(r);
    if (bb <= kPoint) {
      s = std::clamp(-ar / aa, 0.0, 1.0);
    } else {
      const double ab = da.dot(db), denominator = aa * bb - ab * ab;
      s = denominator > kPoint ? std::clamp((ab * br - ar * bb) / denominator, 0.0, 1.0) : 0.0;
      t = (ab * s + br) / bb;
      if (t < 0.0 || t > 1.0) {
        t = std::clamp(t, 0.0, 1.0);
        s = std::clamp((ab * t - ar) / aa, 0.0, 1.0);
      }
    }
  }
  return {a0 + s * da, b0 + t * db};
}

}  // namespace

std::vector<std::array<int, 2>> FindBuiltTouches(const Hand& hand) {
  const std::vector<Pose> X_HL = CalcLinkPoses(hand, Eigen::VectorXd::Zero(hand.num_joints()));
  std::vector<std::array<int, 2>> touches;
  for (int a = 0; a < static_cast<int>(hand.capsules.size()); ++a) {
    for (int b = a + 1; b < static_cast<int>(hand.capsules.size()); ++b) {
      const LinkCapsule &ca = hand.capsules[a], &cb = hand.capsules[b];
      if (hand.FindDigitOfLink(ca.link) == hand.FindDigitOfLink(cb.link)) continue;
      const ClosestPoints rest =
          FindClosestPoints(X_HL[ca.link] * ca.p_LA, X_HL[ca.link] * ca.p_LB,
                            X_HL[cb.link] * cb.p_LA, X_HL[cb.link] * cb.p_LB);
      if ((rest.on_a - rest.on_b).norm() <= ca.radius + cb.radius) touches.push_back({a, b});
    }
  }
  return touches;
}

Collider::Collider(const Hand& hand, const GraspObject& object, const SimConfig& config)
    : h_(config.step),
      spheres_(hand.contact_spheres),
      capsules_(hand.capsules),
      field_(object.field.get()),
      support_points_(FindSupportPoints(object.mesh)) {
  std::stable_sort(spheres_.begin(), spheres_.end(),
                   [](const ContactSphere& a, const ContactSphere& b) { return a.link < b.link; });
  for (int first = 0; first < static_cast<int>(spheres_.size());) {
    LinkSpheres group{spheres_[first].link, first, 0, Vector3d::Zero(), 0.0};
    while (first + group.count < static_cast<int>(spheres_.size()) &&
           spheres_[first + group.count].link == group.link) {
      group.p_LCentre += spheres_[first + group.count].p_LS;
      ++group.count;
    }
    group.p_LCentre /= group.count;
    for (int i = first; i < first + group.count; ++i) {
      group.radius =
          std::max(group.radius, (spheres_[i].p_LS - group.p_LCentre).norm() + spheres_[i].radius);
    }
    link_spheres_.push_back(group);
    first += group.count;
  }
  for (const Vector3d& p : support_points_) object_radius_ = std::max(object_radius_, p.norm());

  // Fingers against each other and against the palm; a finger cannot reach itself.
  const std::vector<std::array<int, 2>> built = FindBuiltTouches(hand);
  for (int a = 0; a < static_cast<int>(capsules_.size()); ++a) {
    for (int b = a + 1; b < static_cast<int>(capsules_.size()); ++b) {
      const LinkCapsule &ca = capsules_[a], &cb = capsules_[b];
      if (hand.FindDigitOfLink(ca.link) == hand.FindDigitOfLink(cb.link)) continue;
      if (std::count(built.begin(), built.end(), std::array<int, 2>{a, b}) > 0) continue;
      pairs_.push_back({a, b, 0.5 * ((ca.p_LB - ca.p_LA).norm() + (cb.p_LB - cb.p_LA).norm())});
    }
  }

  link_material_ = {config.contact_stiffness,    config.contact_dissipation,
                    config.tangential_stiffness, object.friction_static,
                    object.friction_dynamic,     0.0};
  pad_material_ = link_material_;
  pad_material_.torsion_radius = hand.pad_torsion_radius;
  table_material_ = link_material_;
  table_material_.friction_static = config.table_friction_static;
  table_material_.friction_dynamic = config.table_friction_dynamic;
  self_material_ = link_material_;
  self_material_.tangential_stiffness = 0.0;
  Reset();
}

void Collider::Reset() {
  hand_object_.assign(spheres_.size(), ContactMemory());
  hand_table_.assign(spheres_.size(), ContactMemory());
  object_table_.assign(support_points_.size(), ContactMemory());
}

void Collider::AddHandRows(const HandDynamics& dynamics, int link, double sign,
                           const Vector3d& v_WH, ContactPoint& contact) const {
  const int num_rows = contact.num_rows();
  const Vector3d rows[3] = {contact.nhat_BA_W, contact.tangent1_W, contact.tangent2_W};
  for (int row = 0; row < std::min(num_rows, 3); ++row) {
    contact.drift[row] += sign * rows[row].dot(v_WH);
  }
  for (int joint : dynamics.chain(link)) {
    const double rate = dynamics.rate_of_joint(joint);
    if (rate == 0.0) continue;
    const int dof = dynamics.dof_of_joint(joint);
    int i = 0;
    while (i < contact.num_dofs && contact.dofs[i] < dof) ++i;
    if (i == contact.num_dofs || contact.dofs[i] != dof) {
      for (int k = contact.num_dofs; k > i; --k) {
        contact.dofs[k] = contact.dofs[k - 1];
        for (int row = 0; row < num_rows; ++row) {
          contact.jacobian[row][k] = contact.jacobian[row][k - 1];
        }
      }
      contact.dofs[i] = dof;
      for (int row = 0; row < num_rows; ++row) contact.jacobian[row][i] = 0.0;
      ++contact.num_dofs;
    }
    const SpatialVector& S = dynamics.motion(joint);
    const Vector3d a = S.head<3>();
    const Vector3d v = Vector3d(S.tail<3>()) + a.cross(contact.p_WC);
    for (int row = 0; row < std::min(num_rows, 3); ++row) {
      contact.jacobian[row][i] += sign * rate * rows[row].dot(v);
    }
    if (num_rows == 4) contact.jacobian[kSpinRow][i] += sign * rate * contact.nhat_BA_W.dot(a);
  }
}

void Collider::AddObjectRows(int first_dof, const Vector3d& p_WOcm, double sign,
                             ContactPoint& contact) {
  const int num_rows = contact.num_rows();
  const Vector3d r = contact.p_WC - p_WOcm;
  const Vector3d rows[3] = {contact.nhat_BA_W, contact.tangent1_W, contact.tangent2_W};
  for (int k = 0; k < 6; ++k) contact.dofs[contact.num_dofs + k] = first_dof + k;
  for (int row = 0; row < num_rows; ++row) {
    const Vector3d angular = row < 3 ? Vector3d(r.cross(rows[row])) : contact.nhat_BA_W;
    const Vector3d linear = row < 3 ? rows[row] : Vector3d(Vector3d::Zero());
    for (int k = 0; k < 3; ++k) {
      contact.jacobian[row][contact.num_dofs + k] = sign * angular[k];
      contact.jacobian[row][contact.num_dofs + 3 + k] = sign * linear[k];
    }
  }
  contact.num_dofs += 6;
}

void Collider::FindHandObject(const HandDynamics& dynamics, const Pose& X_WO,
                              const Vector3d& p_WOcm, const Vector3d& v_WH, int step_number,
                              std::vector<ContactPoint>& contacts) {
  const Eigen::Matrix3d R_WO = X_WO.linear();
  const Vector3d p_WO = X_WO.translation();
  for (const LinkSpheres& group : link_spheres_) {
    const Pose& X_WL = dynamics.X_WL(group.link);
    const double reach = object_radius_ + group.radius + kMargin;
    if ((X_WL * group.p_LCentre - p_WO).squaredNorm() > reach * reach) continue;
    const Vector3d p_OCentre = R_WO.transpose() * (X_WL * group.p_LCentre - p_WO);
    if (field_->CalcDistance(p_OCentre) > group.radius + kMargin) continue;
    for (int i = group.first; i < group.first + group.count; ++i) {
      const ContactSphere& sphere = spheres_[i];
      const Vector3d p_WS = X_WL * sphere.p_LS;
      const Vector3d p_OS = R_WO.transpose() * (p_WS - p_WO);
      const double gap = field_->CalcDistance(p_OS) - sphere.radius;
      if (gap > kMargin) continue;
      ContactPoint& contact = contacts.emplace_back();
      contact.material = sphere.is_pad ? pad_material_ : link_material_;
      contact.nhat_BA_W = R_WO * field_->Query(p_OS).gradient;
      contact.p_WC = p_WS - (sphere.radius + 0.5 * gap) * contact.nhat_BA_W;
      contact.depth = -gap;
      contact.link = group.link;
      contact.is_on_object = true;
      contact.memory = &hand_object_[i];
      PrepareContact(h_, step_number, contact);
      AddHandRows(dynamics, group.link, 1.0, v_WH, contact);
      AddObjectRows(dynamics.num_dofs(), p_WOcm, -1.0, contact);
    }
  }
}

void Collider::FindHandTable(const HandDynamics& dynamics, const Vector3d& v_WH, int step_number,
                             std::vector<ContactPoint>& contacts) {
  for (const LinkSpheres& group : link_spheres_) {
    const Pose& X_WL = dynamics.X_WL(group.link);
    if ((X_WL * group.p_LCentre).z() > group.radius + kMargin) continue;
    for (int i = group.first; i < group.first + group.count; ++i) {
      const ContactSphere& sphere = spheres_[i];
      const Vector3d p_WS = X_WL * sphere.p_LS;
      const double gap = p_WS.z() - sphere.radius;
      if (gap > kMargin) continue;
      ContactPoint& contact = contacts.emplace_back();
      contact.material = table_material_;
      contact.nhat_BA_W = Vector3d::UnitZ();
      contact.p_WC = Vector3d(p_WS.x(), p_WS.y(), 0.5 * gap);
      contact.depth = -gap;
      contact.link = group.link;
      contact.memory = &hand_table_[i];
      PrepareContact(h_, step_number, contact);
      AddHandRows(dynamics, group.link, 1.0, v_WH, contact);
    }
  }
}

void Collider::FindObjectTable(const HandDynamics& dynamics, const Pose& X_WO,
                               const Vector3d& p_WOcm, int step_number,
                               std::vector<ContactPoint>& contacts) {
  const Vector3d p_WO = X_WO.translation();
  if (p_WO.z() > object_radius_ + kMargin) return;
  const Eigen::RowVector3d up_O = X_WO.linear().row(2);
  double lowest = std::numeric_limits<double>::infinity();
  thread_local std::vector<double> heights;
  heights.resize(support_points_.size());
  for (size_t i = 0; i < support_points_.size(); ++i) {
    heights[i] = p_WO.z() + up_O.dot(support_points_[i]);
    lowest = std::min(lowest, heights[i]);
  }
  if (lowest > kMargin) return;

  // Among the vertices that carry, the outermost ones hold the object; fixed directions of O keep
  // the choice steady from step to step.
  thread_local std::vector<int> carrying;
  carrying.clear();
  for (size_t i = 0; i < support_points_.size(); ++i) {
    if (heights[i] <= lowest + kSupportBand) carrying.push_back(static_cast<int>(i));
  }
  std::array<int, kMaxTableContacts> chosen{};
  int num_chosen = 0;
  const auto choose = [&](int point) {
    if (std::find(chosen.begin(), chosen.begin() + num_chosen, point) ==
        chosen.begin() + num_chosen) {
      chosen[num_chosen++] = point;
    }
  };
  if (carrying.size() <= kMaxTableContacts) {
    for (int point : carrying) choose(point);
  } else {
    const Vector3d up = up_O.transpose();
    const Vector3d e1 = up.unitOrthogonal(), e2 = up.cross(e1);
    for (int k = 0; k < kMaxTableContacts; ++k) {
      const double angle = 2.0 * kPi * k / kMaxTableContacts;
      const Vector3d direction = std::cos(angle) * e1 + std::sin(angle) * e2;
      choose(*std::max_element(carrying.begin(), carrying.end(), [&](int a, int b) {
        return direction.dot(support_points_[a]) < direction.dot(support_points_[b]);
      }));
    }
  }
  for (int k = 0; k < num_chosen; ++k) {
    const int point = chosen[k];
    ContactPoint& contact = contacts.emplace_back();
    contact.material = table_material_;
    contact.nhat_BA_W = Vector3d::UnitZ();
    contact.p_WC = X_WO * support_points_[point];
    contact.depth = -heights[point];
    contact.is_on_object = true;
    contact.memory = &object_table_[point];
    PrepareContact(h_, step_number, contact);
    AddObjectRows(dynamics.num_dofs(), p_WOcm, 1.0, contact);
  }
}

void Collider::FindSelfContacts(const HandDynamics& dynamics, const Vector3d& v_WH, int step_number,
                                std::vector<ContactPoint>& contacts) {
  capsule_ends_.resize(capsules_.size());
  for (size_t i = 0; i < capsules_.size(); ++i) {
    const Pose& X_WL = dynamics.X_WL(capsules_[i].link);
    capsule_ends_[i] = {X_WL * capsules_[i].p_LA, X_WL * capsules_[i].p_LB};
  }
  for (const CapsulePair& pair : pairs_) {
    const LinkCapsule &a = capsules_[pair.a], &b = capsules_[pair.b];
    const auto& [a0, a1] = capsule_ends_[pair.a];
    const auto& [b0, b1] = capsule_ends_[pair.b];
    const double radii = a.radius + b.radius;
    const double reach = pair.half_lengths + radii + kMargin;
    if ((0.5 * (a0 + a1 - b0 - b1)).squaredNorm() > reach * reach) continue;
    const ClosestPoints nearest = FindClosestPoints(a0, a1, b0, b1);
    const Vector3d apart = nearest.on_a - nearest.on_b;
    const double distance = apart.norm();
    if (distance > radii + kMargin || distance < 1e-9) continue;
    ContactPoint& contact = contacts.emplace_back();
    contact.material = self_material_;
    contact.nhat_BA_W = apart / distance;
    contact.p_WC = nearest.on_b + (b.radius + 0.5 * (distance - radii)) * contact.nhat_BA_W;
    contact.depth = radii - distance;
    contact.link = a.link;
    PrepareContact(h_, step_number, contact);
    AddHandRows(dynamics, a.link, 1.0, v_WH, contact);
    AddHandRows(dynamics, b.link, -1.0, v_WH, contact);
  }
}

void Collider::FindContacts(const HandDynamics& dynamics, const Pose& X_WO, const Vector3d& p_WOcm,
                            const Vector3d& v_WH, int step_number,
                            std::vector<ContactPoint>& contacts) {
  contacts.clear();
  FindHandObject(dynamics, X_WO, p_WOcm, v_WH, step_number, contacts);
  FindHandTable(dynamics, v_WH, step_number, contacts);
  FindObjectTable(dynamics, X_WO, p_WOcm, step_number, contacts);
  FindSelfContacts(dynamics, v_WH, step_number, contacts);
}

double Collider::CalcSmallestGap(const HandDynamics& dynamics, const Pose& X_WO) const {
  double gap = std::numeric_limits<double>::infinity();
  const Pose X_OW = X_WO.inverse();
  for (const ContactSphere& sphere : spheres_) {
    const Vector3d p_WS = dynamics.X_WL(sphere.link) * sphere.p_LS;
    gap = std::min(
        {gap, p_WS.z() - sphere.radius, field_->CalcDistance(X_OW * p_WS) - sphere.radius});
  }
  return gap;
}

double Collider::CalcLowestPoint(const Pose& X_WO) const {
  double lowest = std::numeric_limits<double>::infinity();
  for (const Vector3d& p : support_points_) lowest = std::min(lowest, (X_WO * p).z());
  return lowest;
}

}  // namespace graspbench
