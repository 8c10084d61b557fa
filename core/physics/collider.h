#pragma once
/** @file
Finds the contact points of a scene: hand spheres against the object's distance field, hand spheres
and the object against the table (z = 0), and links of the hand against each other (capsules).
Movable parts of an object (keys, a folding rule) are rigid. The surface of a compressible object
yields to the hand (soft_surface.h); the contact point is then on the displaced surface.

Points with a gap below kMargin are included, so that the solver senses a fast approach one step
ahead. The order and the ids of contacts are fixed: the same scene gives the same list. */

#include <Eigen/Core>
#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "core/hand/hand.h"
#include "core/physics/contact.h"
#include "core/physics/hand_dynamics.h"
#include "core/physics/sim_config.h"
#include "core/physics/table_support.h"
#include "core/shape/grasp_object.h"

namespace graspbench {

class Collider {
 public:
  static constexpr double kMargin = 0.002;  ///< [m]

  Collider(const Hand& hand, const GraspObject& object, const SimConfig& config,
           TablePresence table);

  /** Forgets all bristles. */
  void Reset();

  /** Fills `contacts` for the hand's current positions and the object at X_WO, p_WOcm. The object's
  degrees of freedom follow the hand's speeds: w_WO (3), v_WOcm (3). */
  void FindContacts(const HandDynamics& dynamics, const Pose& X_WO, const Eigen::Vector3d& p_WOcm,
                    int step_number, std::vector<ContactPoint>& contacts);

  /** Returns the smallest gap between the hand and the object or table [m]; beyond the field's
  grid, a lower bound. */
  double CalcSmallestGap(const HandDynamics& dynamics, const Pose& X_WO) const;

  /** Normal force of the object's rolling contacts on the table in the last step; valid after
  FindContacts [N]. */
  double rolling_load() const { return rolling_load_; }

  /** Returns the height of the object's lowest point [m]. */
  double CalcLowestPoint(const Pose& X_WO) const { return support_->CalcLowestPoint(X_WO); }

 private:
  struct SelfPair {
    int a, b;      // indices into capsules_
    double reach;  // centres farther apart: no contact [m]
    ContactMaterial material;
  };
  /** Consecutive pairs of one capsule with the capsules of one link. */
  struct SelfPairs {
    int a, link_b;
    int first, end;  // in pairs_
    double reach;    // centres of a and of the link's capsules farther apart: no contact [m]
  };
  /** A ball that was apart from the object, and remains so until its centre has moved far
  enough. */
  struct Bystander {
    Eigen::Vector3d p_OCentre = Eigen::Vector3d::Zero();  // when it was last checked
    double way_squared = 0.0;                             // [m2]

    bool IsApart(const Eigen::Vector3d& p_ONow) const {
      return (p_ONow - p_OCentre).squaredNorm() < way_squared;
    }
    /** @param gap  from the distance field, above kMargin. */
    void Remember(const Eigen::Vector3d& p_ONow, double gap, double cell);
  };

  void GroupSpheres();
  void FindPairs(const Hand& hand);
  void GroupPairs(const Hand& hand);
  void CombineMaterials(const Hand& hand, const SurfaceMaterial& object, const SimConfig& config);
  static void AddJointRows(const HandDynamics& dynamics, int link, double sign,
                           ContactPoint& contact);
  /** Adds the rows of a body with six speeds, angular first, about p_WBody: the hand's base or the
  object.
  @param p_WFriction  point of action of the contact's friction. */
  static void AddBodyRows(int first_dof, const Eigen::Vector3d& p_WBody,
                          const Eigen::Vector3d& p_WFriction, double sign, ContactPoint& contact);
  void FindHandObject(const HandDynamics& dynamics, const Pose& X_WO, const Eigen::Vector3d& p_WOcm,
                      int step_number, std::vector<ContactPoint>& contacts);
  /** Lets a compressible object's surface yield to the contacts of pressing_, which are not
  prepared yet. */
  void YieldToHand(std::vector<ContactPoint>& contacts);
  void FindHandTable(const HandDynamics& dynamics, int step_number,
                     std::vector<ContactPoint>& contacts);
  void FindObjectTable(const HandDynamics& dynamics, const Pose& X_WO,
                       const Eigen::Vector3d& p_WOcm, int step_number,
                       std::vector<ContactPoint>& contacts);
  void FindSelfContacts(const HandDynamics& dynamics, int step_number,
                        std::vector<ContactPoint>& contacts);
  /** Adds the contact of pairs_[p] if its capsules are near each other. */
  void AddSelfContact(const HandDynamics& dynamics, int p, int step_number,
                      std::vector<ContactPoint>& contacts);

  double h_;  // step [s]
  TablePresence table_;
  std::vector<ContactSphere> spheres_;  // sorted by link
  struct LinkSpheres {
    int link;
    int first, count;  // in spheres_
    Eigen::Vector3d p_LCentre;
    double radius;  // of a ball that encloses them all
  };
  std::vector<LinkSpheres> link_spheres_;
  std::vector<Bystander> links_apart_, spheres_apart_;  // as link_spheres_, spheres_
  std::vector<LinkCapsule> capsules_;
  std::vector<Eigen::Vector3d> p_LCapsules_;  // by link: the centre of its capsules
  std::vector<SelfPair> pairs_;
  std::vector<SelfPairs> pairs_by_link_;
  struct PlacedCapsule {
    Eigen::Vector3d a, b, middle;  // of its axis, in W [m]
  };
  std::vector<PlacedCapsule> placed_capsules_;  // of the current step
  std::vector<Eigen::Vector3d> p_WCapsules_;    // p_LCapsules_ in W
  const SignedDistanceField* field_;
  std::optional<Compressibility> compressible_;
  std::vector<PressingBall> pressing_;  // of the current step, if the object is compressible
  std::vector<SurfaceYield> yields_;    // as pressing_
  std::shared_ptr<const TableSupport> support_;
  std::vector<ContactMaterial> link_object_, link_table_;  // by link
  ContactMaterial object_table_;
  double rolling_load_ = 0.0;
  std::vector<ContactMemory> hand_object_memory_, hand_table_memory_, object_table_memory_,
      self_memory_;
};

}  // namespace graspbench
