#pragma once
/** @file
A robot hand as data: kinematic tree, mass, contact surface, drives, coupling, digits, visuals.

The arm carries links[0], the root: the palm itself, or a forearm below the wrist joints. Frame H is
fixed to the root. It coincides with the palm's frame when all joints are at zero, so a hand with a
straight wrist has its palm at H. Every moving joint rotates about or slides along an axis that is
fixed in its frame J. With X_PJ the joint frame in the parent link P, X_PL(q) = X_PJ * Rot(axis, q),
or X_PJ * Shift(axis q). A link's frame L is the frame of its joint, as in URDF.

The vector q holds one position per moving joint, in the order of `joints`: radians for a revolute
joint, metres for a prismatic one. Coupled joints are part of q but are not independent degrees of
freedom: see DistalMode. */

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/pose.h"
#include "core/shape/surface_material.h"
#include "core/shape/tri_mesh.h"

namespace graspbench {

struct TactileSkin;

/** A ball fixed to a link; the contact surface of the hand is the union of its balls. */
struct ContactSphere {
  int link = -1;                                   ///< index into Hand::links
  Eigen::Vector3d p_LS = Eigen::Vector3d::Zero();  ///< centre in the link's frame [m]
  double radius = 0.0;                             ///< [m]
};

/** A capsule of a link, for contact of the hand with itself. */
struct LinkCapsule {
  int link = -1;
  Eigen::Vector3d p_LA = Eigen::Vector3d::Zero();  ///< ends of the axis in the link's frame [m]
  Eigen::Vector3d p_LB = Eigen::Vector3d::Zero();
  double radius = 0.0;  ///< [m]
};

/** A mesh to draw. */
struct LinkVisual {
  int link = -1;
  TriMesh mesh;                                                ///< in the link's frame [m]
  Eigen::Vector3f colour = Eigen::Vector3f(0.6f, 0.6f, 0.6f);  ///< linear RGB
};

struct HandLink {
  std::string name;
  int parent = -1;                                   ///< index into links; -1: none (the root)
  int joint = -1;                                    ///< index into joints; -1: fixed to parent
  Pose X_PJ = Pose::Identity();                      ///< joint frame in the parent link; for the
                                                     ///< root X_HL
  Eigen::Vector3d axis = Eigen::Vector3d::UnitX();   ///< unit, in J; unused for a fixed joint
  double mass = 0.0;                                 ///< [kg]
  Eigen::Vector3d p_LLcm = Eigen::Vector3d::Zero();  ///< centre of mass [m]
  Eigen::Matrix3d I_LLcm = Eigen::Matrix3d::Zero();  ///< about the centre of mass, axes of L
  SurfaceMaterial surface;  ///< has a torsion radius if the link carries a pad
};

/** Position drive: tau = clamp(stiffness (q_cmd - q) - damping qdot, +-torque_limit). The units
given are those of a revolute joint; a prismatic joint has N/m, N s/m and N. */
struct JointDrive {
  double stiffness = 0.0;     ///< [N m/rad]
  double damping = 0.0;       ///< [N m s/rad]
  double torque_limit = 0.0;  ///< [N m]
  /** Imperfections of a revolute drive that no data sheet gives: core/physics/imperfect_drive.h. */
  ///@{
  double hysteresis_width = 0.0;  ///< width of the loop between command and joint [rad]
  double friction_static = 0.0;   ///< torque at which a joint at rest breaks loose [N m]
  double friction_dynamic = 0.0;  ///< friction torque in motion, at most friction_static [N m]
  ///@}
  /** Armature: inertia of the rotor reflected through the gear. It resists only acceleration of the
  joint relative to its parent: rotation of the whole hand does not turn the rotor. */
  double armature = 0.0;  ///< [kg m^2]
};

struct HandJoint {
  std::string name;
  int link = -1;              ///< link that the joint moves
  bool is_prismatic = false;  ///< slides along its axis; otherwise rotates about it
  double lower = 0.0;         ///< [rad], [m]
  double upper = 0.0;         ///< [rad], [m]
  JointDrive drive;           ///< drive of an actuated joint; unset for a coupled one
  int coupled_to = -1;        ///< index of the joint whose drive also moves this one; -1: own drive
  /** Whether a linkage couples this joint to any other joint, independently of the hand's coupling
  rule: q = mimic_offset + mimic_ratio * q[coupled_to]. If false, a coupled joint follows the
  finger's middle joint by that rule. */
  bool is_mimic = false;
  double mimic_ratio = 1.0;
  double mimic_offset = 0.0;  ///< [rad], [m]
  /** Compliance of a coupled revolute joint about the position that its coupling prescribes
  [rad/(N m)]; 0: rigid. See core/physics/imperfect_drive.h. */
  double coupling_compliance = 0.0;
};

/** Joint position in the units of files and reports: degrees, or millimetres if prismatic. */
///@{
double ToDisplayUnits(const HandJoint& joint, double position);
double FromDisplayUnits(const HandJoint& joint, double displayed);
const char* DisplayUnitOf(const HandJoint& joint);  ///< "deg", "mm"
///@}

/** How a distal joint follows its middle joint. */
enum class CouplingRule { kMiddleFirst, kEven, kFixed };
std::string NameOf(CouplingRule rule);  ///< "middle-first", "even", "fixed"
const std::vector<CouplingRule>& ListCouplingRules();

struct Digit {
  std::string id;    ///< "TH", "FF", "MF", "RF", "LF"
  std::string name;  ///< "thumb", "index", ...
  bool is_thumb = false;
  std::vector<int> links;                            ///< from the base to the tip
  int distal_link = -1;                              ///< the link that carries the pad
  Eigen::Vector3d p_LTip = Eigen::Vector3d::Zero();  ///< tip, in the distal link's frame [m]
  Eigen::Vector3d p_LPad = Eigen::Vector3d::Zero();  ///< centre of the pad's surface, likewise [m]
};

/** Camera fixed to a link. Frame K: x to the right of the image, y down, z forward along the
optical axis, which passes through the image centre. Lens model: core/vision/camera_config.h. */
struct HandCamera {
  int link = -1;  ///< index into Hand::links
  Pose X_LK = Pose::Identity();
  int width = 640;              ///< [pixel]
  int height = 480;             ///< [pixel]
  double focal_length = 580.0;  ///< [pixel]
  double k1 = 0.0, k2 = 0.0;    ///< radial distortion
};

/** An additional frame F of the hand's description, fixed to a link. */
struct NamedFrame {
  std::string name;
  int link = -1;  ///< index into Hand::links
  Pose X_LF = Pose::Identity();
};

struct Hand {
  std::string id;                 ///< "shadow"
  std::string name;               ///< "Shadow Hand"
  std::string folder;             ///< folder of hand.urdf and hand.yaml; never written into results
  std::vector<HandLink> links;    ///< parents before children; links[0] is the root
  int palm_link = 0;              ///< index into links; joints between root and palm form a wrist
  std::vector<HandJoint> joints;  ///< all moving joints, finger by finger
  std::vector<Digit> digits;      ///< in the hand's order, e.g. FF MF RF LF TH
  CouplingRule coupling = CouplingRule::kMiddleFirst;
  double fixed_coupling_ratio = 0.8;  ///< J1 = ratio * J2 under kFixed
  double joint_accuracy = 0.0;  ///< half-width of the per-trial uniform error of each drive [rad]
  double slide_accuracy = 0.0;  ///< the same for drives of prismatic joints [m]
  std::vector<ContactSphere> contact_spheres;
  std::vector<LinkCapsule> capsules;
  /** Pairs of links whose capsules never count as self-contact: neighbours whose shapes overlap
  within their joint limits. */
  std::vector<std::pair<int, int>> apart;
  std::vector<LinkVisual> visuals;
  Eigen::Vector3d p_HCentre = Eigen::Vector3d::Zero();      ///< centre of the palm's surface [m]
  Eigen::Vector3d palm_normal = -Eigen::Vector3d::UnitY();  ///< out of the palm, in H
  std::vector<NamedFrame> frames;           ///< for queries only: no computation depends on them
  std::optional<HandCamera> camera;         ///< no effect on motion: see content_hash
  std::shared_ptr<const TactileSkin> skin;  ///< tactile.h; null: no touch sensors; no effect on
                                            ///< motion
  std::string content_hash;                 ///< of hand.urdf, and of hand.yaml without its camera

  int num_joints() const { return static_cast<int>(joints.size()); }
  int FindJoint(const std::string& joint_name) const;  ///< -1: none
  int FindLink(const std::string& link_name) const;    ///< -1: none
  int FindDigitOfLink(int link) const;                 ///< -1: palm or wrist
};

/** Indices of the joints with a drive of their own, from base to tip. */
std::vector<int> FindDrivenJoints(const Hand& hand, const Digit& digit);

/** Poses X_HL of all links in H for joint positions q (num_joints). With the wrist at zero, the
palm's pose is the identity. */
std::vector<Pose> CalcLinkPoses(const Hand& hand, const Eigen::VectorXd& q);
/** Pose of one link, computed along its chain only. */
Pose CalcLinkPose(const Hand& hand, const Eigen::VectorXd& q, int index);

/** Joints that follow another joint and are eliminated from the equations.

A linkage (HandJoint::is_mimic) couples a joint to any other linearly: q = offset + ratio q_other.
The rest of this file concerns fingers whose distal joint follows the middle one.

One drive moves the middle joint J2 and the distal joint J1 of a finger together. Its coordinate is
theta.

    rule            angles                     (dJ2, dJ1) / dtheta
    even            J1 = J2 = theta            (1, 1)
    fixed           J2 = theta, J1 = r J2      (1, r), r = 0.8
    middle-first    J1 + J2 = theta            (1, 0) or (0, 1)

Under middle-first J2 moves while it can. When J2 is blocked (by an object at the middle or proximal
phalanx, or at its upper limit), J1 moves instead. Opening moves J1 back first, so J2 >= J1 >= 0.

The finger thus has one degree of freedom at every instant, u_J = T_J dtheta/dt, with T_J constant
within a step. A posture specifies J2 only, which is its theta. J1 starts at zero under middle-first
and at its coupled value otherwise.

The mode tells which joint of a middle-first pair moves in this step. */
enum class DistalMode { kMiddleMoves, kDistalMoves };

struct DistalRates {
  double middle = 1.0;  ///< dJ2 / dtheta
  double distal = 0.0;  ///< dJ1 / dtheta
};
DistalRates CalcDistalRates(CouplingRule rule, double fixed_ratio, DistalMode mode);

/** @param closing  whether the drive pushes in the closing direction.
@param middle_is_blocked  whether an object holds back the middle or proximal phalanx. */
DistalMode FindDistalMode(double q_middle, double q_distal, double middle_upper, bool closing,
                          bool middle_is_blocked, DistalMode previous);

/** Computes the coupled joints of q from the joints that they follow, for a posture without
contact. */
void ApplyCoupling(const Hand& hand, Eigen::VectorXd& q);

}  // namespace graspbench
