#include "core/hand/load_hand.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "core/base/units.h"
#include "core/hand/coupling.h"

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

/** A change of the good hand and what is said about it. */
struct BadHand {
  const char* file;  // "urdf" or "yaml"
  const char* from;
  const char* to;
  const char* expected;
};

std::string ProblemsOf(const BadHand& bad) {
  std::string urdf = ReadFile(kGood / "hand.urdf"), yaml = ReadFile(kGood / "hand.yaml");
  std::string& text = std::string(bad.file) == "urdf" ? urdf : yaml;
  const size_t at = text.find(bad.from);
  if (at == std::string::npos) {
    ADD_FAILURE() << "not in the good hand: " << bad.from;
    return "";
  }
  text.replace(at, std::string(bad.from).size(), bad.to);
  Diagnostics problems;
  ParseHand(urdf, yaml, kGood, problems);
  std::string told = problems.Format();
  const std::string folder = kGood.string() + "/";
  for (size_t p; (p = told.find(folder)) != std::string::npos;) told.erase(p, folder.size());
  return told;
}

class BadHandTest : public testing::TestWithParam<BadHand> {};

TEST_P(BadHandTest, TellsEveryProblemWithItsLine) {
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  const std::string told = ProblemsOf(GetParam());
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_EQ(told, GetParam().expected) << GetParam().from << " -> " << GetParam().to;
}

INSTANTIATE_TEST_SUITE_P(
    Urdf, BadHandTest,
    testing::Values(
        BadHand{"urdf", "</robot>", "",
                "hand.urdf:2: error: not valid XML: a tag or a value from here on is not closed or "
                "not well-formed (XML_ERROR_PARSING)"},
        BadHand{"urdf", "<robot name", "<sdf name",
                "hand.urdf:2: error: not valid XML: this element is not closed by its own name"},
        BadHand{"urdf", "<child link=\"distal\"/>", "<child link=\"dstal\"/>",
                "hand.urdf:34: error: joint \"J1\": child link \"dstal\" does not exist; did you "
                "mean \"distal\"? Known: palm, proximal, distal, tip\n"
                "hand.urdf:39: error: several roots: \"palm\", \"distal\"; join all links into one "
                "tree below the link that the arm carries"},
        BadHand{"urdf", "<parent link=\"proximal\"/>", "",
                "hand.urdf:32: error: joint \"J1\": <parent> is missing\n"
                "hand.urdf:39: error: several roots: \"palm\", \"distal\"; join all links into one "
                "tree below the link that the arm carries"},
        BadHand{"urdf", "ixx=\"4e-6\" ixy=\"0\" ixz=\"0\" iyy=\"4e-6\" iyz=\"0\" izz=\"1e-6\"",
                "ixx=\"0\" ixy=\"0\" ixz=\"0\" iyy=\"0\" iyz=\"0\" izz=\"0\"",
                "hand.urdf:25: error: link \"proximal\", inertial: the inertia is zero; a moving "
                "body needs one"},
        BadHand{"urdf", "izz=\"1e-6\"", "izz=\"9e-6\"",
                "hand.urdf:25: error: link \"proximal\", inertial: no body has this inertia: the "
                "largest principal moment exceeds the sum of the other two"},
        BadHand{"urdf", "izz=\"1e-6\"", "izz=\"-1e-6\"",
                "hand.urdf:25: error: link \"proximal\", inertial: the inertia has a principal "
                "moment that is not positive"},
        BadHand{
            "urdf", "ixx=\"4e-6\" ixy=\"0\" ixz=\"0\" iyy=\"4e-6\" iyz=\"0\" izz=\"1e-6\"",
            "ixx=\"0.5\" ixy=\"0\" ixz=\"0\" iyy=\"0.5\" iyz=\"0\" izz=\"0.3\"",
            "hand.urdf:25: error: link \"proximal\", inertial: far too large for the mass, that "
            "of a body of more than 2 m across (URDF is in kg m^2)"},
        BadHand{"urdf", "xyz=\"0.03 0 0.01\"", "xyz=\"30 0 10\"",
                "hand.urdf:16: error: joint \"J2\": farther than 2 m away (URDF is in metres)"},
        BadHand{"urdf", "0.1 0.2 0.3", "100 200 300",
                "palm.obj: error: the mesh reaches farther than 2 m; URDF is in metres, so one in "
                "millimetres needs scale=\"0.001 0.001 0.001\""},
        BadHand{"urdf", "<mass value=\"0.03\"/>", "<mass value=\"0\"/>",
                "hand.urdf:24: error: link \"proximal\", inertial: the mass must be positive"},
        BadHand{"urdf",
                "<inertial>\n      <mass value=\"0.02\"/>\n      <inertia ixx=\"2e-6\" ixy=\"0\" "
                "ixz=\"0\" iyy=\"2e-6\" iyz=\"0\" izz=\"1e-6\"/>\n    </inertial>",
                "",
                "hand.urdf:39: error: link \"distal\": <inertial> is missing; joint \"J1\" moves "
                "it, so it needs mass and inertia"},
        BadHand{"urdf", "lower=\"-0.2\" upper=\"1.5\"", "lower=\"1.5\" upper=\"-0.2\"",
                "hand.urdf:18: error: joint \"J2\": the lower limit 1.5 is not below the upper "
                "limit -0.2"},
        BadHand{"urdf", "upper=\"1.5\"", "upper=\"85\"",
                "hand.urdf:18: error: joint \"J2\": a limit exceeds one turn; URDF angles are in "
                "radians"},
        BadHand{"urdf", "upper=\"1.5\"", "upper=\"inf\"",
                "hand.urdf:18: error: joint \"J2\", <limit> upper: expected 1 finite number, found "
                "\"inf\""},
        BadHand{"urdf", "effort=\"1\" ", "",
                "hand.urdf:18: error: joint \"J2\": <limit> has no attribute effort"},
        BadHand{"urdf", "xyz=\"0 2 0\"", "xyz=\"0 0 0\"",
                "hand.urdf:17: error: joint \"J2\": the axis has no direction"},
        BadHand{"urdf", "xyz=\"0 0 0.02\"", "xyz=\"0 0,02\"",
                "hand.urdf:23: error: link \"proximal\", inertial, <origin> xyz: expected 3 finite "
                "numbers, found \"0 0,02\"; without it nobody knows where the inertial is"},
        BadHand{"urdf", "xyz=\"0 0 0.02\"", "quat_xyzw=\"0 0 0 1\" xyz=\"0 0 0.02\"",
                "hand.urdf:23: error: link \"proximal\", inertial: its <origin> has the attribute "
                "\"quat_xyzw\"; expected the attributes \"xyz\" (a place in metres) and \"rpy\" "
                "(roll, pitch, yaw in radians) alone; give the place and the rotation by these"},
        BadHand{"urdf", "name=\"J1\" type=\"revolute\"", "name=\"J1\" type=\"floating\"",
                "hand.urdf:32: error: joint \"J1\": type \"floating\" is not supported; a hand's "
                "joints are revolute or prismatic (with limits), or fixed\n"
                "hand.yaml:17: error: coupling of J1: hand.urdf has no moving joint \"J1\"; did "
                "you mean \"J2\"? Known: J2"},
        BadHand{"urdf", "name=\"J1\"", "name=\"J2\"",
                "hand.urdf:32: error: joint \"J2\": the name is taken by line 13\n"
                "hand.yaml:17: error: coupling of J1: hand.urdf has no moving joint \"J1\"; did "
                "you mean \"J2\"? Known: J2"},
        BadHand{"urdf", "<link name=\"tip\"/>", "<link name=\"palm\"/>",
                "hand.urdf:54: error: link \"palm\": the name is taken by line 4\n"
                "hand.urdf:51: error: joint \"tip_joint\": child link \"tip\" does not exist. "
                "Known: palm, proximal, distal"},
        BadHand{"urdf", "<link name=\"tip\"/>", "<link name=\"tip\"/><link name=\"loose\"/>",
                "hand.urdf:54: error: several roots: \"palm\", \"loose\"; join all links into one "
                "tree below the link that the arm carries"},
        BadHand{"urdf", "<parent link=\"palm\"/>", "<parent link=\"tip\"/>",
                "hand.urdf:13: error: the joints \"J2\", \"tip_joint\", \"J1\" form a cycle; a "
                "hand is a tree"},
        BadHand{"urdf", "<child link=\"tip\"/>", "<child link=\"proximal\"/>",
                "hand.urdf:49: error: joint \"tip_joint\": link \"proximal\" already hangs on "
                "joint \"J2\" (line 13); a hand is a tree, so cut the loop and give one side a "
                "mimic\n"
                "hand.urdf:54: error: several roots: \"palm\", \"tip\"; join all links into one "
                "tree below the link that the arm carries"},
        BadHand{"urdf", "palm.obj", "plam.obj",
                "hand.urdf:6: error: link \"palm\", visual: mesh not found: \"plam.obj\", relative "
                "to the hand's folder"},
        BadHand{"urdf", "palm.obj", "package://maker/palm.obj",
                "hand.urdf:6: error: link \"palm\", visual: mesh \"package://maker/palm.obj\" is "
                "an address; give a path relative to the hand's folder"},
        BadHand{"urdf", "palm.obj", "palm.dae",
                "hand.urdf:6: error: link \"palm\", visual: mesh \"palm.dae\": only OBJ files are "
                "read; convert it"},
        BadHand{"urdf", "<material name=\"grey\"/>", "<material name=\"gray\"/>",
                "hand.urdf:7: error: link \"palm\", visual: material \"gray\" is not defined; did "
                "you mean \"grey\"? Known: grey"},
        BadHand{"urdf", "radius=\"0.007\" length=\"0.05\"", "radius=\"7\" length=\"50\"",
                "hand.urdf:29: error: link \"proximal\", collision: a size must be positive and at "
                "most 2 m (URDF is in metres)"},
        BadHand{"urdf", "radius=\"0.007\" length=\"0.05\"", "radius=\"0.0007\" length=\"0.05\"",
                "hand.urdf:29: error: link \"proximal\", collision: more than 30 times as long as "
                "thick; split it or make it thicker"},
        BadHand{"urdf", "<sphere radius=\"0.008\"/>", "<mesh filename=\"palm.obj\"/>",
                "hand.urdf:46: error: link \"distal\", collision: a mesh cannot touch; describe it "
                "by spheres, cylinders and boxes"},
        BadHand{"urdf", "<sphere radius=\"0.008\"/>", "<ball radius=\"0.008\"/>",
                "hand.urdf:46: error: link \"distal\", collision: unknown shape <ball>. Known: "
                "sphere, cylinder, box, mesh"},
        BadHand{"urdf",
                "<collision>\n      <origin xyz=\"0 0 0.01\"/>\n      <geometry><sphere "
                "radius=\"0.008\"/></geometry>\n    </collision>",
                "",
                "hand.urdf: error: link \"distal\" carries the pad of digit TH but has no "
                "<collision>, so it could never touch"},
        BadHand{"urdf", "<dynamics damping=\"0.1\"/>", "<limits/><mimic joint=\"J1\"/>",
                "hand.urdf:19: warning: joint \"J2\": <mimic> is not used; name the joint under "
                "mimic in hand.yaml\n"
                "hand.urdf:19: warning: joint \"J2\": <limits> is not used; did you mean "
                "\"limit\"? Known: parent, child, origin, axis, limit"},
        BadHand{"urdf", "0.5 0.5 0.5 1", "128 128 128 1",
                "hand.urdf:3: error: material: a colour's numbers lie between 0 and 1"},
        BadHand{"urdf", "</material>",
                "</material><material name=\"grey\"><color rgba=\"0 0 0 1\"/></material>",
                "hand.urdf:3: error: material: the name \"grey\" is taken"},
        BadHand{"urdf", "<color rgba=\"0.5 0.5 0.5 1\"/>", "",
                "hand.urdf:3: error: material: <color> is missing"},
        BadHand{"urdf", "<robot ", "<robot version=\"2.0\" ",
                "hand.urdf:2: error: robot: URDF of version \"2.0\"; expected 1.0"},
        BadHand{"urdf", "xyz=\"0 2 0\"", "xyz=\"0,2,0\"",
                "hand.urdf:17: error: joint \"J2\", <axis> xyz: expected 3 finite numbers, found "
                "\"0,2,0\""},
        BadHand{"urdf", "xyz=\"0 2 0\"", "xyz=\"${a}\"",
                "hand.urdf:17: error: joint \"J2\", <axis> xyz: expected 3 finite numbers, found "
                "\"${a}\", a macro: expand the file first (xacro FILE.xacro > FILE.urdf)"},
        BadHand{"urdf", "0.1 0.2 0.3", "0.1 0 0.3",
                "hand.urdf:6: error: link \"palm\", visual: a mesh with a scale of 0"}));

INSTANTIATE_TEST_SUITE_P(
    Yaml, BadHandTest,
    testing::Values(
        BadHand{"yaml", "digits:", "digits: [",
                "hand.yaml:8: error: not valid YAML: illegal block entry"},
        BadHand{"yaml", "name: Two", "nmae: Two",
                "hand.yaml:1: error: hand: the key \"name\" is missing\n"
                "hand.yaml:1: error: hand: unknown key \"nmae\"; did you mean \"name\"?"},
        BadHand{
            "yaml", "joint_accuracy_deg: 1", "joint_accuracy_deg: -1\nspeed: 3",
            "hand.yaml:6: error: hand, joint_accuracy_deg: -1 is out of range; expected 0 to 45\n"
            "hand.yaml:7: error: hand: unknown key \"speed\". Known: name, palm, "
            "joint_accuracy_deg, slide_accuracy_mm, pad_torsion_radius_m, digits, surfaces, "
            "pads, coupling, mimic, drives, apart, frames, camera, grasps"},
        BadHand{"yaml", "link: palm", "link: plam",
                "hand.yaml:3: error: palm: hand.urdf has no link \"plam\"; did you mean \"palm\"? "
                "Known: palm, proximal, "
                "distal, tip"},
        BadHand{"yaml", "[0, 0, 2]", "[0, 0, 0]",
                "hand.yaml:5: error: palm, normal: has no direction"},
        BadHand{"yaml", "links: [proximal, distal]", "links: []",
                "hand.yaml:11: error: digit 1, links: a digit needs at least one link"},
        BadHand{"yaml", "links: [proximal, distal]", "links: [proximal, dstal]",
                "hand.yaml:11: error: digit TH: hand.urdf has no link \"dstal\"; did you mean "
                "\"distal\"? Known: palm, proximal, distal, tip"},
        BadHand{"yaml", "links: [proximal, distal]", "links: [distal, proximal]",
                "hand.yaml:11: error: digit TH: link \"proximal\" does not hang on the link before "
                "it, \"distal\"; name them from base to tip"},
        BadHand{"yaml", "thumb: true", "thumb: false",
                "hand.yaml:8: error: digits: one digit must have \"thumb: true\", found 0"},
        BadHand{"yaml", "tip_m: [0, 0, 0.018]", "tip_m: [0, 0, 18]",
                "hand.yaml:12: error: digit 1, tip_m: 18 is out of range; expected -1 to 1"},
        BadHand{"yaml", "rule: fixed", "rule: evn",
                "hand.yaml:15: error: coupling, rule: unknown rule \"evn\"; did you mean \"even\"? "
                "Known: middle-first, even, fixed"},
        BadHand{"yaml", "{J1: J2}", "{J1: J3}",
                "hand.yaml:17: error: coupling of J1: hand.urdf has no moving joint \"J3\"; did "
                "you mean \"J2\"? Known: J2, J1\n"
                "hand.yaml:19: error: drives: joint \"J1\" has neither drive nor coupling"},
        BadHand{"yaml", "{J1: J2}", "{J2: J1}",
                "hand.yaml:17: error: coupling of J2: joint \"J1\" is not the joint before it in "
                "the finger\n"
                "hand.yaml:19: error: drives, entry 1, joints: \"J2\" is coupled and has no drive "
                "of its own\n"
                "hand.yaml:19: error: drives: joint \"J1\" has neither drive nor coupling"},
        BadHand{"yaml", "{J1: J2}", "{}",
                "hand.yaml:19: error: drives: joint \"J1\" has neither drive nor coupling"},
        BadHand{"yaml", "joints: [J2]", "joints: [J2, J1]",
                "hand.yaml:19: error: drives, entry 1, joints: \"J1\" is coupled and has no drive "
                "of its own"},
        BadHand{"yaml", "joints: [J2]", "joints: [J2, J2, J4]",
                "hand.yaml:19: error: drives, entry 1, joints: \"J2\" already has a drive\n"
                "hand.yaml:19: error: drives, entry 1: hand.urdf has no moving joint \"J4\"; did "
                "you mean \"J2\"? Known: J2, J1"},
        BadHand{
            "yaml", "stiffness_nm_per_rad: 2", "stiffness: 2",
            "hand.yaml:19: error: drives, entry 1: the key \"stiffness_nm_per_rad\" is missing\n"
            "hand.yaml:20: error: drives, entry 1: unknown key \"stiffness\". Known: joints, "
            "stiffness_nm_per_rad, damping_nms_per_rad, torque_limit_nm"},
        BadHand{"yaml", "torque_limit_nm: 1", "torque_limit_nm: .nan",
                "hand.yaml:22: error: drives, entry 1, torque_limit_nm: expected a finite number"},
        BadHand{"yaml", "damping_nms_per_rad: 0.1", "damping_nms_per_rad: -1",
                "hand.yaml:21: error: drives, entry 1, damping_nms_per_rad: -1 is out of range; "
                "expected at least 0"}));

}  // namespace
}  // namespace graspbench
