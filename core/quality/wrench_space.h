#pragma once
/** @file
The grasp wrench space: what forces and moments the contacts of a grasp can put on the object.

A contact i at p_i with the unit normal n_i into the object transmits a force f inside its Coulomb
cone, f.n >= 0 and |f - (f.n) n| <= mu f.n, and, where a soft pad lies against the object, a moment
about the normal of at most torsion * f.n. The cone is replaced by an inscribed pyramid with m
edges, whose wrenches (the "generators") are, about the reference point R,

    w_ij = ( n_i + mu_i t_ij ,  (p_i - R) x (n_i + mu_i t_ij) / rho )         j = 1..m
    w_i+- = ( n_i ,  ((p_i - R) x n_i  +- torsion_i n_i) / rho )             soft pads only

with t_ij the m unit tangents at equal angles, beginning with the contact's first edge, and rho a
length that makes a moment comparable with a force. Every wrench the grasp can apply is a
combination of generators with weights >= 0; a weight is the newtons of normal force put into it.

Source: Ferrari and Canny, "Planning optimal grasps", ICRA 1992.
Limits: the pyramid lies inside the cone (at m = 8 a force between two edges reaches 92 % of the
friction), and friction and torsion share the normal force linearly (a double pyramid inside the
ellipsoidal limit surface of Howe and Cutkosky 1996): both err on the low side.

Frames: contacts are given in the object's frame O or any other one fixed to the object; all results
are expressed in the same frame. Units: m, N; wrenches are in N after the division by rho. */

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

namespace graspbench {

/** One point contact of a finger on the object. */
struct GraspContact {
  Eigen::Vector3d p_OC = Eigen::Vector3d::Zero();    ///< where [m]
  Eigen::Vector3d nhat_O = Eigen::Vector3d::Zero();  ///< unit normal, finger into object
  double mu = 0.0;  ///< Coulomb coefficient that holds in the contact's state, static or dynamic
  double torsion = 0.0;  ///< largest moment about the normal per newton of normal force [m]
  /** Direction of the first cone edge, projected into the tangent plane. Unset: the coordinate axis
  farthest from the normal; then the pyramid, unlike the cone, depends on the frame. */
  std::optional<Eigen::Vector3d> first_edge_O;
};

/** Which force of a generator has length one. */
enum class UnitForce {
  kNormal,  ///< its normal component; the edge itself is then sqrt(1 + mu^2) long
  kTotal,   ///< the whole force; wide cones then push less
};

/** How generators are formed; the choices differ between tools, see grasp_quality.h. */
struct WrenchSpace {
  int num_edges = 8;  ///< of each cone, >= 3
  UnitForce unit_force = UnitForce::kNormal;
  Eigen::Vector3d p_OR = Eigen::Vector3d::Zero();  ///< reference point of the moments [m]
  double torque_scale = 1.0;                       ///< rho > 0 [m]
};

using WrenchMatrix = Eigen::Matrix<double, 6, Eigen::Dynamic>;  ///< column = (force, moment / rho)

struct ConeWrenches {
  WrenchMatrix wrenches;             // (6 x num_generators) [N]
  std::vector<int> contact_indices;  // (num_generators) the contact each belongs to
};

/** All generators, contact by contact. A contact without friction has one: its normal.
@pre FindProblem finds nothing; space within its limits. */
ConeWrenches CalcConeWrenches(const std::vector<GraspContact>& contacts, const WrenchSpace& space);

/** The grasp matrix G (6 x k): wrench = G * contact forces, with the columns n, t1, t2 for a
contact with friction, n alone without, and a unit moment about n for a soft pad. */
WrenchMatrix CalcGraspMatrix(const std::vector<GraspContact>& contacts, const WrenchSpace& space);

/** Lengths below this share of the longest vector count as zero: far above rounding, far below what
a grasp can mean. */
inline constexpr double kNegligibleShare = 1e-9;

/** How many dimensions a set of points really fills: the indices of affinely independent columns,
chosen far apart, the longest first, then each time the one farthest from the flat through those
before. Fewer than rows + 1 indices: the set is flat. A flat set (two hard point fingers can make no
moment about the line between them, so their wrenches fill five dimensions) has no volume and no ball
around the origin: its quality is exactly zero, and neither a hull nor rounding may say otherwise. */
std::vector<int> FindAffineBasis(const Eigen::Ref<const Eigen::MatrixXd>& points);

/** Finite, and within 100 m of the frame's origin: what is farther is in another unit than metres.
 */
bool IsPosition(const Eigen::Vector3d& p);

/** What is wrong with a contact, in words ("the normal's length is 0.9; expected ..."); empty:
 * nothing. */
std::string FindProblem(const GraspContact& contact);

}  // namespace graspbench
