#include "core/physics/collider.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/units.h"
#include "core/hand/contact_shape.h"
#include "core/physics/contact.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;

/** The table detects the object within this gap. A fall of 0.2 m ends at 2 m/s, and the object
cannot pass the table within a step of 4 ms [m]. */
constexpr double kTableMargin = 0.008;
/** Load assumed for a point that has just touched, so that new points share alike [N]. */
constexpr double kUnknownLoad = 1e-6;
/** Largest change of a field's distance over a displacement of 1. Each of the three derivatives of
its interpolant is at most 1. */
constexpr double kSteepestField = 1.75;

/** Returns the column of a degree of freedom among those of the contact, which ascend. A new column
is zero. */
int FindColumn(int dof, ContactPoint& contact) {
  int i = 0;
  while (i < contact.num_dofs && contact.dofs[i] < dof) ++i;
  if (i < contact.num_dofs && contact.dofs[i] == dof) return i;
  const int num_rows = contact.num_rows();
  for (int k = contact.num_dofs; k > i; --k) {
    contact.dofs[k] = contact.dofs[k - 1];
    for (int row = 0; row < num_rows; ++row) {
      contact.jacobian[row][k] = contact.jacobian[row][k - 1];
    }
  }
  contact.dofs[i] = dof;
  for (int row = 0; row < num_rows; ++row) contact.jacobian[row][i] = 0.0;
  ++contact.num_dofs;
  return i;
}

}  // namespace

Collider::Collider(const Hand& hand, const GraspObject& object, const SimConfig& config,
                   TablePresence table)
    : h_(config.step),
      table_(table),
      spheres_(hand.contact_spheres),
      capsules_(hand.capsules),
      field_(object.field.get()),
      compressible_(object.compressible),
      support_(TableSupport::Of(object)) {
  GroupSpheres();
  FindPairs(hand);
  CombineMaterials(hand, object.surface, config);
  Reset();
}

void Collider::Bystander::Remember(const Vector3d& p_ONow, double gap, double cell) {
  // Where surfaces inside the object reach its outer surface, a field jumps by a cell.
  const double way = std::max(0.0, gap - kMargin - cell) / kSteepestField;
  p_OCentre = p_ONow;
  way_squared = way * way;
}

void Collider::GroupSpheres() {
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
  links_apart_.resize(link_spheres_.size());
  spheres_apart_.resize(spheres_.size());
}

void Collider::FindPairs(const Hand& hand) {
  for (const CapsulePair& meeting : FindCapsulePairs(hand)) {
    const LinkCapsule &ca = capsules_[meeting.a], &cb = capsules_[meeting.b];
    SelfPair& pair = pairs_.emplace_back();
    pair.a = meeting.a;
    pair.b = meeting.b;
    pair.reach = 0.5 * ((ca.p_LB - ca.p_LA).norm() + (cb.p_LB - cb.p_LA).norm()) + ca.radius +
                 cb.radius + kMargin;
  }
  GroupPairs(hand);
}

void Collider::GroupPairs(const Hand& hand) {
  const auto middle = [](const LinkCapsule& capsule) {
    return Vector3d(0.5 * (capsule.p_LA + capsule.p_LB));
  };
  const auto reach = [](const LinkCapsule& capsule) {
    return 0.5 * (capsule.p_LA - capsule.p_LB).norm() + capsule.radius;
  };
  p_LCapsules_.assign(hand.links.size(), Vector3d::Zero());
  p_WCapsules_ = p_LCapsules_;
  std::vector<double> counts(hand.links.size()), reaches(hand.links.size());
  for (const LinkCapsule& capsule : capsules_) {
    p_LCapsules_[capsule.link] += middle(capsule);
    ++counts[capsule.link];
  }
  for (size_t link = 0; link < counts.size(); ++link) {
    p_LCapsules_[link] /= std::max(counts[link], 1.0);
  }
  for (const LinkCapsule& capsule : capsules_) {
    reaches[capsule.link] =
        std::max(reaches[capsule.link],
                 (middle(capsule) - p_LCapsules_[capsule.link]).norm() + reach(capsule));
  }
  for (int p = 0; p < static_cast<int>(pairs_.size()); ++p) {
    const int a = pairs_[p].a, link_b = capsules_[pairs_[p].b].link;
    if (pairs_by_link_.empty() || pairs_by_link_.back().a != a ||
        pairs_by_link_.back().link_b != link_b) {
      pairs_by_link_.push_back({a, link_b, p, p, reach(capsules_[a]) + reaches[link_b] + kMargin});
    }
    pairs_by_link_.back().end = p + 1;
  }
}

void Collider::CombineMaterials(const Hand& hand, const SurfaceMaterial& object,
                                const SimConfig& config) {
  const SurfaceMaterial table = MakeTableSurface(config);
  for (const HandLink& link : hand.links) {
    link_object_.push_back(CombineSurfaces(link.surface, object, config));
    link_table_.push_back(CombineSurfaces(link.surface, table, config));
  }
  SurfaceMaterial object_underside = object;  // its friction is for contact with the hand
  object_underside.friction_static = object_underside.friction_dynamic = kUnset;
  object_table_ = CombineSurfaces(object_underside, table, config);
  for (SelfPair& pair : pairs_) {
    pair.material = CombineSurfaces(
        MakeSelfSurface(hand.links[capsules_[pair.a].link].surface, config),
        MakeSelfSurface(hand.links[capsules_[pair.b].link].surface, config), config);
  }
}

void Collider::Reset() {
  hand_object_memory_.assign(spheres_.size(), ContactMemory());
  hand_table_memory_.assign(spheres_.size(), ContactMemory());
  object_table_memory_.assign(static_cast<size_t>(support_->num_ids()), ContactMemory());
  self_memory_.assign(pairs_.size(), ContactMemory());
}

void Collider::AddJointRows(const HandDynamics& dynamics, int link, double sign,
                            ContactPoint& contact) {
  const int num_rows = contact.num_rows();
  const Vector3d rows[3] = {contact.nhat_BA_W, contact.tangent1_W, contact.tangent2_W};
  for (int joint : dynamics.chain(link)) {
    const SpatialVector& S = dynamics.motion(joint);
    const Vector3d a = S.head<3>();
    const Vector3d v = Vector3d(S.tail<3>()) + a.cross(contact.p_WC);
    dynamics.ForEachSpeed(joint, [&](int dof, double rate) {
      const int i = FindColumn(dof, contact);
      for (int row = 0; row < std::min(num_rows, 3); ++row) {
        contact.jacobian[row][i] += sign * rate * rows[row].dot(v);
      }
      if (num_rows == 4) contact.jacobian[kSpinRow][i] += sign * rate * contact.nhat_BA_W.dot(a);
    });
  }
}

void Collider::AddBodyRows(int first_dof, const Vector3d& p_WBody, const Vector3d& p_WFriction,
                           double sign, ContactPoint& contact) {
  const int num_rows = contact.num_rows();
  const Vector3d rows[3] = {contact.nhat_BA_W, contact.tangent1_W, contact.tangent2_W};
  for (int k = 0; k < 6; ++k) contact.dofs[contact.num_dofs + k] = first_dof + k;
  for (int row = 0; row < num_rows; ++row) {
    const Vector3d r = (row == kNormalRow ? contact.p_WC : p_WFriction) - p_WBody;
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
                              const Vector3d& p_WOcm, int step_number,
                              std::vector<ContactPoint>& contacts) {
  const Eigen::Matrix3d R_WO = X_WO.linear();
  const Vector3d p_WO = X_WO.translation();
  pressing_.clear();
  for (size_t g = 0; g < link_spheres_.size(); ++g) {
    const LinkSpheres& group = link_spheres_[g];
    const Pose& X_WL = dynamics.X_WL(group.link);
    const double reach = support_->radius() + group.radius + kMargin;
    if ((X_WL * group.p_LCentre - p_WO).squaredNorm() > reach * reach) continue;
    const Vector3d p_OCentre = R_WO.transpose() * (X_WL * group.p_LCentre - p_WO);
    if (links_apart_[g].IsApart(p_OCentre)) continue;
    const double link_gap = field_->CalcDistance(p_OCentre) - group.radius;
    if (link_gap > kMargin) {
      links_apart_[g].Remember(p_OCentre, link_gap, field_->cell());
      continue;
    }
    const Eigen::Matrix3d R_OL = R_WO.transpose() * X_WL.linear();
    const Vector3d p_OL = R_WO.transpose() * (X_WL.translation() - p_WO);
    for (int i = group.first; i < group.first + group.count; ++i) {
      const ContactSphere& sphere = spheres_[i];
      if (spheres_apart_[i].IsApart(p_OL + R_OL * sphere.p_LS)) continue;
      const Vector3d p_WS = X_WL * sphere.p_LS;
      const Vector3d p_OS = R_WO.transpose() * (p_WS - p_WO);
      const SignedDistanceField::Cell cell = field_->FindCell(p_OS);
      const double gap = field_->CalcDistance(cell) - sphere.radius;
      if (gap > kMargin) {
        spheres_apart_[i].Remember(p_OS, gap, field_->cell());
        continue;
      }
      ContactPoint& contact = contacts.emplace_back();
      contact.material = link_object_[group.link];
      contact.nhat_BA_W = R_WO * field_->CalcGradient(cell);
      contact.p_WC = p_WS - (sphere.radius + 0.5 * gap) * contact.nhat_BA_W;
      contact.depth = -gap;
      contact.link = group.link;
      contact.is_on_object = true;
      contact.memory = &hand_object_memory_[i];
      SetRadius(sphere.radius, contact);
      if (compressible_) {
        pressing_.push_back(
            {p_OS, R_WO.transpose() * contact.nhat_BA_W, sphere.radius, contact.depth});
      }
    }
  }
  if (compressible_) YieldToHand(contacts);
  for (ContactPoint& contact : contacts) {
    PrepareContact(h_, step_number, contact);
    AddJointRows(dynamics, contact.link, 1.0, contact);
    AddBodyRows(dynamics.num_dofs(), dynamics.p_WH(), contact.p_WC, 1.0, contact);
    AddBodyRows(dynamics.num_speeds(), p_WOcm, contact.p_WC, -1.0, contact);
  }
}

void Collider::YieldToHand(std::vector<ContactPoint>& contacts) {
  CalcSurfaceYields(*compressible_, pressing_, yields_);
  for (size_t i = 0; i < contacts.size(); ++i) {
    ContactPoint& contact = contacts[i];
    contact.surface = yields_[i];
    contact.p_WC -= 0.5 * CalcCompression(contact, contact.depth).surface * contact.nhat_BA_W;
  }
}

void Collider::FindHandTable(const HandDynamics& dynamics, int step_number,
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
      contact.material = link_table_[group.link];
      contact.nhat_BA_W = Vector3d::UnitZ();
      contact.p_WC = Vector3d(p_WS.x(), p_WS.y(), 0.5 * gap);
      contact.depth = -gap;
      contact.link = group.link;
      contact.memory = &hand_table_memory_[i];
      SetRadius(sphere.radius, contact);
      PrepareContact(h_, step_number, contact);
      AddJointRows(dynamics, group.link, 1.0, contact);
      AddBodyRows(dynamics.num_dofs(), dynamics.p_WH(), contact.p_WC, 1.0, contact);
    }
  }
}

void Collider::FindObjectTable(const HandDynamics& dynamics, const Pose& X_WO,
                               const Vector3d& p_WOcm, int step_number,
                               std::vector<ContactPoint>& contacts) {
  thread_local std::vector<TableSupport::Contact> supports;
  double face_factor = 1.0;
  support_->FindContacts(X_WO, kTableMargin, supports, face_factor);
  const auto memory_of = [&](const TableSupport::Contact& support) -> ContactMemory& {
    return object_table_memory_[static_cast<size_t>(support.id)];
  };
  // Centre of pressure of the last step, about which the friction of the face is distributed.
  Vector3d p_WPressure = Vector3d::Zero();
  double pressure = 0.0;
  for (const TableSupport::Contact& support : supports) {
    const ContactMemory& memory = memory_of(support);
    const bool is_known = step_number > 0 && memory.last_step == step_number - 1;
    const double fn = is_known ? memory.normal_force : kUnknownLoad;
    if (is_known && support.rolls) rolling_load_ += fn;
    p_WPressure += fn * support.p_W;
    pressure += fn;
  }
  if (pressure > 0.0) p_WPressure /= pressure;
  for (const TableSupport::Contact& support : supports) {
    ContactPoint& contact = contacts.emplace_back();
    contact.material = object_table_;
    contact.nhat_BA_W = Vector3d::UnitZ();
    contact.p_WC = support.p_W;
    contact.depth = -support.p_W.z();
    contact.is_on_object = true;
    contact.memory = &memory_of(support);
    PrepareContact(h_, step_number, contact);
    Vector3d p_WFriction = support.p_W;
    if (pressure > 0.0 && !support.is_round) {
      p_WFriction = p_WPressure + face_factor * (support.p_W - p_WPressure);
    }
    AddBodyRows(dynamics.num_speeds(), p_WOcm, p_WFriction, 1.0, contact);
  }
}

void Collider::FindSelfContacts(const HandDynamics& dynamics, int step_number,
                                std::vector<ContactPoint>& contacts) {
  placed_capsules_.resize(capsules_.size());
  for (size_t i = 0; i < capsules_.size(); ++i) {
    const Pose& X_WL = dynamics.X_WL(capsules_[i].link);
    PlacedCapsule& placed = placed_capsules_[i];
    placed.a = X_WL * capsules_[i].p_LA;
    placed.b = X_WL * capsules_[i].p_LB;
    placed.middle = 0.5 * (placed.a + placed.b);
  }
  for (size_t link = 0; link < p_LCapsules_.size(); ++link) {
    p_WCapsules_[link] = dynamics.X_WL(static_cast<int>(link)) * p_LCapsules_[link];
  }
  for (const SelfPairs& run : pairs_by_link_) {
    const Vector3d apart = placed_capsules_[run.a].middle - p_WCapsules_[run.link_b];
    if (apart.squaredNorm() > run.reach * run.reach) continue;
    for (int p = run.first; p < run.end; ++p) AddSelfContact(dynamics, p, step_number, contacts);
  }
}

void Collider::AddSelfContact(const HandDynamics& dynamics, int p, int step_number,
                              std::vector<ContactPoint>& contacts) {
  const SelfPair& pair = pairs_[p];
  const PlacedCapsule &placed_a = placed_capsules_[pair.a], &placed_b = placed_capsules_[pair.b];
  if ((placed_a.middle - placed_b.middle).squaredNorm() > pair.reach * pair.reach) return;
  const LinkCapsule &a = capsules_[pair.a], &b = capsules_[pair.b];
  const double radii = a.radius + b.radius;
  const ClosestPoints nearest = FindClosestPoints(placed_a.a, placed_a.b, placed_b.a, placed_b.b);
  const Vector3d apart = nearest.on_a - nearest.on_b;
  const double distance = apart.norm();
  if (distance > radii + kMargin || distance < 1e-9) return;
  ContactPoint& contact = contacts.emplace_back();
  contact.material = pair.material;
  contact.nhat_BA_W = apart / distance;
  contact.p_WC = nearest.on_b + (b.radius + 0.5 * (distance - radii)) * contact.nhat_BA_W;
  contact.depth = radii - distance;
  contact.link = a.link;
  contact.memory = &self_memory_[p];
  SetRadius(a.radius * b.radius / radii, contact);
  PrepareContact(h_, step_number, contact);
  // Both links are attached to the base, whose motion cancels.
  AddJointRows(dynamics, a.link, 1.0, contact);
  AddJointRows(dynamics, b.link, -1.0, contact);
}

void Collider::FindContacts(const HandDynamics& dynamics, const Pose& X_WO, const Vector3d& p_WOcm,
                            int step_number, std::vector<ContactPoint>& contacts) {
  contacts.clear();
  rolling_load_ = 0.0;
  FindHandObject(dynamics, X_WO, p_WOcm, step_number, contacts);
  if (table_ == TablePresence::kPresent) {
    FindHandTable(dynamics, step_number, contacts);
    FindObjectTable(dynamics, X_WO, p_WOcm, step_number, contacts);
  }
  FindSelfContacts(dynamics, step_number, contacts);
}

double Collider::CalcSmallestGap(const HandDynamics& dynamics, const Pose& X_WO) const {
  double gap = std::numeric_limits<double>::infinity();
  const Pose X_OW = X_WO.inverse();
  for (const ContactSphere& sphere : spheres_) {
    const Vector3d p_WS = dynamics.X_WL(sphere.link) * sphere.p_LS;
    gap = std::min(gap, field_->CalcDistance(X_OW * p_WS) - sphere.radius);
    if (table_ == TablePresence::kPresent) gap = std::min(gap, p_WS.z() - sphere.radius);
  }
  return gap;
}

}  // namespace graspbench
