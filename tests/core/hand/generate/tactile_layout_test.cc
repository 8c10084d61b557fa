#include "core/hand/generate/tactile_layout.h"

#include <gtest/gtest.h>

#include "core/base/files/files.h"
#include "core/hand/load_hand.h"

namespace graspbench {
namespace {

TEST(TactileLayoutTest, TheFilesAreWhatTheGeneratorMakes) {
  for (const char* id : {"shadow", "shadow-evolved", "tum", "tum-courses", "tum-evolved"}) {
    const Hand hand = LoadHand(id);
    EXPECT_EQ(ReadFile(hand.folder + "/tactile.yaml"), MakeTactileYaml(hand)) << id;
  }
}

// Two elements on a long strip share it: a quarter of its length from either end.
TEST(TactileLayoutTest, TwoElementsShareAStrip) {
  std::vector<SurfacePoint> points;
  for (int i = 0; i < 400; ++i) {
    SurfacePoint point;
    point.p_L = Eigen::Vector3d(1e-4 * (i + 0.5), 0.0, 0.0);
    point.area = 1e-8;
    points.push_back(point);
  }
  const std::vector<TactileElement> elements = PlaceElements({0}, points, 2);
  ASSERT_EQ(elements.size(), 2u);
  const double first = elements[0].p_LE.x(), second = elements[1].p_LE.x();
  EXPECT_NEAR(std::min(first, second), 0.01, 2e-4);
  EXPECT_NEAR(std::max(first, second), 0.03, 2e-4);
  EXPECT_NEAR(elements[0].area, 2e-6, 4e-8);
}

}  // namespace
}  // namespace graspbench
