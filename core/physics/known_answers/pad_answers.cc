// Known answers of soft pads: Hertz's force and patch, Mindlin's sag, torsion, the hold.

#include <algorithm>
#include <cmath>

#include "core/base/text/text.h"
#include "core/base/units.h"
#include "core/physics/known_answers/known_answer.h"
#include "core/physics/known_answers/small_scenes.h"
#include "core/shape/primitives.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;

constexpr double kBall = 0.008;       // finger radius of the squeeze [m]
constexpr double kHalfWidth = 0.01;   // of the bar [m]
constexpr double kReduced = 4.0 / 3;  // E* over E at a Poisson's ratio of 1/2

/** Repeated here, because the formulas of the engine are under test. */
///@{
double CalcDepth(double modulus, double force, double stiffness) {
  const double hertz = 4.0 / 3.0 * kReduced * modulus * std::sqrt(kBall);
  return std::pow(force / hertz, 2.0 / 3.0) + force / stiffness;
}
double CalcRadius(double modulus, double force) {
  return std::cbrt(3.0 * force * kBall / (4.0 * kReduced * modulus));
}
///@}

Squeeze MakeSqueeze(double modulus, double force) {
  Squeeze squeeze;
  squeeze.force = force;
  squeeze.pad = {modulus, 0.003};
  return squeeze;
}

GraspObject MakeBar() {
  return MakeSolid(MakeRoundedBox(Vector3d(2.0 * kHalfWidth, 0.2, 0.02), 0.0), 0.1, 0.5, 0.5);
}

GraspObject MakeCube() {
  return MakeSolid(MakePrism(4, kHalfWidth, 2.0 * kHalfWidth), 0.1, 0.5, 0.5);
}

std::string FormatPad(double modulus, double force) {
  return FormatSignificant(1e-6 * modulus, 3) + " MPa, " + FormatSignificant(force, 3) + " N: ";
}

}  // namespace

std::vector<KnownAnswer> CheckPadForce() {
  std::vector<KnownAnswer> answers;
  for (const double modulus : {0.3e6, 1.1e6, 4e6}) {
    for (const double force : {0.5, 2.0, 5.0}) {
      for (const double step : {0.002, 0.0005}) {
        Squeeze squeeze = MakeSqueeze(modulus, force);
        squeeze.step = step;
        squeeze.mass = 0.01;
        SqueezeScene scene(squeeze, MakeBar(), kHalfWidth);
        scene.world().Run(0.5);
        std::vector<HandContact> contacts;
        scene.world().world().FindHandContacts(contacts);
        // The contact point lies at half the depth; the mean of two contacts is taken.
        double depth = 0.0, total = 0.0, radius = 0.0;
        for (const HandContact& contact : contacts) {
          total += contact.normal_force;
          depth += kHalfWidth - std::abs(contact.p_WC.x());
          radius += 0.5 * contact.torsion_radius / (3.0 * kPi / 16.0);
        }
        const std::string what =
            FormatPad(modulus, force) + "step " + FormatSignificant(MsFromS(step), 3) + " ms, ";
        const double stiffness = SimConfig().contact_stiffness;
        const double expected = CalcDepth(modulus, 0.5 * total, stiffness);
        const double patch = CalcRadius(modulus, 0.5 * total);
        // As the drive yields, a finger rotates and its lever arm changes a little.
        answers.push_back({what + "forces", "N", 2.0 * force, total, 0.005 * force});
        answers.push_back({what + "depth", "m", expected, depth, 0.001 * expected});
        answers.push_back({what + "patch", "m", patch, radius, 0.001 * patch});
      }
    }
  }
  return answers;
}

std::vector<KnownAnswer> CheckPadSag() {
  std::vector<KnownAnswer> answers;
  for (const double modulus : {0.3e6, 1.1e6}) {
    const double force = 5.0;
    // The difference of two weights excludes the lift from yielding fingers.
    constexpr double kLight = 0.05, kHeavy = 0.1;
    double sag = 0.0;
    for (const double mass : {kLight, kHeavy}) {
      Squeeze squeeze = MakeSqueeze(modulus, force);
      squeeze.mass = mass;
      SqueezeScene scene(squeeze, MakeBar(), kHalfWidth);
      scene.world().Run(1.0);
      sag += mass == kHeavy ? scene.CalcFall() : -scene.CalcFall();
    }
    const double along = 4.0 / 3.0 * kReduced * modulus * CalcRadius(modulus, force);
    const double bare = SimConfig().tangential_stiffness;
    const double expected = (kHeavy - kLight) * kStandardGravity / 2.0 * (1.0 / along + 1.0 / bare);
    answers.push_back(
        {FormatPad(modulus, force) + "50 g more sag by", "m", expected, sag, 0.01 * expected});
  }
  return answers;
}

std::vector<KnownAnswer> CheckPatchTorsion() {
  std::vector<KnownAnswer> answers;
  for (const double modulus : {0.3e6, 1.1e6}) {
    for (const double force : {2.0, 5.0}) {
      Squeeze squeeze = MakeSqueeze(modulus, force);
      squeeze.mass = 0.005;
      const double expected =
          2.0 * 3.0 * kPi / 16.0 * squeeze.mu * force * CalcRadius(modulus, force);
      const double obtained = FindThreshold(0.8 * expected, 1.2 * expected, [&](double moment) {
        SqueezeScene scene(squeeze, MakeCube(), kHalfWidth);
        constexpr int kRamp = 250;
        for (int i = 1; i <= kRamp; ++i) {
          scene.world().world().SetExternalLoad(Vector3d::Zero(),
                                                moment * i / kRamp * Vector3d::UnitX());
          scene.world().Step();
        }
        // The patch itself twists by some 0.3 rad before it slips.
        double tilt = 0.0;
        for (int i = 0; i < kRamp; ++i) {
          scene.world().Step();
          tilt = std::max(tilt, scene.CalcTilt());
        }
        return tilt < 0.6;
      });
      answers.push_back(
          {FormatPad(modulus, force) + "two turn at", "N m", expected, obtained, 0.02 * expected});
    }
  }
  return answers;
}

std::vector<KnownAnswer> CheckPadCreep() {
  std::vector<KnownAnswer> answers;
  for (const double modulus : {0.3e6, 1.1e6}) {
    Squeeze squeeze = MakeSqueeze(modulus, 5.0);
    squeeze.off_centre = 0.001;
    SqueezeScene scene(squeeze, MakeCube(), kHalfWidth);
    scene.world().Run(1.0);
    const WorldState early = scene.world().state();
    scene.world().Run(60.0);
    const WorldState& late = scene.world().state();
    const std::string what = FormatPad(modulus, 5.0) + "60 s, ";
    answers.push_back({what + "creep", "m", 0.0, (late.p_WOcm - early.p_WOcm).norm(), 1e-6});
    answers.push_back({what + "turn", "rad", 0.0,
                       Eigen::AngleAxisd(early.R_WO.transpose() * late.R_WO).angle(), 1e-5});
    answers.push_back({what + "steps that did not converge", "", 0.0,
                       static_cast<double>(scene.world().num_unconverged()), 0.0});
  }
  return answers;
}

}  // namespace graspbench
