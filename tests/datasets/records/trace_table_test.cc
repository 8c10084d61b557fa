#include "datasets/records/trace_table.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <map>

#include "core/hand/load_hand.h"

namespace graspbench {
namespace {

std::map<std::string, Json> MakeRow(const Hand& hand, const TraceInstant& instant) {
  std::map<std::string, Json> row;
  for (const auto& column : ListTraceColumns(hand)) {
    EXPECT_TRUE(row.emplace(column.name, column.value(instant)).second) << column.name << " twice";
    EXPECT_FALSE(column.meaning.empty());
  }
  return row;
}

TEST(TraceTable, HoldsEveryJointAndTheContactsByDigit) {
  const Hand hand = LoadHand("tum");
  TraceInstant instant;
  instant.time = 0.25;
  instant.phase = Phase::kPlacing;  // it ends where closure begins
  instant.next_phase = Phase::kClosure;
  instant.q = Eigen::VectorXd::LinSpaced(hand.num_joints(), 0.1, 0.9);
  instant.X_WO = MakePose(Eigen::AngleAxisd(kPi / 2, Eigen::Vector3d::UnitZ()).toRotationMatrix(),
                          Eigen::Vector3d(1.0, 2.0, 3.0));
  HandContact contact;
  contact.link = hand.digits[0].distal_link;
  contact.normal_force = 2.0;
  contact.friction_W = Eigen::Vector3d(0.0, 0.3, 0.4);
  contact.mu = 0.5;
  contact.slip_speed = 0.01;
  instant.contacts = {contact, contact};
  instant.contacts[1].friction_W.setZero();
  const auto row = MakeRow(hand, instant);
  const std::string digit = hand.digits[0].id, other = hand.digits[1].id;
  EXPECT_EQ(row.at("time_s"), 0.25);
  EXPECT_EQ(row.at("phase"), "closure");
  EXPECT_EQ(row.at("object_y_m"), 2.0);
  EXPECT_NEAR(row.at("object_qz").get<double>(), std::sqrt(0.5), 1e-15);
  EXPECT_NEAR(row.at("object_qw").get<double>(), std::sqrt(0.5), 1e-15);
  EXPECT_EQ(row.at("normal_" + digit + "_n"), 4.0);
  EXPECT_DOUBLE_EQ(row.at("cone_" + digit).get<double>(), 0.5);  // the worse of the two
  EXPECT_EQ(row.at("slip_" + digit + "_m_per_s"), 0.01);
  EXPECT_EQ(row.at("normal_" + other + "_n"), 0.0);
  EXPECT_TRUE(row.at("cone_" + other).is_null());
  EXPECT_EQ(row.at("normal_palm_n"), 0.0);
  for (int joint = 0; joint < hand.num_joints(); ++joint) {
    const std::string& name = hand.joints[static_cast<size_t>(joint)].name;
    EXPECT_EQ(row.at(name + "_rad"), instant.q[joint]);
    const bool has_drive = hand.joints[static_cast<size_t>(joint)].coupled_to < 0;
    EXPECT_EQ(row.count(name + "_asked_rad"), has_drive ? 1u : 0u);
  }
}

}  // namespace
}  // namespace graspbench
