#include "core/hand/import/mjcf/mjcf_geoms.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/hand/import/mjcf/read_foreign_mjcf.h"
#include "tests/core/hand/import/small_claw.h"

namespace graspbench {
namespace {

/** What weighs of the claw's ff_middle, a capsule without <inertial>, in a changed model. */
std::vector<ForeignShape> ListWeights(const std::string& old_text, const std::string& new_text,
                                      const std::string& link_name = "ff_middle") {
  Diagnostics problems;
  const ForeignHand hand = ReadForeignMjcf(ReplaceOnce(kSmallClaw, old_text, new_text), "claw.xml",
                                           "no-such-folder", problems);
  for (const ForeignLink& link : hand.links) {
    if (link.name == link_name) return link.weights;
  }
  ADD_FAILURE() << problems.Format();
  return {};
}

TEST(MjcfGeomsTest, AGeomWeighsByItsMassElseItsDensity) {
  const std::string geom = "<geom name=\"ff_middle\"";
  std::vector<ForeignShape> weights = ListWeights(geom, geom);
  ASSERT_EQ(weights.size(), 1u);
  EXPECT_EQ(weights[0].weight->density, 1000.0);  // MuJoCo's default
  EXPECT_FALSE(weights[0].weight->mass);
  weights = ListWeights(geom, geom + " mass=\"0.02\"");
  EXPECT_EQ(weights[0].weight->mass, 0.02);
  // Of a class, as all else; seen or touched or not.
  weights = ListWeights("<geom type=\"capsule\" size=\"0.008\"/>",
                        "<geom type=\"capsule\" size=\"0.008\" density=\"7800\" contype=\"0\" "
                        "conaffinity=\"0\"/>");
  ASSERT_EQ(weights.size(), 1u);
  EXPECT_EQ(weights[0].weight->density, 7800.0);
  EXPECT_TRUE(ListWeights(geom, geom + " mass=\"0\"").empty());
  EXPECT_TRUE(ListWeights(geom, geom + " density=\"0\"").empty());
}

TEST(MjcfGeomsTest, TheCompilerSaysWhichGeomsWeigh) {
  const auto with = [](const std::string& setting, const std::string& link) {
    return ListWeights("<compiler ", "<compiler " + setting + " ", link).size();
  };
  EXPECT_EQ(with("inertiafromgeom=\"auto\"", "ff_middle"), 1u);
  EXPECT_EQ(with("inertiafromgeom=\"auto\"", "palm"), 0u);  // has an <inertial>
  EXPECT_EQ(with("inertiafromgeom=\"true\"", "palm"), 1u);
  EXPECT_EQ(with("inertiafromgeom=\"false\"", "ff_middle"), 0u);
  EXPECT_EQ(with("inertiagrouprange=\"0 2\"", "ff_middle"), 0u);  // all are of group 3
  EXPECT_EQ(with("inertiagrouprange=\"3 3\"", "ff_middle"), 1u);
}

}  // namespace
}  // namespace graspbench
