#pragma once
/** @file
A robot hand as data: kinematic tree, mass, contact surface, drives, coupling, digits, looks.

The arm carries links[0], the root: the palm itself, or a forearm below wrist joints. Frame H is
fixed to the root and is the palm's frame with all joints at zero, so a hand with a straight wrist
has its palm at H. Every moving joint turns about or slides along an axis fixed in its frame J: with
X_PJ the joint frame in the parent link P, X_PL(q) = X_PJ * Rot(axis, q), or X_PJ * Shift(axis q).
A link's frame L is its joint's frame (URDF's rule).

Joint positions q hold one number for every moving joint, in the order of `joints`: radians of a
revolute one, metres of a prismatic one. Coupled joints are part of q but no degrees of freedom of
their own: see DistalMode. */

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

/** A ball fixed to a link; the hand's surface for contact is the union of its balls. */
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

/** A part to draw. */
struct LinkVisual {
  int link = -1;
  TriMesh mesh;                                                ///< in the link's frame [m]
  Eigen::Vector3f colour = Eigen::Vector3f(0.6f, 0.6f, 0.6f);  ///< linear RGB
};

struct HandLink {
  std::string name;
  int parent = -1;                                   ///< index into links; -1: none (the root)
  int joint = -1;                                    ///< index into joints; -1: fixed to parent
  Pose X_PJ = Pose::Identity();                      ///< joint frame in the parent link; root: X_HL
  Eigen::Vector3d axis = Eigen::Vector3d::UnitX();   ///< unit, in J; unused when fixed
  double mass = 0.0;                                 ///< [kg]
  Eigen::Vector3d p_LLcm = Eigen::Vector3d::Zero();  ///< centre of mass [m]
  Eigen::Matrix3d I_LLcm = Eigen::Matrix3d::Zero();  ///< about the centre of mass, axes of L
  SurfaceMaterial surface;  ///< a link that carries a pad has a torsion radius
};

/** Position drive: tau = clamp(stiffness (q_cmd - q) - damping qdot, +-torque_limit). The units are
those of a revolute joint; a prismatic one has N/m, N s/m and N. */
struct JointDrive {
  double stiffness = 0.0;     ///< [N m/rad]
  double damping = 0.0;       ///< [N m s/rad]
  double torque_limit = 0.0;  ///< [N m]
  /** What no data sheet gives, of joints that turn; core/physics/imperfect_drive.h says how. */
  ///@{
  double hysteresis_width = 0.0;  ///< of the loop between command and joint [rad]
  double friction_static = 0.0;   ///< torque at which a joint at rest breaks loose [N m]
  double friction_dynamic = 0.0;  ///< that which brakes it then, at most the other [N m]
  ///@}
  /** Armature: inertia of the rotor as the joint feels it through its gear. It resists the
  acceleration of what the drive moves, and nothing else: a turning hand does not turn it. */
  double armature = 0.0;  ///< [kg m^2]
};

struct HandJoint {
  std::string name;
  int link = -1;              ///< the link it moves
  bool is_prismatic = false;  ///< slides along its axis; otherwise turns about it
  double lower = 0.0;         ///< [rad], [m]
  double upper = 0.0;         ///< [rad], [m]
  JointDrive drive;           ///< of an actuated joint; unset for a coupled one
  int coupled_to = -1;        ///< index of the joint whose drive moves this one too; -1: own drive
  /** A linkage ties this joint to any other of the hand, whatever the hand's coupling rule:
  q = mimic_offset + mimic_ratio * q[coupled_to]. Without one, the other is the finger's middle
  joint. */
  bool is_mimic = false;
  double mimic_ratio = 1.0;
  double mimic_offset = 0.0;  ///< [rad], [m]
  /** How far a coupled joint that turns yields from where its coupling has it [rad/(N m)]; 0: rigid.
  core/physics/imperfect_drive.h. */
  double coupling_compliance = 0.0;
};

/** A joint's position as people give and read it: degrees, of a prismatic joint millimetres. */
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
  std::vector<int> links;                            ///< from the base outwards
  int distal_link = -1;                              ///< link that carries the pad
  Eigen::Vector3d p_LTip = Eigen::Vector3d::Zero();  ///< tip in the distal link [m]
  Eigen::Vector3d p_LPad = Eigen::Vector3d::Zero();  ///< middle of the pad's surface [m]
};

/** Fixed to a link. Its frame K: x right in the picture, y down, z forward; the axis meets the
picture's middle. Its lens: core/vision/camera_config.h. */
struct HandCamera {
  int link = -1;  ///< index into Hand::links
  Pose X_LK = Pose::Identity();
  int width = 640;              ///< [pixel]
  int height = 480;             ///< [pixel]
  double focal_length = 580.0;  ///< [pixel]
  double k1 = 0.0, k2 = 0.0;    ///< radial distortion
};

/** A frame F of the hand's description that is fixed to a link. */
struct NamedFrame {
  std::string name;
  int link = -1;  ///< index into Hand::links
  Pose X_LF = Pose::Identity();
};

struct Hand {
  std::string id;      ///< "shadow"
  std::string name;    ///< "Shadow Hand"
  std::string folder;  ///< where hand.urdf and hand.yaml were read; never written into results
  std::vector<HandLink> links;    ///< parents before children; links[0] is the root
  int palm_link = 0;              ///< index into links; joints between root and palm are a wrist
  std::vector<HandJoint> joints;  ///< all moving joints, finger by finger
  std::vector<Digit> digits;      ///< in the hand's order, e.g. FF MF RF LF TH
  CouplingRule coupling = CouplingRule::kMiddleFirst;
  double fixed_coupling_ratio = 0.8;  ///< J1 = ratio * J2 under kFixed
  double joint_accuracy = 0.0;  ///< half-width of the per-trial uniform error of each drive [rad]
  double slide_accuracy = 0.0;  ///< the same of the prismatic joints' drives [m]
  std::vector<ContactSphere> contact_spheres;
  std::vector<LinkCapsule> capsules;
  /** Links whose capsules never count as contact of the hand with itself: neighbours whose shapes
  overlap within their joint's limits. */
  std::vector<std::pair<int, int>> apart;
  std::vector<LinkVisual> visuals;
  Eigen::Vector3d p_HCentre = Eigen::Vector3d::Zero();      ///< middle of the palm's surface [m]
  Eigen::Vector3d palm_normal = -Eigen::Vector3d::UnitY();  ///< out of the palm, in H
  std::vector<NamedFrame> frames;           ///< for questions only: nothing is computed from them
  std::optional<HandCamera> camera;         ///< moves nothing: see content_hash
  std::shared_ptr<const TactileSkin> skin;  ///< tactile.h; null: it feels nothing. Moves nothing
  std::string content_hash;                 ///< of hand.urdf and of hand.yaml without its camera

  int num_joints() const { return static_cast<int>(joints.size()); }
  int FindJoint(const std::string& joint_name) const;  ///< -1: none
  int FindLink(const std::string& link_name) const;    ///< -1: none
  int FindDigitOfLink(int link) const;                 ///< -1: the palm or wrist
};

/** Indices of the joints with a drive of their own, from base to tip. */
std::vector<int> FindDrivenJoints(const Hand& hand, const Digit& digit);

/** Poses of all links in H, X_HL, for joint positions q (num_joints). With the wrist at zero the
palm's is the identity. */
std::vector<Pose> CalcLinkPoses(const Hand& hand, const Eigen::VectorXd& q);
/** That of one link, at the cost of its chain alone. */
Pose CalcLinkPose(const Hand& hand, const Eigen::VectorXd& q, int index);

/** Joints that follow another, eliminated from the equations.

A linkage (HandJoint::is_mimic) ties a joint to any other by a line, q = offset + ratio q_other, and
there is no more to it. The rest of this file is about fingers whose distal joint follows the middle
one.

One drive moves a finger's middle joint J2 and its distal joint J1 together; its coordinate is
theta.

    rule            angles                     (dJ2, dJ1) / dtheta
    even            J1 = J2 = theta            (1, 1)
    fixed           J2 = theta, J1 = r J2      (1, r), r = 0.8
    middle-first    J1 + J2 = theta            (1, 0) or (0, 1)

Under middle-first J2 moves while it can; when it is blocked (by an object at the middle or proximal
phalanx, or at its upper limit) J1 moves instead. Opening undoes J1 first. Always J2 >= J1 >= 0.

So at every instant the finger has one degree of freedom here, u_J = T_J dtheta/dt, and T_J is
constant within a step. A posture names J2 only; theta of a posture is that angle, J1 starts at zero
under middle-first and at its coupled value otherwise.

Which joint a middle-first pair moves in this step. */
enum class DistalMode { kMiddleMoves, kDistalMoves };

struct DistalRates {
  double middle = 1.0;  ///< dJ2 / dtheta
  double distal = 0.0;  ///< dJ1 / dtheta
};
DistalRates CalcDistalRates(CouplingRule rule, double fixed_ratio, DistalMode mode);

/** @param closing  the drive pushes towards closing.
@param middle_is_blocked  an object holds the middle or proximal phalanx back. */
DistalMode FindDistalMode(double q_middle, double q_distal, double middle_upper, bool closing,
                          bool middle_is_blocked, DistalMode previous);

/** Fills the coupled joints of q from those they follow, for a posture with nothing touching. */
void ApplyCoupling(const Hand& hand, Eigen::VectorXd& q);

}  // namespace graspbench
