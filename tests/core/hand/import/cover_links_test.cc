#include "core/hand/import/cover_links.h"

#include <gtest/gtest.h>

#include "core/shape/primitives.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;

/** A box for a palm and one, 20 x 27 x 54 mm, for the link of a digit. */
ImportedHand MakeImported() {
  ImportedHand imported;
  const Vector3d size(0.02, 0.027, 0.054);
  for (const int link : {0, 1}) {
    imported.hand.links.emplace_back().name = link == 0 ? "palm" : "finger";
    CollisionShape& box = imported.shapes.emplace_back();
    box.link = link;
    box.kind = CollisionShape::Kind::kBox;
    box.size = size;
    imported.solids.push_back({MakeRoundedBox(size, 0.0)});
    imported.notes.emplace_back();
  }
  Digit digit;
  digit.links = {1};
  digit.distal_link = 1;
  imported.hand.digits = {digit};
  return imported;
}

TEST(CoverLinksTest, LinksOfDigitsGetBallsThatOtherLinksDoNotMeet) {
  ImportedHand imported = MakeImported();
  Diagnostics problems;
  CoverLinks("hand.urdf", kNumCoverPoints, imported, problems);
  EXPECT_EQ(problems.Format(), "");
  ASSERT_GT(imported.shapes.size(), 12u);
  for (size_t k = 2; k < imported.shapes.size(); ++k) {
    EXPECT_TRUE(imported.shapes[k].is_cover);
    EXPECT_EQ(imported.shapes[k].link, 1);
  }
  EXPECT_NE(imported.notes[1].find("uncovered at 95 of 100 points"), std::string::npos);
}

// 400 x 300 x 20 mm, no pad, so that its balls lie far apart: 200 more do not cover it.
TEST(CoverLinksTest, WhatStaysUncoveredIsTold) {
  ImportedHand imported = MakeImported();
  imported.shapes[1].size = Vector3d(0.02, 0.3, 0.4);
  imported.hand.digits[0].distal_link = -1;
  imported.solids[1] = {MakeRoundedBox(imported.shapes[1].size, 0.0)};
  Diagnostics problems;
  CoverLinks("hand.urdf", kNumCoverPoints, imported, problems);
  EXPECT_NE(problems.Format().find("link \"finger\": "), std::string::npos);
  EXPECT_NE(problems.Format().find("what it grasps there sinks in"), std::string::npos);
}

}  // namespace
}  // namespace graspbench
