#include "core/hand/contact_fit.h"

#include <gtest/gtest.h>

#include "core/base/units.h"
#include "core/shape/primitives.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;

// Straight above a ball of 10 mm whose top is 1 mm below the point; beside it by 9 mm: the centres
// are 15 mm apart when they touch, 12 mm of it along the normal.
TEST(ContactFitTest, ASinkIsTheProbesWayToTheBall) {
  const Vector3d z = Vector3d::UnitZ(), c(0, 0, -0.011);
  EXPECT_NEAR(CalcSink(Vector3d::Zero(), z, c, 0.01), 0.001, 1e-15);
  EXPECT_NEAR(CalcSink({0.009, 0, 0}, z, c, 0.01), 0.016 - 0.012, 1e-15);
  EXPECT_EQ(CalcSink({0.016, 0, 0}, z, c, 0.01), 0.01);  // passes it
}

/** A cube of 40 mm and a ball in its middle. */
ContactFit MeasureBallInCube(double radius) {
  Hand hand;
  hand.links.emplace_back().name = "palm";
  hand.palm_link = 0;
  hand.palm_normal = Vector3d::UnitZ();
  hand.contact_spheres = {{0, Vector3d::Zero(), radius}};
  return MeasureContact(hand, MakeLinkSolids({{MakeRoundedBox({0.04, 0.04, 0.04}, 0.0)}})).at(0);
}

TEST(ContactFitTest, OfABallInACube) {
  const ContactFit large = MeasureBallInCube(0.023);  // 3 mm out over each face
  EXPECT_NEAR(large.out.most, 0.003, 0.0002);
  EXPECT_NEAR(large.palmar_out.most, 0.003, 0.0002);
  const ContactFit small = MeasureBallInCube(0.015);
  EXPECT_EQ(small.out.most, 0.0);
  EXPECT_EQ(small.sink.most, 0.01);  // at the corners the probe passes
  EXPECT_EQ(small.num_balls, 1);
}

// On each face a disc of pi (24^2 - 20^2) mm^2 of 40^2 lies within 5 mm of a ball of 19 mm.
TEST(ContactFitTest, SelfContactIsTheShareOfTheSurfaceNearACapsule) {
  Hand hand;
  hand.links.emplace_back().name = "palm";
  hand.palm_link = 0;
  hand.contact_spheres = {{0, Vector3d::Zero(), 0.019}};
  hand.capsules = {{0, Vector3d::Zero(), Vector3d::Zero(), 0.019}};
  const LinkSolids solids = MakeLinkSolids({{MakeRoundedBox({0.04, 0.04, 0.04}, 0.0)}});
  const ContactFit fit = MeasureContact(hand, solids, 20000).at(0);
  EXPECT_EQ(fit.num_capsules, 1);
  EXPECT_NEAR(fit.self_contact, kPi * 176.0 / 1600.0, 0.006);
  EXPECT_EQ(DescribeSelfContact(fit),
            "its 1 capsule for contact with the hand itself is within 5 mm of 35 % of its surface; "
            "other links enter the rest");
}

// Of the two faces that touch nothing sinks in where the neighbour's ball is.
TEST(ContactFitTest, WhatANeighbourHoldsDoesNotCount) {
  Hand hand;
  for (const char* name : {"palm", "finger"}) hand.links.emplace_back().name = name;
  hand.links[1].parent = 0;
  hand.palm_link = 0;
  hand.contact_spheres = {{0, Vector3d::Zero(), 0.0005}, {1, Vector3d::Zero(), 0.05}};
  const auto fits =
      MeasureContact(hand, MakeLinkSolids({{MakeRoundedBox({0.04, 0.04, 0.04}, 0.0)}, {}}));
  ASSERT_EQ(fits.size(), 1u);
  EXPECT_EQ(fits[0].sink.most, 0.0);
}

}  // namespace
}  // namespace graspbench
