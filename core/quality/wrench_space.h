#pragma once
/** @file
The grasp wrench space: the forces and moments that the contacts of a grasp can apply to the object.

A contact i at p_i with the unit normal n_i into the object transmits a force f inside its Coulomb
cone, f.n >= 0 and |f - (f.n) n| <= mu f.n. If a soft pad touches the object, it also transmits a
moment about the normal of at most torsion * f.n. The cone is replaced by an inscribed pyramid with
m edges. The wrenches of the edges (the "generators") about the reference point R are

    w_ij = ( n_i + mu_i t_ij ,  (p_i - R) x (n_i + mu_i t_ij) / rho )         j = 1..m
    w_i+- = ( n_i ,  ((p_i - R) x n_i  +- torsion_i n_i) / rho )             soft pads only

Here t_ij are m unit tangents at equal angles, starting with the contact's first edge, and rho is a
length that makes moments comparable with forces. Every wrench that the grasp can apply is a
combination of generators with weights >= 0; a weight is the normal force in newtons.

Source: Ferrari and Canny, "Planning optimal grasps", ICRA 1992. Limits: the pyramid is inside the
cone (at m = 8 a force between two edges reaches 92 % of the friction). Friction and torsion share
the normal force linearly (a double pyramid inside the ellipsoidal limit surface of Howe and
Cutkosky 1996). Both simplifications are conservative.

Frames: contacts are in the object's frame O or any other frame fixed to the object; all results are
in the same frame. Units: m, N; wrenches are in N after the division by rho. */

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

namespace graspbench {

/** One point contact of a finger on the object. */
struct GraspContact {
  Eigen::Vector3d p_OC = Eigen::Vector3d::Zero();    ///< position [m]
  Eigen::Vector3d nhat_O = Eigen::Vector3d::Zero();  ///< unit normal, finger into object
  double mu = 0.0;       ///< Coulomb coefficient in the contact's state, static or dynamic
  double torsion = 0.0;  ///< largest moment about the normal per newton of normal force [m]
  /** Direction of the first cone edge, projected into the tangent plane. Unset: the coordinate axis
  farthest from the normal. In that case the pyramid, unlike the cone, depends on the frame. */
  std::optional<Eigen::Vector3d> first_edge_O;
};

/** The force of a generator that has length one. */
enum class UnitForce {
  kNormal,  ///< normal component; the edge itself has length sqrt(1 + mu^2)
  kTotal,   ///< total force; the normal component of wide cones is smaller
};

/** Definition of the generators; tools differ in these choices, see grasp_quality.h. */
struct WrenchSpace {
  int num_edges = 8;  ///< of each cone, >= 3
  UnitForce unit_force = UnitForce::kNormal;
  Eigen::Vector3d p_OR = Eigen::Vector3d::Zero();  ///< reference point of the moments [m]
  double torque_scale = 1.0;                       ///< rho > 0 [m]
};

using WrenchMatrix = Eigen::Matrix<double, 6, Eigen::Dynamic>;  ///< column = (force, moment / rho)

struct ConeWrenches {
  WrenchMatrix wrenches;             // (6 x num_generators) [N]
  std::vector<int> contact_indices;  // (num_generators) contact of each generator
};

/** Returns all generators, contact by contact. A contact without friction has one: its normal.
@pre FindProblem finds nothing; `space` is within its limits. */
ConeWrenches CalcConeWrenches(const std::vector<GraspContact>& contacts, const WrenchSpace& space);

/** Returns the grasp matrix G (6 x k): wrench = G * contact forces. Columns are n, t1, t2 for a
contact with friction, only n without friction, and a unit moment about n for a soft pad. */
WrenchMatrix CalcGraspMatrix(const std::vector<GraspContact>& contacts, const WrenchSpace& space);

/** Lengths below this share of the longest vector count as zero. It is far above rounding errors
and far below relevant lengths. */
inline constexpr double kNegligibleShare = 1e-9;

/** Finds the dimension that a set of points spans: returns the indices of affinely independent
columns. The longest is first; each further one is the farthest from the flat through those before.
The set is flat if there are fewer than rows + 1 indices. A flat set has neither a volume nor a ball
around the origin, so its quality is exactly zero, independently of the hull and of rounding. An
example is two hard point fingers: they have no moment about the line between them, so their
wrenches span five dimensions. */
std::vector<int> FindAffineBasis(const Eigen::Ref<const Eigen::MatrixXd>& points);

/** Returns whether p is finite and within 100 m of the frame's origin; a farther position is in
another unit than metres. */
bool IsPosition(const Eigen::Vector3d& p);

/** Describes the problem of a contact ("the normal's length is 0.9; expected ..."); empty if there
is none. */
std::string FindProblem(const GraspContact& contact);

}  // namespace graspbench
