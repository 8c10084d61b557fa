#include "workbench/tables/grasp_tables.h"

#include <gtest/gtest.h>

#include <map>

#include "core/base/pose.h"
#include "core/base/units.h"
#include "core/grasp/placement.h"
#include "core/hand/hand.h"
#include "core/hand/load_hand.h"

namespace graspbench {
namespace {

class GraspTablesTest : public testing::TestWithParam<const char*> {
 protected:
  GraspTablesTest()
      : hand_(LoadHand(GetParam())),
        grasps_(LoadStandardGrasps(hand_)),
        numbers_(ListGraspNumbers(hand_, grasps_)) {}

  std::map<std::string, double> Find(const std::string& grasp, const std::string& part) const {
    std::map<std::string, double> found;
    for (const GraspNumber& number : numbers_) {
      if (number.grasp == grasp && number.part == part) found[number.name] = number.value;
    }
    return found;
  }

  Hand hand_;
  std::vector<Grasp> grasps_;
  std::vector<GraspNumber> numbers_;
};

TEST(GraspTables, TypesStandInSevenTaxonomies) {
  const std::string table = FormatGraspTypes();
  EXPECT_NE(table.find("Napier 1956"), std::string::npos);
  EXPECT_NE(table.find("side opposition"), std::string::npos);
  const Json json = MakeGraspTypesJson();
  ASSERT_EQ(json["grasp_types"].size(), 4u);
  EXPECT_TRUE(json["grasp_types"][3]["taxonomies"][1]["name"].is_null());
  EXPECT_EQ(json["grasp_types"][2]["taxonomies"][6]["name"], "palm opposition");
}

// From the numbers alone the pads stand on both sides of the block, at alpha from its long axis.
TEST_P(GraspTablesTest, TheNumbersAreTheGrasp) {
  for (const Grasp& grasp : grasps_) {
    auto at = Find(grasp.id, "placement"), pre = Find(grasp.id, "pre-grasp"),
         target = Find(grasp.id, "target");
    ASSERT_EQ(pre.size(), hand_.joints.size());
    Eigen::VectorXd q_pre(hand_.num_joints()), q_target(hand_.num_joints());
    for (int j = 0; j < hand_.num_joints(); ++j) {
      const HandJoint& joint = hand_.joints[static_cast<size_t>(j)];
      q_pre[j] = FromDisplayUnits(joint, pre[joint.name]);
      q_target[j] = FromDisplayUnits(joint, target[joint.name]);
    }
    EXPECT_LT((q_pre - grasp.q_pre).norm(), 1e-9);
    EXPECT_LT((q_target - grasp.q_target).norm(), 1e-9);
    const Eigen::Matrix3d R_WH =
        MakeRotationRpy(RadFromDeg(at["roll"]), RadFromDeg(at["pitch"]), RadFromDeg(at["yaw"]));
    const Eigen::Vector3d p_WH(MFromMm(at["x"]), MFromMm(at["y"]),
                               MFromMm(at["z"]) + 0.5 * kReferenceBlock);
    const Placement placement = CalcPlacement(
        hand_, grasp, Eigen::Vector3d::Constant(kReferenceBlock), Eigen::Vector3d::Zero());
    EXPECT_LT((R_WH - placement.X_WH.linear()).norm(), 1e-9);
    EXPECT_LT((p_WH - placement.X_WH.translation()).norm(), 1e-9);
    EXPECT_NEAR(at["distance"], 100.0, 1e-9);
    EXPECT_NEAR(at["alpha"], grasp.id == "g4" || grasp.id == "g5" ? 90.0 : 75.0, 1e-9);
    EXPECT_NEAR(std::hypot(at["approach x"], at["approach y"], at["approach z"]), 1.0, 1e-12);
    EXPECT_EQ(std::isnan(at["pads off a plane"]), grasp.digits.size() < 4);  // three are in one
    EXPECT_GE(at["courses off a point"], 0.0);
    EXPECT_LT(at["courses off a point"], 50.0);
  }
}

TEST_P(GraspTablesTest, ATableAndALineANumber) {
  const std::string csv = FormatGraspCsv(numbers_), table = FormatGraspNumbers(grasps_, numbers_);
  EXPECT_EQ(static_cast<size_t>(std::count(csv.begin(), csv.end(), '\n')), numbers_.size() + 1);
  EXPECT_EQ(csv.find("grasp,part,name,unit,value\ng1,placement,x,mm,"), 0u);
  for (const HandJoint& joint : hand_.joints) {
    EXPECT_NE(table.find(joint.name + " ["), std::string::npos);
  }
  EXPECT_NE(table.find("g1 pre-grasp  g1 target"), std::string::npos);
}

INSTANTIATE_TEST_SUITE_P(Hands, GraspTablesTest, testing::Values("tum", "shadow"));

TEST(GraspTables, AHandWithoutGraspsSaysSo) {
  EXPECT_EQ(FormatGraspNumbers({}, {}), "no standard grasps; graspbench hand develop finds them\n");
}

}  // namespace
}  // namespace graspbench
