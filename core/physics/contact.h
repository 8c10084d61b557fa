#pragma once
/** @file
Contact points and their force law.

A contact is between a side A (a link of the hand, or the object) and a side B (the object, or the
table). nhat points from B into A. Relative velocity is that of A's point minus B's, so a positive
normal rate separates. All quantities below are evaluated at the END of the step, with v the speeds
at that time and depth x0 the penetration at the middle of the step:

    normal     fn = F(x0+ - (h + tau) (vn - x0-/h))       x0+ the depth or 0, x0- minus the gap or 0
                    F(x) = k x+ where both sides are bare, that of a pad where one is soft,
                    in series with the surface of a compressible object (soft_surface.h)
    friction   (ft, m/r) = -clip(kt (s + h vt) + ct vt, mu fn)
               with s = (bristle, r phi) and vt = (tangential speed, r wn)

Contacts are inelastic. tau is their relaxation time, 10 ms unless a surface has its own. A contact
is a spring with a parallel damper k tau that can only push. A mass m that hits n of them rebounds
with the fraction exp(-z / sqrt(z^2 - 1) ln((z + sqrt(z^2 - 1)) / (z - sqrt(z^2 - 1)))) of its
speed, where z = tau sqrt(n k / m) / 2 (Schwager and Poeschel 2007). On one point the fraction is
0.005 for 50 g and 0.04 for 0.5 kg, more than any object of the catalogue weighs. With tau = 8 ms it
would be 0.06. An approach is sensed one step ahead, by the speed that would remain at the surface.

Tangential force and torsion share one limit, the ellipsoid (ft / (mu fn))^2 + (m / (mu fn r))^2 = 1
(Howe and Cutkosky 1996); r = 0 leaves Coulomb's circle.

mu is mu_d from the onset of sliding until the contact has not slid for kRestTime, and mu_s
otherwise: static friction recovers with the time at rest (Dieterich 1972). If it recovered at once,
a contact would alternately stick and break loose in every step, and slide more slowly the shorter
the steps. A bristle is a true spring: a sticking contact does not creep. If a pad's patch grows, kt
and r grow. The bristle is then rescaled to preserve its energy kt (s^2 + (r phi)^2) / 2. Not
modelled: rolling resistance, wear, adhesion. */

#include <Eigen/Geometry>
#include <array>
#include <limits>

#include "core/base/units.h"
#include "core/physics/sim_config.h"
#include "core/physics/soft_surface.h"
#include "core/shape/surface_material.h"

namespace graspbench {

/* Force-depth law of a soft pad, and the resulting contact patch.

For a ball of radius R with a pad of Young's modulus E and Poisson's ratio 1/2 that is pressed on a
flat and stiff surface (Hertz 1882; Johnson 1985, "Contact Mechanics", 4.2, 3.9 and 7.2):

    force over compression     F = 4/3 E* sqrt(R) y^1.5          E* = E / (1 - 1/4)
    radius of the patch        a = sqrt(R y)
    tangential stiffness       kt = 4/3 E* a                     Mindlin 1949, no slip
    largest torsional moment   M = (3 pi / 16) mu F a            Hertz pressure, full slip

The pad is in series with the spring of the bare contact: depth x = y + F / k. A pad that is
compressed by its full depth D yields no further; beyond that, F grows with k alone. For two pads:
1/E* = 1/E1* + 1/E2*, 1/R = 1/R1 + 1/R2, D = D1 + D2.

Limits: small patches (a well below R and the pad's thickness; a thin layer on bone is stiffer), a
partner that is flat within the patch, no losses except those of every contact, and a coefficient of
friction that does not fall with pressure. The torsional stiffness kt r^2 is a third of the true
one. A link touches with several balls: a cylinder's flank of balls 0.8 R apart is within a fifth of
a line contact, (pi / 4) E* y per length (Popov 2010), at compressions around R / 15. */

/** Combined pad of both sides. */
struct PadMaterial {
  double modulus = 0.0;  ///< E* [Pa]; 0: neither side has a pad
  double depth = 0.0;    ///< D [m]
  double torsion_scale = 1.0;

  bool is_soft() const { return modulus > 0.0; }
};

/** Distribution of a depth over a pad with F = hertz y^1.5, a spring and, for a compressible
object, its surface. */
struct PadCompression {
  double compression = 0.0;  ///< y of the pad [m]
  double force = 0.0;        ///< [N]
  double slope = 0.0;        ///< dF / dx [N/m]
  double surface = 0.0;      ///< y of the surface [m]
};

/** Solves for the compression of a pad in series with a spring.
@param hertz  4/3 E* sqrt(R) [N/m^1.5]   @param stiffness  k [N/m]
@param pad_depth  D [m]   @param x  depth [m]; the force is 0 for x <= 0. */
PadCompression CalcPadCompression(double hertz, double stiffness, double pad_depth, double x);

/** M / (mu F a) for a Hertz patch with full slip. */
inline constexpr double kHertzTorsionShare = 3.0 * kPi / 16.0;

/** Returns a under a force, for a pure Hertz contact: (3 F R / (4 E*))^(1/3). */
double CalcPatchRadius(double modulus, double radius, double force);

/** Returns 4/3 E* sqrt(R). */
double CalcHertzFactor(double modulus, double radius);

inline constexpr double kContactRelaxationTime = 0.01;  ///< tau if neither surface has one [s]

/** Constants of one pair of surfaces. */
struct ContactMaterial {
  double stiffness = 0.0;             ///< k [N/m]
  double tangential_stiffness = 0.0;  ///< kt [N/m]; 0 = no friction
  double friction_static = 0.0;
  double friction_dynamic = 0.0;
  double torsion_radius = 0.0;  ///< r [m]; 0 = no torsional resistance; for a pad its maximum
  PadMaterial pad = {};         ///< of one or both sides
  double relaxation_time = kContactRelaxationTime;  ///< tau [s]
};

/** State of a contact between steps. */
struct ContactMemory {
  Eigen::Vector3d stretch = Eigen::Vector3d::Zero();     ///< s, in W [m]
  double twist = 0.0;                                    ///< phi [rad]
  double tangential_stiffness = 0.0;                     ///< kt of the last step [N/m]
  double torsion_radius = 0.0;                           ///< r of the last step [m]
  double normal_force = 0.0;                             ///< of the last step [N]
  double normal_force_before = kUnset;                   ///< of the step before that [N]
  int last_step = -2;                                    ///< number of the last step with a force
  int last_slide = std::numeric_limits<int>::min() / 2;  ///< number of the last step with sliding
};

/** Rows of a contact's rates and forces. */
enum ContactRow { kNormalRow, kTangentRow1, kTangentRow2, kSpinRow, kNumContactRows };

using ContactRates = std::array<double, kNumContactRows>;

struct ContactPoint {
  static constexpr int kMaxDofs = 24;
  static constexpr int kMaxChain =
      kMaxDofs / 2;  ///< joints between root and link: two chains, or one, base and object

  ContactMaterial material;   ///< with a pad, PrepareContact sets kt and r to the patch's
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

  /** In the contact's frame; PrepareContact sets them from the memory. */
  std::array<double, 2> stretch = {0.0, 0.0};
  double twist = 0.0;
  double friction_limit = 0.0;  ///< mu fn in this pass of the solver [N]
  bool is_dynamic = false;      ///< mu is the dynamic coefficient

  /** Returns whether the normal force is nonlinear in the depth. */
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
  double normal_slope = 0.0;  ///< slope of F at the normal force [N/m]
  bool is_at_limit = false;   ///< friction was clipped
};

/** Negative derivatives of the forces by the rates. */
struct ContactGains {
  double normal = 0.0;  ///< -d fn / d vn >= 0
  /** Gains between the tangent rows and the spin row: 11, 12, 22, 1s, 2s, ss. */
  std::array<double, 6> friction = {0, 0, 0, 0, 0, 0};
};

/** Computes the compression at this depth [m]; the force is 0 for x <= 0. */
PadCompression CalcCompression(const ContactPoint& contact, double x);

/** Makes the contact that of a ball of this radius, which affects pads only. @pre material is
set. */
void SetRadius(double radius, ContactPoint& contact);

/** Prepares a contact for a step: chooses tangents, sets the patch of a pad, rotates the stored
bristle into the tangents, and predicts the friction limit from the last normal forces. A memory
without a force in the last step is cleared, except for its last slide. @param h  step [s] */
void PrepareContact(double h, int step_number, ContactPoint& contact);

/** Computes the forces with the friction limit held fixed. Then every force is the gradient of a
convex potential, which makes the solver robust. @param h  step [s]. */
ContactForces CalcContactForces(const ContactPoint& contact, const ContactRates& rates, double h);

/** Computes the gains; `forces` is the result of CalcContactForces at the same rates. */
ContactGains CalcContactGains(const ContactPoint& contact, const ContactRates& rates,
                              const ContactForces& forces, double h);

/** Moves the bristles to the end of the step and updates the memory.
@param mean_rates  at the mean of the speeds at the step's start and end. With the end speeds alone,
a sticking bristle on a rotating body would slip by h / 2 times the rotation of its position. */
void FinishContact(const ContactPoint& contact, const ContactRates& mean_rates,
                   const ContactForces& forces, double h, int step_number);

/* Constants of a contact from the surfaces of its two sides, by one rule for every pair.

    given on no side      stiffness: that of the session; no friction, no torsion
    given on one side     its value
    given on both sides   as springs in series, k = kA kB / (kA + kB)
                          mu = 2 muA muB / (muA + muB)
                          r = the smaller: the smaller patch of contact
                          tau = the longer one; given on no side kContactRelaxationTime

A soft pad is in series with that spring. Its patch gives the torsion radius, which does not exceed
a given r.

This is Simbody's rule for compliant contact (CompliantContactSubsystem, Sherman 2011), with a
missing value interpreted as "the other side decides". The tangential stiffness keeps the session's
ratio to the normal one.

Friction is measured between two materials. object.yaml gives it against a hand, so for the table an
object's own friction is ignored and sim.table_friction_* apply. */

ContactMaterial CombineSurfaces(const SurfaceMaterial& a, const SurfaceMaterial& b,
                                const SimConfig& config);

/** Returns the surface of a link for contact with another link. sim.hand_friction_* apply if the
link specifies no friction. There is no torsion, which applies to pads on a smooth object. */
SurfaceMaterial MakeSelfSurface(const SurfaceMaterial& link, const SimConfig& config);

/** Returns the surface of the table: sim.table_friction_*, no torsion, otherwise the session's
values. */
SurfaceMaterial MakeTableSurface(const SimConfig& config);

}  // namespace graspbench
