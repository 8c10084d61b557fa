#pragma once
/** @file
Points of contact and their force law.

A contact lies between a side A (a link of the hand, or the object) and a side B (the object, or the
table). nhat points from B into A; relative velocity is that of A's point minus B's, so a positive
normal rate separates. Everything below is evaluated at the END of the step, with v the speeds then
and depth x0 the penetration at its middle:

    normal     fn = F(x0+ - (h + tau) (vn - x0-/h))       x0+ the depth or 0, x0- minus the gap or 0
                    F(x) = k x+ where both sides are bare, that of pad_contact.h where one is soft
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

#include "core/physics/pad_contact.h"

namespace graspbench {

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

  ContactMaterial material;  ///< with a pad, PrepareContact sets kt and r to those of the patch
  double hertz = 0.0;        ///< pad_contact.h [N/m^1.5]; 0: bare
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

}  // namespace graspbench
