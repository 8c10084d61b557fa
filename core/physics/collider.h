#pragma once
/** @file
Finds the points of contact of a scene: hand spheres against the object's distance field, hand
spheres and the object against the table (z = 0), links of the hand against each other (capsules,
without friction).

Points with a gap below kMargin are included, so that a fast approach is felt one step ahead. Order
and names of contacts are fixed: the same scene gives the same list. */

#include <Eigen/Core>
#include <array>
#include <vector>

#include "core/hand/hand.h"
#include "core/physics/contact.h"
#include "core/physics/hand_dynamics.h"
#include "core/physics/sim_config.h"
#include "core/shape/grasp_object.h"

namespace graspbench {

/** Pairs of Hand::capsules of different digits, or of a digit and the palm, that touch in the rest
posture: they are built so, and are no contact. */
std::vector<std::array<int, 2>> FindBuiltTouches(const Hand& hand);

class Collider {
 public:
  static constexpr double kMargin = 0.002;  ///< [m]

  Collider(const Hand& hand, const GraspObject& object, const SimConfig& config);

  /** Forgets all bristles. */
  void Reset();

  /** Fills `contacts` for the hand's current positions and the object at X_WO, p_WOcm.
  The degrees of freedom of the object are numbered from dynamics.num_dofs(): w_WO (3), v_WOcm (3).
  @param v_WH  velocity of the hand's root at the end of the step. */
  void FindContacts(const HandDynamics& dynamics, const Pose& X_WO, const Eigen::Vector3d& p_WOcm,
                    const Eigen::Vector3d& v_WH, int step_number,
                    std::vector<ContactPoint>& contacts);

  /** Smallest gap between the hand and object or table; a lower bound beyond the field's grid [m].
   */
  double CalcSmallestGap(const HandDynamics& dynamics, const Pose& X_WO) const;

  /** Lowest point of the object [m]. */
  double CalcLowestPoint(const Pose& X_WO) const;

 private:
  struct CapsulePair {
    int a, b;             // indices into capsules_
    double half_lengths;  // sum of both axes' half lengths
  };

  void AddHandRows(const HandDynamics& dynamics, int link, double sign, const Eigen::Vector3d& v_WH,
                   ContactPoint& contact) const;
  static void AddObjectRows(int first_dof, const Eigen::Vector3d& p_WOcm, double sign,
                            ContactPoint& contact);
  void FindHandObject(const HandDynamics& dynamics, const Pose& X_WO, const Eigen::Vector3d& p_WOcm,
                      const Eigen::Vector3d& v_WH, int step_number,
                      std::vector<ContactPoint>& contacts);
  void FindHandTable(const HandDynamics& dynamics, const Eigen::Vector3d& v_WH, int step_number,
                     std::vector<ContactPoint>& contacts);
  void FindObjectTable(const HandDynamics& dynamics, const Pose& X_WO,
                       const Eigen::Vector3d& p_WOcm, int step_number,
                       std::vector<ContactPoint>& contacts);
  void FindSelfContacts(const HandDynamics& dynamics, const Eigen::Vector3d& v_WH, int step_number,
                        std::vector<ContactPoint>& contacts);

  double h_;                            // step [s]
  std::vector<ContactSphere> spheres_;  // sorted by link
  struct LinkSpheres {
    int link;
    int first, count;  // in spheres_
    Eigen::Vector3d p_LCentre;
    double radius;  // of a ball around them all
  };
  std::vector<LinkSpheres> link_spheres_;
  std::vector<LinkCapsule> capsules_;
  std::vector<CapsulePair> pairs_;
  std::vector<std::array<Eigen::Vector3d, 2>> capsule_ends_;  // in W, of the current step
  const SignedDistanceField* field_;
  double object_radius_ = 0.0;                   // of a ball around the object's O
  std::vector<Eigen::Vector3d> support_points_;  // of the object, for the table
  ContactMaterial pad_material_, link_material_, table_material_, self_material_;
  std::vector<ContactMemory> hand_object_, hand_table_, object_table_;
};

}  // namespace graspbench
