#include <gtest/gtest.h>

#include "core/hand/import/guess_hand.h"

namespace graspbench {
namespace {

/** Digits of two links each, named; 30 mm apart along x, the first is the thumb. */
Hand MakeHand(const std::vector<std::pair<std::string, std::string>>& names) {
  Hand hand;
  hand.links.resize(1);
  for (const auto& [proximal, distal] : names) {
    Digit& digit = hand.digits.emplace_back();
    for (const std::string& name : {proximal, distal}) {
      HandJoint& joint = hand.joints.emplace_back();
      joint.name = "j_" + std::to_string(hand.links.size());
      joint.link = static_cast<int>(hand.links.size());
      HandLink& link = hand.links.emplace_back();
      link.name = name;
      link.joint = hand.num_joints() - 1;
      link.parent = digit.links.empty() ? 0 : digit.links.back();
      if (digit.links.empty()) {
        link.X_PJ = MakePose(Eigen::Vector3d(0.03 * static_cast<double>(hand.digits.size()), 0, 0));
      }
      digit.links.push_back(joint.link);
    }
    digit.distal_link = digit.links.back();
  }
  return hand;
}

std::string ListIds(const Hand& hand) {
  std::string ids;
  for (const Digit& digit : hand.digits) ids += (digit.id.empty() ? "-" : digit.id) + " ";
  return ids;
}

TEST(DigitNamesTest, MostNamesDecide) {
  Hand hand = MakeHand({{"Thumb_base", "thumb_tip"},
                        {"index_proximal", "index_middle"},  // a phalanx is no finger
                        {"rh_mfproximal", "rh_mfdistal"},
                        {"spring", "string"},
                        {"pinky", "pinky_end"}});
  NameByVotes(hand);
  EXPECT_EQ(ListIds(hand), "TH FF MF - LF ");
  Hand twins = MakeHand({{"thumb_left", "a"}, {"thumb_right", "b"}});
  NameByVotes(twins);
  EXPECT_EQ(ListIds(twins), "- - ");
}

TEST(DigitNamesTest, TheOthersAreNamedFromTheThumbAndAllOrdered) {
  Hand hand = MakeHand({{"a", "a"}, {"b", "b"}, {"c", "c"}, {"d", "d"}, {"e", "e"}, {"f", "f"}});
  hand.digits[0].id = "TH";
  hand.digits[0].is_thumb = true;
  hand.digits[2].id = "FF";
  NameDigits(hand);
  EXPECT_EQ(ListIds(hand), "FF MF RF LF D1 TH ");
  EXPECT_EQ(hand.digits[0].name, "index");
  EXPECT_EQ(hand.links[hand.digits[1].distal_link].name, "b");
  EXPECT_EQ(hand.digits[4].name, "digit 1");
  EXPECT_EQ(hand.digits[5].name, "thumb");
}

}  // namespace
}  // namespace graspbench
