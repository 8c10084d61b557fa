#pragma once
/** @file
Finds the points of contact of a scene: hand spheres against the object's distance field, hand
spheres and the object against the table (z = 0), links of the hand against each other (capsules).
Movable parts of an object (keys, a folding rule) are rigid. The surface of a compressible object
gives way to the hand (soft_surface.h); the point of contact is then where the surface has gone.

Points with a gap below kMargin are included, so that a fast approach is felt one step ahead. Order
and names of contacts are fixed: the same scene gives the same list. */

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

  /** Fills `contacts` for the hand's current positions and the object at X_WO, p_WOcm.
  The object's degrees of freedom come after the hand's speeds: w_WO (3), v_WOcm (3). */
  void FindContacts(const HandDynamics& dynamics, const Pose& X_WO, const Eigen::Vector3d& p_WOcm,
                    int step_number, std::vector<ContactPoint>& contacts);

  /** Smallest gap between the hand and object or table; a lower bound beyond the field's grid [m].
   */
  double CalcSmallestGap(const HandDynamics& dynamics, const Pose& X_WO) const;

  /** With which the object's rolling contacts pressed on the table in the last step; after
  FindContacts [N]. */
  double rolling_load() const { return rolling_load_; }

  /** Lowest point of the object [m]. */
  double CalcLowestPoint(const Pose& X_WO) const { return support_->CalcLowestPoint(X_WO); }

 private:
  struct SelfPair {
    int a, b;      // indices into capsules_
    double reach;  // middles farther apart belong to capsules that are no contact [m]
    ContactMaterial material;
  };
  /** Pairs of one capsule with the capsules of one link, which follow each other. */
  struct SelfPairs {
    int a, link_b;
    int first, end;  // in pairs_
    double reach;    // middles of a and of the link's capsules farther apart: no contact [m]
  };
  /** A ball that was apart from the object, and is until its centre has gone far enough. */
  struct Bystander {
    Eigen::Vector3d p_OCentre = Eigen::Vector3d::Zero();  // when it was looked at
    double way_squared = 0.0;                             // [m2]

    bool IsApart(const Eigen::Vector3d& p_ONow) const {
      return (p_ONow - p_OCentre).squaredNorm() < way_squared;
    }
    /** @param gap  of the field, above kMargin. */
    void Remember(const Eigen::Vector3d& p_ONow, double gap, double cell);
  };

  void GroupSpheres();
  void FindPairs(const Hand& hand);
  void GroupPairs(const Hand& hand);
  void CombineMaterials(const Hand& hand, const SurfaceMaterial& object, const SimConfig& config);
  static void AddJointRows(const HandDynamics& dynamics, int link, double sign,
                           ContactPoint& contact);
  /** Rows of a body with six speeds, angular first, about p_WBody: the hand's base or the object.
  @param p_WFriction  where the contact's friction acts. */
  static void AddBodyRows(int first_dof, const Eigen::Vector3d& p_WBody,
                          const Eigen::Vector3d& p_WFriction, double sign, ContactPoint& contact);
  void FindHandObject(const HandDynamics& dynamics, const Pose& X_WO, const Eigen::Vector3d& p_WOcm,
                      int step_number, std::vector<ContactPoint>& contacts);
  /** Lets a compressible object's surface give way to contacts that are not prepared yet, those of
  pressing_. */
  void YieldToHand(std::vector<ContactPoint>& contacts);
  void FindHandTable(const HandDynamics& dynamics, int step_number,
                     std::vector<ContactPoint>& contacts);
  void FindObjectTable(const HandDynamics& dynamics, const Pose& X_WO,
                       const Eigen::Vector3d& p_WOcm, int step_number,
                       std::vector<ContactPoint>& contacts);
  void FindSelfContacts(const HandDynamics& dynamics, int step_number,
                        std::vector<ContactPoint>& contacts);
  /** Of pairs_[p], where it is near. */
  void AddSelfContact(const HandDynamics& dynamics, int p, int step_number,
                      std::vector<ContactPoint>& contacts);

  double h_;  // step [s]
  TablePresence table_;
  std::vector<ContactSphere> spheres_;  // sorted by link
  struct LinkSpheres {
    int link;
    int first, count;  // in spheres_
    Eigen::Vector3d p_LCentre;
    double radius;  // of a ball around them all
  };
  std::vector<LinkSpheres> link_spheres_;
  std::vector<Bystander> links_apart_, spheres_apart_;  // as link_spheres_, spheres_
  std::vector<LinkCapsule> capsules_;
  std::vector<Eigen::Vector3d> p_LCapsules_;  // by link: the middle of its capsules
  std::vector<SelfPair> pairs_;
  std::vector<SelfPairs> pairs_by_link_;
  struct PlacedCapsule {
    Eigen::Vector3d a, b, middle;  // of its axis, in W
  };
  std::vector<PlacedCapsule> placed_capsules_;  // of the current step
  std::vector<Eigen::Vector3d> p_WCapsules_;    // p_LCapsules_ in W
  const SignedDistanceField* field_;
  std::optional<Compressibility> compressible_;
  std::vector<PressingBall> pressing_;  // of the current step, where the object is compressible
  std::vector<SurfaceYield> yields_;    // as pressing_
  std::shared_ptr<const TableSupport> support_;
  std::vector<ContactMaterial> link_object_, link_table_;  // by link
  ContactMaterial object_table_;
  double rolling_load_ = 0.0;
  std::vector<ContactMemory> hand_object_memory_, hand_table_memory_, object_table_memory_,
      self_memory_;
};

}  // namespace graspbench
