// Known answers of friction: the incline, the squeeze, the soft pad, the hold.

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

std::string FormatShort(double value) { return FormatSignificant(value, 6); }

/** Stiff bristles keep the block's elastic sway below the 1 % by which it must slide. */
constexpr double kInclineStiffness = 4e4;

struct Incline {
  double mu, step;
};
constexpr Incline kInclines[] = {{0.1, 0.001}, {0.3, 0.0005}, {0.3, 0.002},  {0.5, 0.001},
                                 {0.5, 0.004}, {0.8, 0.002},  {1.1, 0.0005}, {1.1, 0.004}};

std::string FormatIncline(const Incline& incline) {
  return "mu " + FormatShort(incline.mu) + ", step " + FormatShort(MsFromS(incline.step)) + " ms";
}

SimConfig MakeInclineConfig(const Incline& incline) {
  SimConfig config = MakeStepConfig(incline.step);
  config.tangential_stiffness = kInclineStiffness;
  config.table_friction_static = config.table_friction_dynamic = incline.mu;
  return config;
}

/** Places the block on the table and tilts the table slowly to `angle`. */
void TiltTable(double angle, const Incline& incline, SmallWorld& body) {
  body.start().p_WOcm = Vector3d(0.0, 0.0, 0.01);
  body.Reset();
  const auto num_steps = std::lround(0.4 / incline.step);
  for (long i = 1; i <= num_steps; ++i) {
    const double now = angle * static_cast<double>(i) / static_cast<double>(num_steps);
    body.world().SetGravity(kStandardGravity * Vector3d(std::sin(now), 0.0, -std::cos(now)));
    body.Step();
  }
}

}  // namespace

std::vector<KnownAnswer> CheckInclineSticks() {
  std::vector<KnownAnswer> answers;
  const GraspObject block = MakeBlock(0.5);
  for (const Incline& incline : kInclines) {
    SmallWorld body(block, MakeInclineConfig(incline));
    TiltTable(std::atan(0.99 * incline.mu), incline, body);
    body.Run(0.2);
    const Vector3d early = body.state().p_WOcm;
    body.Run(0.5);
    answers.push_back({FormatIncline(incline) + ", motion in 0.5 s", "m", 0.0,
                       (body.state().p_WOcm - early).norm(), 1e-9});
  }
  return answers;
}

std::vector<KnownAnswer> CheckInclineSlides() {
  std::vector<KnownAnswer> answers;
  const GraspObject block = MakeBlock(0.5);
  for (const Incline& incline : kInclines) {
    for (double ratio : {1.01, 1.1}) {
      const double angle = std::atan(ratio * incline.mu);
      SmallWorld body(block, MakeInclineConfig(incline));
      TiltTable(angle, incline, body);
      body.Run(0.3);
      const double early = body.state().v_WOcm.x();
      body.Run(0.2);
      const double expected = kStandardGravity * (std::sin(angle) - incline.mu * std::cos(angle));
      answers.push_back({FormatIncline(incline) + ", at " + FormatShort(ratio), "m/s^2", expected,
                         (body.state().v_WOcm.x() - early) / 0.2, 2e-3 * expected});
    }
  }
  return answers;
}

std::vector<KnownAnswer> CheckSqueezeThreshold() {
  std::vector<KnownAnswer> answers;
  struct Case {
    int num_fingers;
    double mass, step;
  };
  for (const Case& c : {Case{2, 0.1, 0.002}, Case{2, 0.3, 0.0005}, Case{2, 0.3, 0.004},
                        Case{3, 0.1, 0.002}, Case{3, 0.5, 0.002}, Case{5, 0.5, 0.002}}) {
    const GraspObject prism = MakeSolid(MakePrism(2 * c.num_fingers, 0.03, 0.06), c.mass, 0.5, 0.5);
    Squeeze squeeze;
    squeeze.num_fingers = c.num_fingers;
    squeeze.mass = c.mass;
    squeeze.step = c.step;
    const double expected = c.mass * kStandardGravity / (c.num_fingers * squeeze.force);
    const double obtained = FindThreshold(0.8 * expected, 1.2 * expected, [&](double mu) {
      squeeze.mu = mu;
      SqueezeScene scene(squeeze, prism, 0.03);
      scene.world().Run(0.5);
      return scene.CalcFall() < 0.001;
    });
    answers.push_back({std::to_string(c.num_fingers) + " fingers of 5 N, " +
                           FormatShort(GFromKg(c.mass)) + " g, step " +
                           FormatShort(MsFromS(c.step)) + " ms: friction",
                       "", expected, obtained, 0.02 * expected});
  }
  return answers;
}

std::vector<KnownAnswer> CheckPadTorsion() {
  std::vector<KnownAnswer> answers;
  const GraspObject bar = MakeSolid(MakeRoundedBox(Vector3d(0.02, 0.2, 0.02), 0.0), 0.1, 0.5, 0.5);
  struct Case {
    double radius, share;  // share of the tangential force in its limit
  };
  for (const Case& c : {Case{0.002, 0.2}, Case{0.004, 0.2}, Case{0.006, 0.2}, Case{0.004, 0.5},
                        Case{0.004, 0.8}, Case{0.004, 0.98}}) {
    Squeeze squeeze;
    squeeze.torsion_radius = c.radius;
    squeeze.mass = c.share * 2.0 * squeeze.mu * squeeze.force / kStandardGravity;
    const double spin_share = std::sqrt(1.0 - c.share * c.share);  // by the limit ellipsoid
    const double expected = c.radius * spin_share / c.share;
    // 2 % of it, plus the effect of 0.1 % of the limit where the ellipsoid is steep.
    const double tolerance = 0.02 * expected + 0.001 * c.radius * c.share / spin_share;
    const double obtained = FindThreshold(0.8 * expected, 1.2 * expected, [&](double off_centre) {
      squeeze.off_centre = off_centre;
      SqueezeScene scene(squeeze, bar, 0.01);
      scene.world().Run(1.0);
      return scene.CalcTilt() < 0.05 && scene.CalcFall() < 0.001;
    });
    answers.push_back({"pad radius " + FormatShort(MmFromM(c.radius)) + " mm, tangential share " +
                           FormatShort(c.share) + ": off-centre by",
                       "m", expected, obtained, tolerance});
  }
  return answers;
}

std::vector<KnownAnswer> CheckSqueezeCreep() {
  std::vector<KnownAnswer> answers;
  const auto add = [&](const std::string& what, const Squeeze& squeeze, const GraspObject& object,
                       double half_width) {
    SqueezeScene scene(squeeze, object, half_width);
    scene.world().Run(0.5);
    const WorldState early = scene.world().state();
    scene.world().Run(60.0);
    const double motion = (scene.world().state().p_WOcm - early.p_WOcm).norm();
    const double turn =
        Eigen::AngleAxisd(early.R_WO.transpose() * scene.world().state().R_WO).angle();
    answers.push_back({what + ", creep", "m", 0.0, motion, 1e-6});
    answers.push_back({what + ", turn", "rad", 0.0, turn, 1e-5});
  };
  for (double mass : {0.005, 0.1, 0.48}) {
    Squeeze squeeze;
    squeeze.mass = mass;
    add("box, " + FormatShort(GFromKg(mass)) + " g, 2 fingers of 5 N", squeeze,
        MakeSolid(MakePrism(4, 0.03, 0.06), mass, 0.5, 0.5), 0.03);
  }
  Squeeze squeeze;
  squeeze.num_fingers = 3;
  squeeze.mass = 0.06;
  add("ball, 60 g, 3 fingers of 5 N", squeeze, MakeSolid(MakeSphere(0.03), 0.06, 0.5, 0.5), 0.03);
  squeeze = Squeeze();
  squeeze.torsion_radius = 0.004;
  squeeze.off_centre = 0.015;
  add("bar, 100 g, 15 mm off-centre, 2 pads of 5 N", squeeze,
      MakeSolid(MakeRoundedBox(Vector3d(0.02, 0.2, 0.02), 0.0), 0.1, 0.5, 0.5), 0.01);
  return answers;
}

}  // namespace graspbench
