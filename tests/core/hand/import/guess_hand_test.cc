#include "core/hand/import/guess_hand.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include "core/base/files/files.h"
#include "core/hand/load_hand.h"
#include "tests/core/hand/import/small_gripper.h"

namespace graspbench {
namespace {

/** A hand of the project, as its bare URDF would be imported. */
Hand ImportModel(const std::string& id, Diagnostics& problems) {
  const std::filesystem::path folder = FindDataRoot() / "core/hand/models" / id;
  HandSource source = MakeSourceWithoutMeshes();
  source.file = "hand.urdf";
  source.folder = folder;
  const ImportedFiles imported = ImportHand(ReadFile(folder / "hand.urdf"), source, "", problems);
  if (imported.files.empty()) return {};
  const std::filesystem::path out = std::filesystem::path(testing::TempDir()) /
                                    ("guess_" + id + "_" + std::to_string(::getpid()));
  MakeFolder(out);
  for (const char* name : {"hand.urdf", "hand.yaml"}) {
    WriteFile(out / name, imported.files.at(name));
  }
  return LoadHand(out.string());
}

class KnownHandTest : public testing::TestWithParam<const char*> {};

// hand.yaml of these hands was written by people who knew the hand: the truth for the guesses.
TEST_P(KnownHandTest, IsGuessedAsItsMakersDescribeIt) {
  const Hand known = LoadHand(GetParam());
  Diagnostics problems;
  const Hand guessed = ImportModel(GetParam(), problems);
  ASSERT_EQ(problems.num_errors(), 0) << problems.Format();
  EXPECT_EQ(guessed.links[guessed.palm_link].name, known.links[known.palm_link].name);
  EXPECT_GT(guessed.palm_normal.dot(known.palm_normal), 0.95) << guessed.palm_normal.transpose();
  ASSERT_EQ(guessed.digits.size(), known.digits.size());
  for (size_t d = 0; d < known.digits.size(); ++d) {
    const Digit &a = guessed.digits[d], &b = known.digits[d];
    EXPECT_EQ(a.id, b.id);
    EXPECT_EQ(a.is_thumb, b.is_thumb) << a.id;
    EXPECT_EQ(a.links.size(), b.links.size()) << a.id;
    EXPECT_EQ(guessed.links[a.distal_link].name, known.links[b.distal_link].name);
    // The shapes of the Shadow Hand's thumb end 6.5 mm before the tip of its maker's figures.
    EXPECT_LT((a.p_LTip - b.p_LTip).norm(), 0.008) << a.id << " " << a.p_LTip.transpose();
    EXPECT_LT((a.p_LPad - b.p_LPad).norm(), 0.008) << a.id << " " << a.p_LPad.transpose();
  }
}
INSTANTIATE_TEST_SUITE_P(Models, KnownHandTest, testing::Values("tum", "tum-original", "shadow"));

// As the Robotiq 2F-85 is published: one drive; five joints follow it, two of them only to carry the
// pads' links. Outer link, then the finger that stays upright; an inner link beside each.
TEST(GuessHandTest, ALinkageBesideAFingerIsNoDigit) {
  const auto link = [](const std::string& name, const std::string& place, const std::string& size) {
    return "<link name=\"" + name + "\"><collision><origin xyz=\"" + place +
           "\"/><geometry><box size=\"" + size + "\"/></geometry></collision></link>";
  };
  const auto joint = [](const std::string& name, const std::string& parent,
                        const std::string& place, const std::string& rest) {
    return "<joint name=\"" + name + "_joint\" type=\"revolute\"><parent link=\"" + parent +
           "\"/><child link=\"" + name + "\"/><origin xyz=\"" + place +
           "\"/><axis xyz=\"1 0 0\"/>" + rest + "</joint>";
  };
  const std::string limit = "<limit lower=\"-0.8\" upper=\"0.8\" effort=\"1000\"/>";
  const auto mimic = [&](int ratio) {
    return limit + "<mimic joint=\"left_outer_joint\" multiplier=\"" + std::to_string(ratio) +
           "\"/>";
  };
  std::string urdf = "<robot name=\"2F\">" + link("base", "0 0 0.03", "0.06 0.08 0.06");
  for (const auto& [side, y, sign] : {std::tuple{"left", "", 1}, {"right", "-", -1}}) {
    const std::string s = side, m = y;
    urdf += link(s + "_outer", "0 " + m + "0.02 0.03", "0.02 0.01 0.06");
    urdf += joint(
        s + "_outer", "base", "0 " + m + "0.03 0.06",
        sign > 0 ? std::string("<limit lower=\"0\" upper=\"0.8\" effort=\"1000\"/>") : mimic(-1));
    urdf += link(s + "_finger", "0 0 0.02", "0.02 0.01 0.05");
    urdf += joint(s + "_finger", s + "_outer", "0 " + m + "0.03 0.06", mimic(-sign));
    urdf += link(s + "_inner", "0 0 0.015", "0.01 0.01 0.03");
    urdf += joint(s + "_inner", "base", "0 " + m + "0.012 0.06", mimic(sign));
  }
  Diagnostics problems;
  const ImportedFiles imported =
      ImportHand(urdf + "</robot>", MakeSourceWithoutMeshes(), "", problems);
  ASSERT_EQ(problems.num_errors(), 0) << problems.Format();
  EXPECT_EQ(imported.num_digits, 2);
  EXPECT_EQ(imported.num_driven, 1);
  Diagnostics of_loading;
  const Hand hand =
      ParseHand(imported.files.at("hand.urdf"), imported.files.at("hand.yaml"), "x", of_loading);
  ASSERT_EQ(of_loading.Format(), "");
  EXPECT_EQ(hand.palm_normal, Eigen::Vector3d::UnitZ());
  // The pads face each other across the opening.
  for (const Digit& digit : hand.digits) {
    const bool is_left = hand.links[digit.distal_link].name == "left_finger";
    EXPECT_NEAR(digit.p_LPad.y(), is_left ? -0.005 : 0.005, 0.0005);
  }
}

// As the 2F-85 is published for MuJoCo: cranks have the drive, loops tie the links with the pads.
// Every pair of digits is compared: 500 of them would take a minute.
TEST(GuessHandTest, AStarOfManyDigitsIsRefusedWithTheirCount) {
  const std::string body =
      "<inertial><mass value=\"0.01\"/><inertia ixx=\"1e-6\" iyy=\"1e-6\" izz=\"1e-6\" ixy=\"0\" "
      "ixz=\"0\" iyz=\"0\"/></inertial><collision><geometry><sphere radius=\"0.01\"/></geometry>"
      "</collision></link>";
  std::string text = "<robot name=\"star\"><link name=\"hub\">" + body;
  for (int i = 1; i <= 21; ++i) {
    const std::string number = std::to_string(i);
    text += "<link name=\"l" + number + "\">" + body + "<joint name=\"j" + number +
            "\" type=\"revolute\"><parent link=\"hub\"/><child link=\"l" + number +
            "\"/><origin xyz=\"" + std::to_string(0.01 * i) +
            " 0 0.02\"/><limit lower=\"0\" upper=\"1\" effort=\"1\" velocity=\"1\"/></joint>";
  }
  Diagnostics problems;
  ImportHand(text + "</robot>", MakeSourceWithoutMeshes(), "", problems);
  ASSERT_EQ(problems.num_errors(), 1) << problems.Format();
  EXPECT_NE(problems.Format().find("link \"hub\" carries 21 digits; expected a hand, which has at "
                                   "most 20"),
            std::string::npos)
      << problems.Format();
}

TEST(GuessHandTest, ACrankLeavesItsDriveToTheDigits) {
  std::string model =
      "<mujoco model=\"2F\"><compiler angle=\"radian\"/><default><joint axis=\"1 0 0\"/>"
      "<geom type=\"box\"/></default><worldbody><body name=\"base\">"
      "<geom size=\"0.03 0.04 0.03\" pos=\"0 0 0.03\"/>";
  std::string ends;
  for (const auto& [side, y, turn] :
       {std::tuple{"left", "-", "0 0 0 1"}, {"right", "", "1 0 0 0"}}) {
    const std::string s = side, start = "\" pos=\"0 " + std::string(y);
    const std::string quat = "\" quat=\"" + std::string(turn) + "\">";
    model += "<body name=\"" + s + "_crank" + start + "0.03 0.06" + quat + "<joint name=\"" + s +
             "_crank\" range=\"0 0.8\"/><geom size=\"0.01 0.005 0.015\" pos=\"0 0 0.02\"/>"
             "<body name=\"" +
             s + "_coupler\" pos=\"0 0 0.04\"><joint name=\"" + s +
             "_coupler\" range=\"-1.5 0\"/></body></body>";
    model += "<body name=\"" + s + "_link" + start + "0.015 0.06" + quat + "<joint name=\"" + s +
             "_link\" range=\"-0.3 0.8\" stiffness=\"0.05\" springref=\"2.6\"/>"
             "<geom size=\"0.01 0.005 0.02\" pos=\"0 0 0.02\"/><body name=\"" +
             s + "_pad\" pos=\"0 0 0.04\"><joint name=\"" + s +
             "_pad\" range=\"-1 1\"/>"
             "<geom size=\"0.01 0.004 0.03\" pos=\"0 0 0.03\"/></body></body>";
    ends +=
        "<connect body1=\"" + s + "_pad\" body2=\"" + s + "_coupler\" anchor=\"0 0.025 0.01\"/>";
  }
  model += "</body></worldbody><equality>" + ends +
           "<joint joint1=\"right_crank\" joint2=\"left_crank\"/></equality><actuator>"
           "<position joint=\"left_crank\" kp=\"5\" forcerange=\"-2 2\"/></actuator></mujoco>";
  Diagnostics problems;
  const ImportedFiles imported = ImportHand(model, MakeSourceWithoutMeshes(), "", problems);
  ASSERT_EQ(problems.num_errors(), 0) << problems.Format();
  EXPECT_EQ(imported.num_digits, 2) << problems.Format();
  EXPECT_EQ(imported.num_driven, 1) << problems.Format();
  Diagnostics of_loading;
  const Hand hand =
      ParseHand(imported.files.at("hand.urdf"), imported.files.at("hand.yaml"), "x", of_loading);
  ASSERT_EQ(of_loading.Format(), "");
  for (const Digit& digit : hand.digits) EXPECT_EQ(digit.links.size(), 2u);
}

}  // namespace
}  // namespace graspbench
