#pragma once
/** @file
Points of contact and their force law.

A contact lies between a side A (a link of the hand, or the object) and a side B (the object, or the
table). nhat points from B into A; relative velocity is that of A's point minus B's, so a positive
normal rate separates. Everything below is evaluated at the END of the step, with v the speeds then
and depth x0 the penetration at its middle:

    normal     fn = F(x0+ - (h + tau) (vn - x0-/h))       x0+ the depth or 0, x0- minus the gap or 0
                    F(x) = k x+ where both sides are bare, that of a pad where one is soft,
                    in series with the surface of a compressible object (soft_surface.h)
    friction   (ft, m/r) = -clip(kt (s + h vt) + ct vt, mu fn)
               with s = (bristle, r phi) and vt = (tangential speed, r wn)

Contacts are inelastic. tau is their relaxation time, 10 ms unless a surface has its own: a contact
is a spring with damping k tau beside it, which can only push. A mass m that meets n of them comes
back with
exp(-z / sqrt(z^2 - 1) ln((z + sqrt(z^2 - 1)) / (z - sqrt(z^2 - 1)))) of its speed, where
z = tau sqrt(n k / m) / 2 (Schwager and Poeschel 2007): with 0.005 for 50 g and 0.04 for 0.5 kg, more
than any thing of the catalogue, on one point. With tau = 8 ms that would be 0.06. Approach is felt
one step ahead, by what would be left of it at the surface.

Tangential force and torsion have one limit together, the ellipsoid (ft / (mu fn))^2 +
(m / (mu fn r))^2 = 1 (Howe and Cutkosky 1996); r = 0 leaves Coulomb's circle.

mu is mu_d from when the contact slides until it has not slid for kRestTime, and else mu_s: static
friction grows back with the time of rest (Dieterich 1972). Were it back at once, a contact would
stick and break loose step by step, and slide the slower the shorter the steps. A bristle is really
a spring: a sticking contact does not creep. Where a pad's patch grows, kt and r grow: the bristle
is then rescaled so that the energy in it stays, kt (s^2 + (r phi)^2) / 2. Not modelled: rolling
resistance, wear, adhesion. */

#include <Eigen/Geometry>
#include <array>
#include <limits>

#include "core/base/units.h"
#include "core/physics/sim_config.h"
#include "core/physics/soft_surface.h"
#include "core/shape/surface_material.h"

namespace graspbench {

/* Force over depth of a soft pad, and the patch of contact that results.

A ball of radius R with a pad of Young's modulus E and Poisson's ratio 1/2 pressed on something flat
and stiff (Hertz 1882; Johnson 1985, "Contact Mechanics", 4.2, 3.9 and 7.2):

    force over compression     F = 4/3 E* sqrt(R) y^1.5          E* = E / (1 - 1/4)
    radius of the patch        a = sqrt(R y)
    stiffness along it         kt = 4/3 E* a                     Mindlin 1949, nothing slips
    largest moment of twist    M = (3 pi / 16) mu F a            pressure of Hertz, all slips

The pad stands in series with the bare contact's spring: depth x = y + F / k, and a pad compressed
by all of its depth D yields no more: from there on F grows with k alone. Two pads on each other:
1/E* = 1/E1* + 1/E2*, 1/R = 1/R1 + 1/R2, D = D1 + D2.

Limits: small patches (a well below R and the pad's thickness; a thin layer on bone is stiffer), a
partner that is flat within the patch, no loss but that of every contact, a coefficient
of friction that does not fall with pressure; the twist's stiffness kt r^2 is a third of the true
one. A link touches with several balls: a cylinder's flank of balls 0.8 R apart is within a fifth of
a line contact, (pi / 4) E* y per length (Popov 2010), at compressions around R / 15. */

/** What both sides' pads come to. */
struct PadMaterial {
  double modulus = 0.0;  ///< E* [Pa]; 0: neither side has one
  double depth = 0.0;    ///< D [m]
  double torsion_scale = 1.0;

  bool is_soft() const { return modulus > 0.0; }
};

/** How a pad of force over compression F = hertz y^1.5, a spring and, of a compressible object, the
surface share a depth. */
struct PadCompression {
  double compression = 0.0;  ///< y of the pad [m]
  double force = 0.0;        ///< [N]
  double slope = 0.0;        ///< dF / dx [N/m]
  double surface = 0.0;      ///< y of the surface [m]
};

/** @param hertz  4/3 E* sqrt(R) [N/m^1.5]   @param stiffness  k [N/m]
@param pad_depth  D [m]   @param x  depth [m]; no force at or below zero. */
PadCompression CalcPadCompression(double hertz, double stiffness, double pad_depth, double x);

/** Of the radius of Hertz's patch, all of which slips: M / (mu F a). */
inline constexpr double kHertzTorsionShare = 3.0 * kPi / 16.0;

/** a under a force, of Hertz's contact alone: (3 F R / (4 E*))^(1/3). */
double CalcPatchRadius(double modulus, double radius, double force);

/** 4/3 E* sqrt(R). */
double CalcHertzFactor(double modulus, double radius);

inline constexpr double kContactRelaxationTime = 0.01;  ///< tau where no surface has one [s]

/** Constants of one pair of surfaces. */
struct ContactMaterial {
  double stiffness = 0.0;             ///< k [N/m]
  double tangential_stiffness = 0.0;  ///< kt [N/m]; 0 = no friction
  double friction_static = 0.0;
  double friction_dynamic = 0.0;
  double torsion_radius = 0.0;  ///< r [m]; 0 = no resistance to spin; of a pad the largest
  PadMaterial pad = {};         ///< of one or both sides
  double relaxation_time = kContactRelaxationTime;  ///< tau [s]
};

/** What a contact remembers from step to step. */
struct ContactMemory {
  Eigen::Vector3d stretch = Eigen::Vector3d::Zero();     ///< s, in W [m]
  double twist = 0.0;                                    ///< phi [rad]
  double tangential_stiffness = 0.0;                     ///< kt of the last step [N/m]
  double torsion_radius = 0.0;                           ///< r of the last step [m]
  double normal_force = 0.0;                             ///< of the last step [N]
  double normal_force_before = kUnset;                   ///< of the step before that [N]
  int last_step = -2;                                    ///< number of the last step it was alive
  int last_slide = std::numeric_limits<int>::min() / 2;  ///< of the last step it slid
};

/** Rows of a contact's rates and forces. */
enum ContactRow { kNormalRow, kTangentRow1, kTangentRow2, kSpinRow, kNumContactRows };

using ContactRates = std::array<double, kNumContactRows>;

struct ContactPoint {
  static constexpr int kMaxDofs = 24;
  static constexpr int kMaxChain =
      kMaxDofs / 2;  ///< joints between root and link: two chains, or one, base and object

  ContactMaterial material;   ///< with a pad, PrepareContact sets kt and r to those of the patch
  double hertz = 0.0;         ///< 4/3 E* sqrt(R) [N/m^1.5]; 0: bare
  SurfaceYield surface = {};  ///< of a compressible object
  Eigen::Vector3d p_WC = Eigen::Vector3d::Zero();
  Eigen::Vector3d nhat_BA_W = Eigen::Vector3d::UnitZ();
  Eigen::Vector3d tangent1_W = Eigen::Vector3d::UnitX();
  Eigen::Vector3d tangent2_W = Eigen::Vector3d::UnitY();
  double depth = 0.0;               ///< x0; negative: a gap [m]
  int link = -1;                    ///< hand link on side A; -1: none
  bool is_on_object = false;        ///< the object is one of the sides
  ContactMemory* memory = nullptr;  ///< null: without friction

  /** Rates = jacobian * v[dofs]. */
  int num_dofs = 0;
  std::array<int, kMaxDofs> dofs;
  std::array<std::array<double, kMaxDofs>, kNumContactRows> jacobian;

  /** In the frame of the contact, set by PrepareContact from the memory. */
  std::array<double, 2> stretch = {0.0, 0.0};
  double twist = 0.0;
  double friction_limit = 0.0;  ///< mu fn in this pass of the solver [N]
  bool is_dynamic = false;      ///< mu is that of sliding

  /** The normal force is not proportional to the depth. */
  bool is_nonlinear() const { return hertz > 0.0 || surface.factor > 0.0; }
  double mu() const { return is_dynamic ? material.friction_dynamic : material.friction_static; }
  int num_rows() const {
    if (!memory) return 1;
    return material.torsion_radius > 0.0 ? 4 : 3;
  }
};

/** Forces on side A along the rows. */
struct ContactForces {
  ContactRates force = {0.0, 0.0, 0.0, 0.0};
  double normal_slope = 0.0;  ///< of F where the normal force was taken [N/m]
  bool is_at_limit = false;   ///< friction was clipped
};

/** Negative derivatives of the forces by the rates. */
struct ContactGains {
  double normal = 0.0;  ///< -d fn / d vn >= 0
  /** Of the tangent rows and the spin row among each other: 11, 12, 22, 1s, 2s, ss. */
  std::array<double, 6> friction = {0, 0, 0, 0, 0, 0};
};

/** At this depth [m]; no force at or below zero. */
PadCompression CalcCompression(const ContactPoint& contact, double x);

/** Makes it that of a ball of this radius, which matters to a pad. @pre material is set. */
void SetRadius(double radius, ContactPoint& contact);

/** Chooses tangents, gives a pad its patch, turns the remembered bristle into them, and takes over
the last normal force.
A memory that was not alive in the last step is forgotten, but for when it slid. @param h  step [s]
*/
void PrepareContact(double h, int step_number, ContactPoint& contact);

/** The force law with the friction limit held fixed: then every force is the gradient of a convex
potential, which is what makes the solver robust. @param h  step [s]. */
ContactForces CalcContactForces(const ContactPoint& contact, const ContactRates& rates, double h);

/** Of the `forces` that CalcContactForces gives at the same rates. */
ContactGains CalcContactGains(const ContactPoint& contact, const ContactRates& rates,
                              const ContactForces& forces, double h);

/** Moves the bristles to the end of the step and remembers. @param mean_rates  of the speeds at the
step's start and end: where a body turns, those of its end alone would let a bristle that sticks
slip by h / 2 times the turn of its place. */
void FinishContact(const ContactPoint& contact, const ContactRates& mean_rates,
                   const ContactForces& forces, double h, int step_number);

/* The constants of a contact from the surfaces of its two sides: one rule for every pair.

    given on no side      stiffness: that of the session; no friction, no torsion
    given on one side     its value
    given on both sides   as springs in series, k = kA kB / (kA + kB)
                          mu = 2 muA muB / (muA + muB)
                          r = the smaller: the smaller patch of contact
                          tau = the longer one; given on no side kContactRelaxationTime

A soft pad stands in series with that spring, and its patch gives the torsion radius, if a side says
one at most that.

This is Simbody's rule for compliant contact (CompliantContactSubsystem, Sherman 2011), with what
was left out read as "the other side decides". The tangential stiffness keeps the session's ratio to
the normal one.

Friction is measured between two things. object.yaml gives it against a hand, so towards the table
an object's own is left out and sim.table_friction_* hold. */

ContactMaterial CombineSurfaces(const SurfaceMaterial& a, const SurfaceMaterial& b,
                                const SimConfig& config);

/** A link towards another one: sim.hand_friction_* where it says nothing of its own, and no
torsion, which is that of pads on a smooth object. */
SurfaceMaterial MakeSelfSurface(const SurfaceMaterial& link, const SimConfig& config);

/** The table: sim.table_friction_*, no torsion, else as the session has it. */
SurfaceMaterial MakeTableSurface(const SimConfig& config);

}  // namespace graspbench
