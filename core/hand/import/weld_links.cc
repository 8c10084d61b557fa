#include "core/hand/import/weld_links.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "core/base/text/text.h"
#include "core/base/units.h"
#include "core/hand/import/checks/find_hand.h"
#include "core/hand/import/foreign_hand.h"
#include "core/hand/import/select_hand.h"
#include "core/hand/import/shapes/shape_distance.h"

namespace graspbench {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kDensity = 1200.0;      // [kg/m^3]
constexpr double kLightest = 100.0;      // [kg/m^3] of a published mass, by the shapes' volume
constexpr double kHeaviest = 20000.0;    // [kg/m^3], by the volume of its bounds
constexpr double kFoam = 40.0;           // [kg/m^3]
constexpr double kHeaviestFrame = 20.0;  // [kg] of a link without extent
constexpr double kBallRadius = 0.005;    // [m] of a link between two axes
constexpr double kBallMass = 0.004;      // [kg]
constexpr double kFarthestFrame = 2.0;   // [m] along an axis, as in hand.yaml

bool Moves(const ForeignJoint& joint) { return joint.kind != ForeignJoint::Kind::kFixed; }

/** Moment of a ball of that mass and the greatest density, the body whose moments have the smallest
sum [kg m^2]. */
double CalcLeastMoment(double mass) {
  const double radius = std::cbrt(0.75 * mass / (kPi * kHeaviest));
  return 0.4 * mass * radius * radius;
}

/** Adds the mass of a part, about the common centre of mass. @param X_LM  the part's frame. */
void AddMass(const Pose& X_LM, const MassProperties& part, HandLink& link) {
  if (part.mass == 0.0) return;
  const Matrix3d R = X_LM.linear();
  const Vector3d apart = X_LM * part.p_OOcm - link.p_LLcm;
  const double total = link.mass + part.mass, reduced = link.mass * part.mass / total;
  link.I_LLcm += R * part.I_OOcm * R.transpose() +
                 reduced * (apart.squaredNorm() * Matrix3d::Identity() - apart * apart.transpose());
  link.p_LLcm += part.mass / total * apart;
  link.mass = total;
}

class Welder {
 public:
  Welder(ForeignHand& foreign, const std::vector<LoadedShapes>& shapes, const std::string& file,
         Diagnostics& problems)
      : foreign_(foreign),
        shapes_(shapes),
        file_(file),
        problems_(problems),
        tree_(MakeForeignTree(foreign)),
        body_of_(foreign.links.size(), 0),
        X_BM_(foreign.links.size(), Pose::Identity()) {}

  /** Returns false, with an error, if the remaining hand has no contact shape. */
  bool CheckDigits() {
    const size_t before = CountMoving();
    std::vector<bool> touches;
    for (const LoadedShapes& shapes : shapes_) touches.push_back(!shapes.collisions.empty());
    const std::vector<bool> has_body = FixEmptyEnds(touches, tree_, file_, problems_, foreign_);
    if (CountMoving() == before) return true;
    Diagnostics found;
    FindHand(foreign_, tree_, has_body, "", file_, found);
    for (const Diagnostic& entry : found.entries()) {
      if (entry.severity == Severity::kError) problems_.Fail(file_, entry.line, entry.text);
    }
    return found.num_errors() == 0;
  }

  ImportedHand Weld(int palm) {
    JudgeBodies();
    ImportedHand imported;
    Hand& hand = imported.hand;
    std::vector<int> link_of(foreign_.links.size(), -1);              // foreign -> welded
    std::vector<Pose> X_LM(foreign_.links.size(), Pose::Identity());  // member in its welded link
    std::vector<int> joint_of(foreign_.joints.size(), -1);
    bool is_root_named = false;
    Pose X_RootNamed = Pose::Identity();  // frame of the part that names the root
    for (const int member : tree_.order) {
      const int j = tree_.joint_of[member];
      if (j >= 0 && !Moves(foreign_.joints[j]) && !foreign_.joints[j].bears_jaw) {
        const int parent = foreign_.joints[j].parent;
        link_of[member] = link_of[parent];
        X_LM[member] = X_LM[parent] * foreign_.joints[j].X_PJ;
      } else {
        link_of[member] = static_cast<int>(hand.links.size());
        HandLink& link = hand.links.emplace_back();
        link.name = foreign_.links[member].name;
        imported.notes.emplace_back();
        imported.solids.emplace_back();
        if (j >= 0) {
          const ForeignJoint& joint = foreign_.joints[j];
          link.parent = link_of[joint.parent];
          link.X_PJ = X_LM[joint.parent] * joint.X_PJ;
          if (Moves(joint)) {
            link.axis = joint.axis;
            link.joint = joint_of[j] = hand.num_joints();
            HandJoint& moved = hand.joints.emplace_back();
            moved.name = joint.name;
            moved.link = link_of[member];
            moved.is_prismatic = joint.kind == ForeignJoint::Kind::kPrismatic;
            moved.lower = joint.lower;
            moved.upper = joint.upper;
            imported.drives.push_back(joint.drive);
          }
        }
      }
      const int index = link_of[member];
      HandLink& link = hand.links[index];
      const LoadedShapes& shapes = shapes_[member];
      if (index == 0 && !is_root_named && !shapes.collisions.empty()) {
        link.name = foreign_.links[member].name;  // not that of a mere frame such as "world"
        is_root_named = true;
        X_RootNamed = X_LM[member];
      }
      for (CollisionShape shape : shapes.collisions) {
        shape.link = index;
        shape.X_LS = X_LM[member] * shape.X_LS;
        imported.shapes.push_back(shape);
      }
      for (TriMesh solid : shapes.solids) {
        for (Vector3d& p : solid.vertices) p = X_LM[member] * p;
        imported.solids[index].push_back(std::move(solid));
      }
      for (ImportedVisual visual : shapes.visuals) {
        visual.solid.X_LS = X_LM[member] * visual.solid.X_LS;
        for (Vector3d& p : visual.mesh.vertices) p = X_LM[member] * p;
        imported.visuals.push_back({index, visual});
      }
      std::string note;
      const MassProperties mass = CalcMass(member, note);
      for (const std::string& fitted : shapes.notes) {
        note += (note.empty() ? "" : "; ") + fitted;
      }
      if (!note.empty()) {
        imported.notes[index] +=
            (imported.notes[index].empty() ? "" : "\n") + foreign_.links[member].name + ": " + note;
      }
      AddMass(X_LM[member], mass, link);
    }
    TieFollowers(joint_of, hand);
    FillWeightless(imported);
    MoveRootFrame(X_RootNamed.inverse(), imported);
    for (const int member : tree_.order) {
      const int index = link_of[member];
      if (index < 0) continue;
      const Pose& X_MF = foreign_.links[member].X_LF;
      const bool is_that_of_link = X_MF.matrix() == Pose::Identity().matrix();
      if (foreign_.links[member].name == hand.links[index].name && is_that_of_link) continue;
      const Pose X_LF = index == 0 ? Pose(X_RootNamed.inverse() * X_LM[member] * X_MF)
                                   : Pose(X_LM[member] * X_MF);
      if (X_LF.translation().cwiseAbs().maxCoeff() > kFarthestFrame) continue;  // of a scene
      hand.frames.push_back({foreign_.links[member].name, index, X_LF});
    }
    NarrowForFollowers(hand);
    imported.are_masses_published = are_masses_published_;
    hand.palm_link = link_of[palm];
    return imported;
  }

 private:
  size_t CountMoving() const {
    return static_cast<size_t>(
        std::count_if(foreign_.joints.begin(), foreign_.joints.end(), &Moves));
  }

  MassProperties CalcMass(int link, std::string& note) {
    const std::string fault = FindInertiaFault(link);
    const auto& published = foreign_.links[link].inertia;
    if (fault.empty()) {
      MassProperties mass;
      const Matrix3d R = published->X_LI.linear();
      mass.mass = published->mass;
      mass.p_OOcm = published->X_LI.translation();
      mass.I_OOcm = R * published->I_I * R.transpose();
      note = published->is_of_geoms ? "mass and inertia of its geoms, as MuJoCo takes them"
                                    : "mass and inertia as published";
      are_masses_published_ = are_masses_published_ && !published->is_of_geoms;
      return mass;
    }
    const auto& shapes = shapes_[link].collisions;
    if (BodyOf(link).is_believed && (!published || published->mass == 0.0)) {
      note = "no mass of its own: that of the parts it is fixed to is published";
      return {};
    }
    if (shapes.empty()) {
      const bool is_decoration = foreign_.links[link].is_decoration;
      if (published && published->mass > (is_decoration ? 0.0 : kHeaviestFrame)) {
        WarnAt(published->line,
               "link \"" + foreign_.links[link].name + "\": " + fault + "; left out");
      }
      return {};
    }
    are_masses_published_ = false;
    MassProperties mass = CalcUnionMass(shapes, kDensity);
    const double published_mass = published ? published->mass : 0.0;
    const double density = published_mass / (mass.mass / kDensity);
    const bool keeps_mass = density >= kLightest && density <= kHeaviest;
    if (keeps_mass) {
      mass.I_OOcm *= published_mass / mass.mass;
      mass.mass = published_mass;
    }
    note = std::string(keeps_mass ? "published mass" : "mass of its volume at 1200 kg/m^3") +
           ", inertia of its volume";
    WarnAt(published ? published->line : foreign_.links[link].line,
           "link \"" + foreign_.links[link].name + "\": " + fault + "; replaced: " + note + ", " +
               FormatSignificant(GFromKg(mass.mass), 3) + " g");
    return mass;
  }

  std::string FindInertiaFault(int link) const {
    const auto& inertia = foreign_.links[link].inertia;
    if (!inertia) return "no <inertial>";
    if (inertia->mass < 0.0) {
      return "a negative mass, " + FormatSignificant(inertia->mass, 3) + " kg";
    }
    if (inertia->mass == 0.0) return "no mass";
    const double scale = inertia->I_I.cwiseAbs().maxCoeff();
    if (scale == 0.0) return "no inertia";
    const Vector3d moments =
        Eigen::SelfAdjointEigenSolver<Matrix3d>(inertia->I_I / scale, Eigen::EigenvaluesOnly)
            .eigenvalues();
    if (moments[0] <= 0.0) return "a principal moment that is not positive";
    if (moments[0] + moments[1] < 0.9999 * moments[2]) {
      return "a principal moment larger than the sum of the others, which no body has";
    }
    const auto& shapes = shapes_[link].collisions;
    const Body& body = BodyOf(link);
    const double density = body.is_believed ? 0.0 : CalcLeastDensity(link);
    if (density > kHeaviest) {
      return "a mass of " + FormatSignificant(inertia->mass, 3) + " kg in bounds of " +
             FormatSignificant(1e6 * inertia->mass / density, 3) +
             " cm^3, denser than any metal: its mass or the size of its shapes is wrong";
    }
    if (moments[2] * scale < CalcLeastMoment(inertia->mass)) {
      return "an inertia of " + FormatSignificant(moments[2] * scale, 2) + " kg m^2 for " +
             FormatSignificant(GFromKg(inertia->mass), 3) +
             " g, less than a ball of the densest metal has";
    }
    if (shapes.empty()) {
      if (inertia->mass > kHeaviestFrame) {
        return "a mass of " + FormatSignificant(inertia->mass, 3) + " kg without extent";
      }
      return moments[2] * scale > inertia->mass ? "an inertia too large for its mass" : "";
    }
    if (!body.is_believed && inertia->mass < kFoam * CalcUnionMass(shapes, 1.0).mass) {
      return "a mass of " + FormatSignificant(GFromKg(inertia->mass), 3) +
             " g, lighter than any foam of its size; is it in another unit?";
    }
    const Eigen::AlignedBox3d bounds = body.is_believed ? body.bounds : CalcOwnBounds(link);
    const Vector3d p_com =
        (body.is_believed ? X_BM_[link] : Pose::Identity()) * inertia->X_LI.translation();
    if (bounds.exteriorDistance(p_com) > 0.005 + 0.2 * bounds.sizes().norm()) {
      return "a centre of mass " + FormatFixed(MmFromM(bounds.exteriorDistance(p_com)), 0) +
             " mm outside its shapes";
    }
    if (moments[2] * scale > 1.2 * inertia->mass * bounds.sizes().squaredNorm()) {
      return "an inertia too large for its mass and size";
    }
    return "";
  }

  /** Parts that are fixed to each other. A file may assign the mass of all to one of them, so it is
  judged by the extent of all. */
  struct Body {
    std::vector<int> members;
    Eigen::AlignedBox3d bounds;  // in the frame of the first part
    bool is_believed = false;    // the parts' masses fit its extent; false for a single part
  };
  const Body& BodyOf(int link) const { return bodies_[body_of_[link]]; }

  void JudgeBodies() {
    for (const int link : tree_.order) {
      const int j = tree_.joint_of[link];
      if (j < 0 || Moves(foreign_.joints[j])) {
        body_of_[link] = bodies_.size();
        bodies_.emplace_back();
      } else {
        body_of_[link] = body_of_[foreign_.joints[j].parent];
        X_BM_[link] = X_BM_[foreign_.joints[j].parent] * foreign_.joints[j].X_PJ;
      }
      bodies_[body_of_[link]].members.push_back(link);
    }
    for (Body& body : bodies_) {
      double mass = 0.0;
      std::vector<CollisionShape> shapes;
      for (const int link : body.members) {
        const auto& inertia = foreign_.links[link].inertia;
        if (inertia) mass += std::max(0.0, inertia->mass);
        const Eigen::AlignedBox3d own = CalcOwnBounds(link);
        if (!own.isEmpty()) body.bounds.extend(own.transformed(X_BM_[link]));
        for (CollisionShape shape : shapes_[link].collisions) {
          shape.X_LS = X_BM_[link] * shape.X_LS;
          shapes.push_back(shape);
        }
      }
      if (body.members.size() < 2 || mass == 0.0 || shapes.empty()) continue;
      body.is_believed = mass <= kHeaviest * std::max(body.bounds.volume(), 1e-9) &&
                         mass >= kFoam * CalcUnionMass(shapes, 1.0).mass;
    }
  }

  /** Bounds of all visuals and collision shapes. */
  Eigen::AlignedBox3d CalcOwnBounds(int link) const {
    const LoadedShapes& loaded = shapes_[static_cast<size_t>(link)];
    Eigen::AlignedBox3d bounds;
    if (!loaded.collisions.empty()) bounds = CalcBounds(loaded.collisions);
    for (const ImportedVisual& visual : loaded.visuals) {
      if (visual.mesh.triangles.empty()) bounds.extend(CalcBounds({visual.solid}));
      bounds.extend(CalcBounds(visual.mesh));
    }
    return bounds;
  }

  /** Published mass over the volume of the bounds; 0 if there is none. */
  double CalcLeastDensity(int link) const {
    const Eigen::AlignedBox3d bounds = CalcOwnBounds(link);
    if (bounds.isEmpty()) return 0.0;
    return foreign_.links[link].inertia->mass / std::max(bounds.volume(), 1e-9);
  }

  /** Changes the frame of the root. @param X_NR  the old frame in the new one. */
  static void MoveRootFrame(const Pose& X_NR, ImportedHand& imported) {
    HandLink& root = imported.hand.links[0];
    root.p_LLcm = X_NR * root.p_LLcm;
    root.I_LLcm = X_NR.linear() * root.I_LLcm * X_NR.linear().transpose();
    for (HandLink& link : imported.hand.links) {
      if (link.parent == 0) link.X_PJ = X_NR * link.X_PJ;
    }
    for (CollisionShape& shape : imported.shapes) {
      if (shape.link == 0) shape.X_LS = X_NR * shape.X_LS;
    }
    for (TriMesh& solid : imported.solids[0]) {
      for (Vector3d& p : solid.vertices) p = X_NR * p;
    }
    for (auto& [link, visual] : imported.visuals) {
      if (link != 0) continue;
      visual.solid.X_LS = X_NR * visual.solid.X_LS;
      for (Vector3d& p : visual.mesh.vertices) p = X_NR * p;
    }
  }

  /** @param joint_of  by foreign joint: its index in the hand; -1: none. */
  void TieFollowers(const std::vector<int>& joint_of, Hand& hand) {
    for (size_t j = 0; j < foreign_.joints.size(); ++j) {
      const auto& mimic = foreign_.joints[j].mimic;
      if (joint_of[j] < 0 || !mimic || joint_of[mimic->joint] < 0) continue;
      HandJoint& follower = hand.joints[joint_of[j]];
      follower.coupled_to = joint_of[mimic->joint];
      follower.is_mimic = !mimic->is_distal;
      follower.mimic_ratio = mimic->ratio;
      follower.mimic_offset = mimic->offset;
    }
  }

  void FillWeightless(ImportedHand& imported) {
    for (size_t i = 1; i < imported.hand.links.size(); ++i) {
      HandLink& link = imported.hand.links[i];
      if (link.mass > 0.0) continue;
      link.mass = kBallMass;
      link.p_LLcm.setZero();
      link.I_LLcm = 0.4 * kBallMass * kBallRadius * kBallRadius * Matrix3d::Identity();
      imported.notes[i] = link.name + ": a ball of 4 g and 5 mm, it has neither mass nor extent";
      WarnAt(0,
             "link \"" + link.name +
                 "\" has neither mass nor extent; between its joints' axes it gets a ball of 4 g");
    }
  }

  /** Restricts the limits of a joint so that its followers keep theirs. */
  void NarrowForFollowers(Hand& hand) {
    for (HandJoint& follower : hand.joints) {
      if (!follower.is_mimic) continue;
      HandJoint& driver = hand.joints[follower.coupled_to];
      double lower = (follower.lower - follower.mimic_offset) / follower.mimic_ratio;
      double upper = (follower.upper - follower.mimic_offset) / follower.mimic_ratio;
      if (lower > upper) std::swap(lower, upper);
      const double range = driver.upper - driver.lower;
      lower = std::max(lower, driver.lower);
      upper = std::min(upper, driver.upper);
      if (upper - lower < 0.5 * range) {
        const double a = follower.mimic_offset + follower.mimic_ratio * driver.lower;
        const double b = follower.mimic_offset + follower.mimic_ratio * driver.upper;
        const double most = follower.is_prismatic ? 0.999 : 6.28;  // [m], [rad]
        if (std::max(std::abs(a), std::abs(b)) > most) {
          WarnAt(0, "joint \"" + follower.name + "\" would follow \"" + driver.name +
                        "\" farther than any joint goes; it gets a drive of its own");
          follower.coupled_to = -1;
          follower.is_mimic = false;
          continue;
        }
        const double c = follower.mimic_offset - follower.mimic_ratio * driver.lower;
        const double d = follower.mimic_offset - follower.mimic_ratio * driver.upper;
        const double rounding = 0.02 * (follower.upper - follower.lower);
        const bool fits_reversed = std::min(c, d) > follower.lower - rounding &&
                                   std::max(c, d) < follower.upper + rounding;
        WarnAt(0,
               "joint \"" + follower.name + "\" follows \"" + driver.name +
                   "\" far beyond its own limits; they are ignored" +
                   (fits_reversed ? ". It would keep them with the opposite sign: is that of the "
                                    "coupling wrong?"
                                  : ""));
        follower.lower = std::min({follower.lower, a, b});
        follower.upper = std::max({follower.upper, a, b});
        continue;
      }
      const double kept = upper - lower, narrowed = range - kept;
      if (narrowed > 1e-3 * range) {
        const auto format = [](const HandJoint& joint, double from, double to) {
          return FormatFixed(ToDisplayUnits(joint, from), 1) + " to " +
                 FormatFixed(ToDisplayUnits(joint, to), 1) + " " + DisplayUnitOf(joint);
        };
        WarnAt(0, "joint \"" + driver.name + "\": its limits of " +
                      format(driver, driver.lower, driver.upper) + " are narrowed to " +
                      format(driver, lower, upper) + "; the limit of \"" + follower.name +
                      "\", which follows it, holds: " +
                      format(follower, follower.lower, follower.upper));
      }
      driver.lower = lower;
      driver.upper = upper;
    }
  }

  void WarnAt(int line, const std::string& text) { problems_.Warn(file_, line, text); }

  ForeignHand& foreign_;
  const std::vector<LoadedShapes>& shapes_;
  std::string file_;
  Diagnostics& problems_;
  ForeignTree tree_;
  std::vector<Body> bodies_;
  std::vector<size_t> body_of_;  // by link
  std::vector<Pose> X_BM_;       // by link: pose in the frame of its body's first part
  bool are_masses_published_ = true;
};

}  // namespace

ImportedHand WeldLinks(ForeignHand foreign, int palm, const std::vector<LoadedShapes>& shapes,
                       const std::string& file, Diagnostics& problems) {
  Welder welder(foreign, shapes, file, problems);
  if (!welder.CheckDigits()) return {};
  return welder.Weld(palm);
}

}  // namespace graspbench
