#include "reports/plots/hand_map.h"

#include <gtest/gtest.h>

#include "core/base/text/text.h"
#include "core/hand/load_hand.h"
#include "core/hand/tactile.h"

namespace graspbench {
namespace {

size_t Count(const std::string& text, const std::string& part) {
  size_t count = 0;
  for (size_t at = text.find(part); at != text.npos; at = text.find(part, at + 1)) ++count;
  return count;
}

// 186 discs; the strongest is full, an idle one empty, each with its number.
TEST(HandMapTest, EveryElementIsADiscShadedByItsForce) {
  const Hand hand = LoadHand("shadow");
  std::vector<double> force(hand.skin->elements.size(), 0.0);
  force[0] = 4.0;
  force[1] = 1.0;
  const std::string map = DrawHandMap(hand, force, {"Map", "Forces."}).markup();
  EXPECT_EQ(Count(map, "<ellipse "), 186u);
  EXPECT_EQ(Count(map, "fill-opacity=\"1.00\""), 1u);
  EXPECT_EQ(Count(map, "fill-opacity=\"0.25\""), 1u);
  EXPECT_EQ(Count(map, "fill-opacity=\"0.00\""), 184u);
  EXPECT_EQ(Count(map, "ffdistal: 4.00 N"), 1u);
  EXPECT_EQ(Count(map, "<title>Map</title>"), 1u);
}

}  // namespace
}  // namespace graspbench
