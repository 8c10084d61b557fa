#include "core/hand/load_hand.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "core/base/units.h"
#include "core/hand/hand.h"
#include "tests/core/hand/text_cases.h"

namespace graspbench {
namespace {

const std::filesystem::path kGood = std::filesystem::path(TEST_DATA_DIR) / "two_joint_hand";

TEST(LoadHandTest, EveryHandOfTheProjectIsFreeOfProblems) {
  EXPECT_EQ(ListHands(), (std::vector<std::string>{"shadow", "shadow-evolved", "tum", "tum-courses",
                                                   "tum-evolved", "tum-original"}));
  for (const std::string& id : ListHands()) {
    Diagnostics problems;
    CheckHand(id, problems);
    EXPECT_EQ(problems.Format(), "") << id;
  }
}

TEST(LoadHandTest, ReadsAUsersHandFromItsFolder) {
  const Hand hand = LoadHand(kGood.string() + "/");
  EXPECT_EQ(hand.id, "two_joint_hand");
  EXPECT_EQ(hand.name, "Two-joint Hand");
  ASSERT_EQ(hand.links.size(), 4u);
  const HandLink& proximal = hand.links[hand.FindLink("proximal")];
  EXPECT_EQ(proximal.mass, 0.03);
  EXPECT_EQ(proximal.p_LLcm, Eigen::Vector3d(0, 0, 0.02));
  // Its inertia is given in a frame a quarter turn about y away.
  EXPECT_NEAR(
      (proximal.I_LLcm - Eigen::Vector3d(1e-6, 4e-6, 4e-6).asDiagonal().toDenseMatrix()).norm(),
      0.0, 1e-18);
  EXPECT_EQ(proximal.axis, Eigen::Vector3d::UnitY());
  EXPECT_EQ(hand.links[hand.FindLink("tip")].joint, -1);
  EXPECT_EQ(hand.links[hand.FindLink("tip")].mass, 0.0);
  ASSERT_EQ(hand.num_joints(), 2);
  EXPECT_EQ(hand.joints[0].name, "J2");
  EXPECT_EQ(hand.joints[0].lower, -0.2);
  EXPECT_EQ(hand.joints[0].upper, 1.5);
  EXPECT_EQ(hand.joints[0].drive.stiffness, 2.0);
  EXPECT_EQ(hand.joints[0].drive.damping, 0.1);
  EXPECT_EQ(hand.joints[1].coupled_to, 0);
  EXPECT_EQ(hand.coupling, CouplingRule::kFixed);
  EXPECT_EQ(hand.fixed_coupling_ratio, 0.5);
  EXPECT_EQ(hand.joint_accuracy, RadFromDeg(1.0));
  EXPECT_EQ(hand.palm_normal, Eigen::Vector3d::UnitZ());
  EXPECT_EQ(hand.FindDigitOfLink(hand.FindLink("distal")), 0);
  EXPECT_EQ(hand.FindDigitOfLink(hand.palm_link), -1);
  // The mesh is scaled; its grey is turned from sRGB to linear light.
  ASSERT_EQ(hand.visuals.size(), 1u);
  EXPECT_EQ(hand.visuals[0].mesh.vertices[2], Eigen::Vector3d(0, 0.2, 0));
  EXPECT_NEAR(hand.visuals[0].colour.x(), 0.2140, 1e-4);
}

// Bounds by hand: box 60 x 60 x 20 mm; cylinder of 7 mm and 50 mm, its middle 20 mm up, as a
// capsule; ball of 8 mm, 10 mm up.
TEST(LoadHandTest, AHandWithoutPicturesLooksLikeItsCollisionShapes) {
  std::string urdf = ReadFile(kGood / "hand.urdf");
  const size_t begin = urdf.find("    <visual>"), end = urdf.find("    <collision>");
  urdf.erase(begin, end - begin);
  urdf.insert(urdf.find("    <collision>"), R"(    <collision name="cover">
      <geometry><sphere radius="0.3"/></geometry>
    </collision>
)");
  Diagnostics problems;
  const Hand hand = ParseHand(urdf, ReadFile(kGood / "hand.yaml"), kGood, problems);
  ASSERT_EQ(problems.Format(), "");
  ASSERT_EQ(hand.visuals.size(), 3u) << "a cover fills in the others' surface";
  const Eigen::Vector3d low[] = {
      {-0.03, -0.03, -0.01}, {-0.007, -0.007, -0.005}, {-0.008, -0.008, 0.002}};
  const Eigen::Vector3d high[] = {{0.03, 0.03, 0.01}, {0.007, 0.007, 0.045}, {0.008, 0.008, 0.018}};
  const char* const links[] = {"palm", "proximal", "distal"};
  for (size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(hand.visuals[k].link, hand.FindLink(links[k]));
    Eigen::AlignedBox3d box;
    for (const Eigen::Vector3d& p : hand.visuals[k].mesh.vertices) box.extend(p);
    EXPECT_LT((box.min() - low[k]).norm(), 2e-4) << links[k];
    EXPECT_LT((box.max() - high[k]).norm(), 2e-4) << links[k];
  }
}

TEST(LoadHandTest, AFixedLinkFollowsItsParent) {
  const Hand hand = LoadHand(kGood.string());
  const std::vector<Pose> X_HL = CalcLinkPoses(hand, Eigen::Vector2d(0.3, 0.4));
  const Eigen::Vector3d p_HTip =
      Eigen::Vector3d(0.03, 0, 0.01) +
      Eigen::AngleAxisd(1.5, Eigen::Vector3d::UnitZ()) *
          Eigen::Vector3d(0.04 * std::sin(0.3) + 0.018 * std::sin(0.7), 0.0,
                          0.04 * std::cos(0.3) + 0.018 * std::cos(0.7));
  EXPECT_LT((X_HL[hand.FindLink("tip")].translation() - p_HTip).norm(), 1e-9);
}

TEST(LoadHandTest, ReadsSlidesAndLinkages) {
  std::string urdf = ReadFile(kGood / "hand.urdf"), yaml = ReadFile(kGood / "hand.yaml");
  const auto replace = [](std::string& text, const std::string& from, const std::string& to) {
    ASSERT_NE(text.find(from), std::string::npos) << from;
    text.replace(text.find(from), from.size(), to);
  };
  replace(urdf, "name=\"J1\" type=\"revolute\"", "name=\"J1\" type=\"prismatic\"");
  replace(urdf, "lower=\"0\" upper=\"1.5\"", "lower=\"0\" upper=\"0.05\"");
  replace(yaml, "coupling:\n  rule: fixed\n  fixed_ratio: 0.5\n  joints: {J1: J2}\n",
          "slide_accuracy_mm: 0.5\nmimic:\n  - {joint: J1, follows: J2, ratio: -0.02, "
          "offset_mm: 30}\n");
  Diagnostics problems;
  const Hand hand = ParseHand(urdf, yaml, kGood, problems);
  ASSERT_EQ(problems.Format(), "");
  EXPECT_EQ(hand.slide_accuracy, 0.0005);
  EXPECT_TRUE(hand.joints[1].is_prismatic);
  EXPECT_EQ(hand.joints[1].coupled_to, 0);
  Eigen::VectorXd q = Eigen::Vector2d(0.5, 0.0);
  ApplyCoupling(hand, q);
  EXPECT_NEAR(q[1], 0.03 - 0.02 * 0.5, 1e-15);
  // The slide moves its link along the parent's y.
  const Pose X_HP = CalcLinkPose(hand, q, hand.FindLink("proximal"));
  const Pose X_HD = CalcLinkPose(hand, q, hand.FindLink("distal"));
  EXPECT_LT((X_HP.inverse() * X_HD.translation() - Eigen::Vector3d(0, q[1], 0.04)).norm(), 1e-12);

  replace(yaml, "stiffness_nm_per_rad: 2\n    damping_nms_per_rad: 0.1\n    torque_limit_nm: 1",
          "stiffness_n_per_m: 2\n    damping_ns_per_m: 0.1\n    force_limit_n: 1");
  ParseHand(urdf, yaml, kGood, problems);
  ASSERT_EQ(problems.num_errors(), 1);
  EXPECT_EQ(problems.entries()[0].text,
            "drives, entry 1, joints: \"J2\" turns: its drive has stiffness_nm_per_rad, "
            "damping_nms_per_rad and torque_limit_nm");
}

TEST(LoadHandTest, ReadsPads) {
  const std::string urdf = ReadFile(kGood / "hand.urdf"), yaml = ReadFile(kGood / "hand.yaml");
  const std::string pads =
      "pads:\n  - {links: [distal], youngs_modulus_pa: 1e6, depth_m: 0.002, source: a test}\n";
  Diagnostics problems;
  const Hand hand = ParseHand(urdf, yaml + pads, kGood, problems);
  ASSERT_EQ(problems.Format(), "");
  const SurfaceMaterial& surface = hand.links[hand.FindLink("distal")].surface;
  EXPECT_EQ(surface.pad.youngs_modulus, 1e6);
  EXPECT_EQ(surface.pad.depth, 0.002);
  EXPECT_TRUE(std::isnan(surface.torsion_radius));  // that of its patch
  EXPECT_EQ(hand.links[hand.FindLink("proximal")].surface.pad.youngs_modulus, 0.0);
  EXPECT_EQ(LoadHand(kGood.string()).links[hand.FindLink("distal")].surface.torsion_radius, 0.004);
}

TEST(LoadHandTest, RefusesPadsThatAreNone) {
  const std::string urdf = ReadFile(kGood / "hand.urdf"), yaml = ReadFile(kGood / "hand.yaml");
  const auto read = [&](const std::string& pad) {
    Diagnostics problems;
    ParseHand(urdf, yaml + "pads:\n  - {" + pad + "}\n", kGood, problems);
    return problems.Format();
  };
  const std::string good =
      "links: [distal], youngs_modulus_pa: 1e6, depth_m: 0.002, source: a test";
  EXPECT_EQ(read(good), "");
  const auto changed = [&](const std::string& from, const std::string& to) {
    std::string pad = good;
    pad.replace(pad.find(from), from.size(), to);
    return read(pad);
  };
  const auto says = [](const std::string& text, const char* part) {
    return text.find(part) != std::string::npos;
  };
  // Megapascals, millimetres, no source, another link.
  EXPECT_TRUE(says(changed("1e6", "1.1"), "is out of range; expected 10000 to 1000000000"));
  EXPECT_TRUE(says(changed("0.002", "2"), "expected 0.0001 to 0.02"));
  EXPECT_TRUE(says(changed(", source: a test", ""), "\"source\" is missing"));
  EXPECT_TRUE(says(changed("distal", "distale"), "did you mean \"distal\"?"));
  EXPECT_TRUE(says(changed("[distal]", "[distal, distal]"), "already has a pad"));
  // Deeper than a ball of 8 mm.
  EXPECT_TRUE(says(changed("0.002", "0.009"), "depth_m is 0.009; expected less than the radius"));
}

TEST(LoadHandTest, TheHashFollowsBothFiles) {
  const std::string urdf = ReadFile(kGood / "hand.urdf"), yaml = ReadFile(kGood / "hand.yaml");
  const auto hash = [](const std::string& u, const std::string& y) {
    Diagnostics problems;
    return ParseHand(u, y, kGood, problems).content_hash;
  };
  EXPECT_EQ(hash(urdf, yaml), LoadHand(kGood.string()).content_hash);
  EXPECT_NE(hash(urdf + "\n", yaml), hash(urdf, yaml));
  EXPECT_NE(hash(urdf, yaml + "\n"), hash(urdf, yaml));
}

// A quarter turn about x carries z to -y.
TEST(LoadHandTest, ReadsFramesAndLinksThatNeverTouch) {
  const std::string urdf = ReadFile(kGood / "hand.urdf"), yaml = ReadFile(kGood / "hand.yaml");
  const auto parse = [&](const std::string& more, Diagnostics& problems) {
    return ParseHand(urdf, yaml + more, kGood, problems);
  };
  Diagnostics problems;
  const Hand hand = parse(
      "apart:\n  - [palm, distal]\nframes:\n  - name: tip\n    link: distal\n"
      "    position_m: [0, 0.01, 0.02]\n    rpy_rad: [1.5707963267948966, 0, 0]\n",
      problems);
  ASSERT_EQ(problems.Format(), "");
  ASSERT_EQ(hand.frames.size(), 1u);
  EXPECT_EQ(hand.frames[0].name, "tip");
  EXPECT_EQ(hand.links[hand.frames[0].link].name, "distal");
  EXPECT_EQ(hand.frames[0].X_LF.translation(), Eigen::Vector3d(0, 0.01, 0.02));
  EXPECT_LT((hand.frames[0].X_LF.linear().col(2) - Eigen::Vector3d(0, -1, 0)).norm(), 1e-15);
  ASSERT_EQ(hand.apart.size(), 1u);
  for (const char* wrong : {"apart:\n  - [palm]\n", "apart:\n  - [palm, toe]\n", "apart: palm\n",
                            "frames:\n  - name: tip\n    link: toe\n    position_m: [0, 0, 0]\n",
                            "frames:\n  - link: palm\n    position_m: [0, 0, 3]\n"}) {
    Diagnostics found;
    parse(wrong, found);
    EXPECT_GT(found.num_errors(), 0) << wrong;
  }
}

const char kCamera[] =
    "camera:\n  link: distal\n  position_m: [0.01, 0, 0.02]\n  forward: [0, 0, 2]\n"
    "  right: [1, 0, 1]\n  focal_length_px: 700\n  radial_1: -0.1\n";

// Beside right only what is across forward counts.
TEST(LoadHandTest, ReadsACamera) {
  const std::string urdf = ReadFile(kGood / "hand.urdf"), yaml = ReadFile(kGood / "hand.yaml");
  Diagnostics problems;
  EXPECT_FALSE(ParseHand(urdf, yaml, kGood, problems).camera);
  const Hand hand = ParseHand(urdf, yaml + kCamera, kGood, problems);
  ASSERT_EQ(problems.Format(), "");
  ASSERT_TRUE(hand.camera);
  EXPECT_EQ(hand.links[hand.camera->link].name, "distal");
  EXPECT_LT((hand.camera->X_LK.translation() - Eigen::Vector3d(0.01, 0, 0.02)).norm(), 1e-15);
  EXPECT_LT((hand.camera->X_LK.linear() - Eigen::Matrix3d::Identity()).norm(), 1e-15);
  EXPECT_EQ(hand.camera->focal_length, 700.0);
  EXPECT_EQ(hand.camera->k1, -0.1);
  EXPECT_EQ(hand.camera->width, 640);
}

// It moves nothing: trials that do not look through it stay what they were.
TEST(LoadHandTest, TheHashLeavesTheCameraOut) {
  const std::string urdf = ReadFile(kGood / "hand.urdf"), yaml = ReadFile(kGood / "hand.yaml");
  const auto hash = [&](const std::string& y) {
    Diagnostics problems;
    return ParseHand(urdf, y, kGood, problems).content_hash;
  };
  EXPECT_EQ(hash(yaml + kCamera), hash(yaml));
  EXPECT_EQ(hash(kCamera + yaml), hash(yaml));
  EXPECT_NE(hash(yaml + kCamera + "# more\n"), hash(yaml));
  EXPECT_NE(hash(yaml + kCamera + "\n"), hash(yaml));
}

TEST(LoadHandTest, ACameraThatCannotBeIsRefused) {
  const std::string urdf = ReadFile(kGood / "hand.urdf"), yaml = ReadFile(kGood / "hand.yaml");
  Diagnostics problems;
  ParseHand(urdf,
            yaml +
                "camera:\n  link: nowhere\n  position_m: [0, 0, 0]\n  forward: [0, 0, 1]\n"
                "  right: [0, 0, 1]\n",
            kGood, problems);
  ASSERT_EQ(problems.num_errors(), 2) << problems.Format();
  EXPECT_NE(problems.entries()[0].text.find("camera: hand.urdf has no link \"nowhere\""),
            std::string::npos);
  EXPECT_NE(problems.entries()[1].text.find("must not lie along forward"), std::string::npos);
}

std::string MessageOf(const std::string& id_or_folder, ErrorKind kind) {
  try {
    LoadHand(id_or_folder);
  } catch (const Error& e) {
    EXPECT_EQ(e.kind(), kind);
    return e.what();
  }
  ADD_FAILURE() << "no error";
  return "";
}

// It would lie on the table upside down.
TEST(LoadHandTest, ACameraOnThePalmThatLooksAwayIsRefused) {
  const Hand hand = LoadHand("tum");
  const std::string yaml = ReadFile(hand.folder + "/hand.yaml");
  const std::string forward = "  forward: [0, 0, 1]\n";
  ASSERT_NE(yaml.find(forward), std::string::npos);
  for (const char* away : {"[0, 0, -1]", "[0, 1, 0]"}) {
    std::string changed = yaml;
    changed.replace(changed.find(forward), forward.size(),
                    std::string("  forward: ") + away + "\n");
    Diagnostics problems;
    ParseHand(ReadFile(hand.folder + "/hand.urdf"), changed, hand.folder, problems);
    ASSERT_EQ(problems.num_errors(), 1) << problems.Format();
    EXPECT_NE(problems.Format().find("camera, forward: looks away from what the palm faces"),
              std::string::npos);
  }
}

TEST(LoadHandTest, AFolderInPlaceOfTactileElementsIsTold) {
  const auto folder = std::filesystem::path(testing::TempDir()) / "hand_with_odd_skin";
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder / "tactile.yaml");
  for (const char* file : {"hand.urdf", "hand.yaml"}) {
    std::filesystem::copy_file(kGood / file, folder / file);
  }
  EXPECT_NE(MessageOf(folder.string(), ErrorKind::kFormat).find("tactile.yaml: error: is no file"),
            std::string::npos);
}

TEST(LoadHandTest, SaysWhatToGiveInsteadOfAWrongName) {
  EXPECT_EQ(MessageOf("shadw", ErrorKind::kNotFound),
            "no hand and no folder \"shadw\"; did you mean \"shadow\"? Known: shadow, "
            "shadow-evolved, tum, tum-courses, tum-evolved, tum-original");
  const std::string file = (kGood / "hand.urdf").string();
  EXPECT_EQ(MessageOf(file, ErrorKind::kNotFound),
            "\"" + file + "\" is a file; give the folder that holds hand.urdf and hand.yaml");
  const std::string folder = TEST_DATA_DIR;
  EXPECT_EQ(MessageOf(folder, ErrorKind::kFormat),
            "the hand \"" + folder + "\" cannot be used\n" + folder +
                "/hand.urdf: error: missing; a hand is a folder with hand.urdf and hand.yaml\n" +
                folder +
                "/hand.yaml: error: missing; a hand is a folder with hand.urdf and hand.yaml");
}

// A change of the good hand each, and all that is said about it.
TEST(LoadHandTest, TellsEveryProblemWithItsLine) {
  for (const TextCase& bad : ReadTextCases(TEST_DATA_DIR "/bad_hands.yaml")) {
    std::string urdf = ReadFile(kGood / "hand.urdf"), yaml = ReadFile(kGood / "hand.yaml");
    std::string& text = bad.file == "urdf" ? urdf : yaml;
    text = bad.Change(text);
    Diagnostics problems;
    testing::internal::CaptureStdout();
    testing::internal::CaptureStderr();
    ParseHand(urdf, yaml, kGood, problems);
    EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
    std::string told = problems.Format();
    const std::string folder = kGood.string() + "/";
    for (size_t p; (p = told.find(folder)) != std::string::npos;) told.erase(p, folder.size());
    EXPECT_EQ(told, bad.expected) << bad.from << " -> " << bad.to;
  }
}

}  // namespace
}  // namespace graspbench
