#pragma once
/** @file
A trial of known numbers: a hand of one thumb that turns and slides, a box it lifts. */

#include <cmath>
#include <memory>
#include <string>

#include "core/shape/primitives.h"
#include "reports/scenes/scene_3d.h"

namespace graspbench {

/** Keys every 0.1 s from 0 to 2 s: at time t the turning joint is at 0.5 t rad, the sliding one at
0.01 t m, the box at 0.1 t m above its rest, and from closure on the thumb presses with 2 t N. */
inline TrialView MakeTrialView() {
  Hand hand;
  hand.id = "box";
  hand.name = "Box Hand";
  hand.links.resize(3);
  hand.links[0].name = "palm";
  hand.links[1].name = "turning";
  hand.links[1].parent = 0;
  hand.links[1].joint = 0;
  hand.links[2].name = "sliding";
  hand.links[2].parent = 1;
  hand.links[2].joint = 1;
  hand.joints.resize(2);
  hand.joints[0].name = "turn";
  hand.joints[0].link = 1;
  hand.joints[1].name = "slide";
  hand.joints[1].link = 2;
  hand.joints[1].is_prismatic = true;
  Digit thumb;
  thumb.id = "TH";
  thumb.name = "thumb";
  thumb.is_thumb = true;
  thumb.links = {1, 2};
  thumb.distal_link = 2;
  hand.digits = {thumb};
  for (int link = 0; link < 3; ++link) {
    hand.visuals.push_back({link, MakeRoundedBox({0.05, 0.05, 0.1}, 0.005), {0.4f, 0.4f, 0.4f}});
  }
  GraspObject box;
  box.id = box.name = "box";
  box.mesh = MakeRoundedBox({0.06, 0.06, 0.1}, 0.005);
  TrialView view;
  view.hand = std::make_shared<const Hand>(hand);
  view.object = std::make_shared<const GraspObject>(box);
  view.anchor = "view";
  view.name = "Box Hand, box";
  view.traced.result.outcome = Outcome::kSuccess;
  view.traced.closure_start = 0.5;
  view.traced.result.phases = {{"closure", 0.0}, {"stabilisation", 0.5}, {"lift-off", 1.01}};
  for (int k = 0; k <= 20; ++k) {
    TraceInstant instant;
    instant.time = 0.1 * k;
    instant.phase = k <= 5    ? Phase::kPlacing
                    : k <= 10 ? Phase::kClosure
                    : k <= 15 ? Phase::kStabilisation
                              : Phase::kLiftOff;
    instant.q = Eigen::Vector2d(0.5 * instant.time, 0.01 * instant.time);
    instant.X_WH = MakePose(Eigen::Vector3d(0.0, 0.0, 0.2));
    instant.X_WO = MakePose(Eigen::Vector3d(0.1, 0.0, 0.05 + 0.1 * instant.time));
    if (k > 5) {
      HandContact contact;
      contact.link = 2;
      contact.p_WC = instant.X_WO.translation();
      contact.nhat_W = Eigen::Vector3d::UnitX();
      contact.normal_force = 2.0 * instant.time;
      contact.mu = 0.4;
      instant.contacts = {contact};
      instant.grip_force = contact.normal_force;
    }
    view.traced.trace.push_back(instant);
  }
  return view;
}

}  // namespace graspbench
