#include "datasets/plan/session_inputs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/arm/load_arm.h"
#include "core/base/error.h"
#include "core/base/files/files.h"
#include "core/hand/load_hand.h"
#include "core/shape/obj_file.h"
#include "core/shape/primitives.h"
#include "datasets/plan/session_plan.h"
#include "tests/datasets/find_error.h"
#include "tests/datasets/session/fake_session.h"

namespace graspbench {

namespace {

TEST(SessionInputs, TheSessionsApproachComesBeforeAllOthers) {
  SessionConfig config;
  config.hands = {"tum"};
  config.objects = {"golf_ball"};
  for (const char* name : {"automatic", "side", "above"}) {
    config.approach = name;
    const SessionInputs inputs = LoadSessionInputs(config, FieldUse::kLater);
    EXPECT_EQ(RowOf(kApproaches, inputs.objects[0]->approach).name, std::string(name));
    for (const Grasp& grasp : inputs.hands[0].grasps) {
      EXPECT_EQ(RowOf(kApproaches, grasp.approach).name, std::string(name));
    }
  }
}

/** All that the model changes; what a hand does not have is -1. */
std::vector<double> ListModelled(const SessionInputs& inputs) {
  const Hand& hand = *inputs.hands[0].hand;
  const GraspObject& object = *inputs.objects[0];
  std::vector<double> values = {object.mass_properties.mass, hand.joint_accuracy,
                                static_cast<double>(hand.coupling)};
  for (const HandJoint& joint : hand.joints) values.push_back(joint.drive.torque_limit);
  std::vector<SurfaceMaterial> surfaces = {object.surface};
  for (const HandLink& link : hand.links) surfaces.push_back(link.surface);
  for (const SurfaceMaterial& surface : surfaces) {
    values.insert(values.end(), {surface.friction_static, surface.torsion_radius,
                                 surface.pad.youngs_modulus, surface.pad.torsion_scale});
  }
  std::replace_if(
      values.begin(), values.end(), [](double value) { return std::isnan(value); }, -1.0);
  return values;
}

TEST(SessionInputs, ConditionsShareHandsAndObjectsThatTheyDoNotChange) {
  SessionConfig config;
  config.hands = {"shadow"};
  config.objects = {"golf_ball"};
  const std::vector<std::pair<std::string, bool>> settings = {
      {"model.mass_scale=2", false},        {"model.friction_scale=0.5", true},
      {"model.pad_torsion_scale=2", true},  {"model.pad_stiffness_scale=2", true},
      {"model.drive_torque_scale=2", true}, {"model.joint_error_scale=0", true},
      {"model.coupling_rule=even", true}};
  for (const auto& [setting, changes_hand] : settings)
    config.conditions.push_back({setting, {setting}});
  config.conditions.push_back({"two", {"model.mass_scale=2", "model.drive_torque_scale=2"}});
  const SessionInputs inputs = LoadSessionInputs(config, FieldUse::kLater);
  const auto find = [&](const std::string& name) { return inputs.conditions.at(name).inputs; };
  for (const auto& [setting, changes_hand] : settings) {
    const SessionInputs alone =
        LoadSessionInputs(inputs.conditions.at(setting).config, FieldUse::kLater);
    EXPECT_EQ(ListModelled(*find(setting)), ListModelled(alone)) << setting;
    EXPECT_NE(ListModelled(alone), ListModelled(inputs)) << setting;
    EXPECT_EQ(find(setting)->hands[0].hand != inputs.hands[0].hand, changes_hand) << setting;
  }
  EXPECT_EQ(find("two")->hands[0].hand, find("model.drive_torque_scale=2")->hands[0].hand);
  EXPECT_EQ(find("two")->objects[0], find("model.mass_scale=2")->objects[0]);
  EXPECT_EQ(find("model.drive_torque_scale=2")->objects[0], inputs.objects[0]);
}

namespace fs = std::filesystem;

void ExpectArmRefused(const std::string& arm_yaml, const std::string& hand,
                      const std::string& part) {
  const TemporaryFolder folder;
  WriteFile(folder.path() / "arm.yaml", arm_yaml);
  SessionConfig config;
  config.hands = {hand};
  config.objects = {"golf_ball"};
  config.arm.model = folder.path().string();
  try {
    LoadSessionInputs(config, FieldUse::kLater);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kRange);
    EXPECT_TRUE(Has(error.what(), part)) << error.what();
  }
}

/** The PA-10 with the first row's twist mirrored: its upper arm points down. */
TEST(SessionInputs, AnArmThatTouchesInItsReadyPostureIsRefused) {
  std::string text = ReadFile(LoadArm("pa10").folder + "/arm.yaml");
  text.replace(text.find("alpha_deg: -90"), 14, "alpha_deg: 90");
  ExpectArmRefused(text, "tum", "in its ready posture the base would meet link 2; check ");
}

/** Fingers of the Shadow Hand reach 0.45 m before the flange. */
TEST(SessionInputs, AHandThatIsInTheTableInTheReadyPostureIsRefused) {
  std::string text = ReadFile(LoadArm("pa10").folder + "/arm.yaml");
  const size_t at = text.find("ready_deg: [");
  text.replace(at, text.find(']', at) - at, "ready_deg: [0, 30, 0, 90, 0, 60, 0");
  ExpectArmRefused(text, "shadow", "in its ready posture the hand would meet the table; check ");
}

constexpr char kYaml[] =
    "name: block\nmesh: block.obj\nmesh_unit: mm\nmass_kg: 0.06\n"
    "friction_static: 0.5\nfriction_dynamic: 0.4\n";

class InputCopies : public testing::Test {
 protected:
  InputCopies() {
    fs::create_directories(block_);
    WriteFile(block_ / "object.yaml", kYaml);
    WriteFile(block_ / "block.obj", FormatObj(MakeRoundedBox({0.04, 0.03, 0.02}, 0.0), 1e3));
    WriteFile(block_ / "photo.raw", "not asked for");
    config_.hands = {"tum"};
    config_.objects = {"golf_ball", block_.string()};
  }

  TemporaryFolder top_;
  const fs::path block_ = top_.path() / "mine" / "block", session_ = top_.path() / "session";
  SessionConfig config_;
};

// tum-original draws two parts of tum's.
TEST_F(InputCopies, AGatheredHandHasAllItsMeshesAndMovesAsBefore) {
  const Hand original = LoadHand("tum-original");
  GatherHand(original.folder, session_ / "gathered");
  const Hand gathered = LoadHand((session_ / "gathered").string());
  EXPECT_EQ(ReadFile(session_ / "gathered" / "hand.urdf").find("../"), std::string::npos);
  ASSERT_EQ(gathered.visuals.size(), original.visuals.size());
  for (size_t i = 0; i < original.visuals.size(); ++i) {
    EXPECT_EQ(gathered.visuals[i].mesh.vertices, original.visuals[i].mesh.vertices);
  }
  EXPECT_EQ(gathered.num_joints(), original.num_joints());
}

TEST_F(InputCopies, HoldWhatTheOriginalsAreMadeOfAndNoMore) {
  const std::string hash = LoadSessionInputs(config_).objects[1]->content_hash;
  CopyInputs(config_, session_);
  const fs::path copy = session_ / "inputs" / "objects" / "block";
  EXPECT_TRUE(fs::exists(copy / "object.yaml") && fs::exists(copy / "block.obj"));
  EXPECT_FALSE(fs::exists(copy / "photo.raw"));
  EXPECT_FALSE(fs::exists(session_ / "inputs" / "hands"));
  fs::remove_all(block_);
  const SessionInputs inputs = LoadSessionInputs(config_, FieldUse::kLater, session_);
  ASSERT_EQ(inputs.objects.size(), 2u);
  EXPECT_EQ(inputs.objects[0]->id, "golf_ball");
  EXPECT_EQ(inputs.objects[1]->id, "block");
  EXPECT_EQ(inputs.objects[1]->content_hash, hash);
  EXPECT_THROW(LoadSessionInputs(config_, FieldUse::kLater), Error);
}

TEST_F(InputCopies, TheSameFolderByOtherNamesHasTheSameCopy) {
  config_.objects[1] += "/";
  CopyInputs(config_, session_);
  for (const std::string& name :
       {block_.string(), (block_ / "object.yaml").string(), (block_ / "." / "").string()}) {
    EXPECT_EQ(FindObjectInput(name, session_), (session_ / "inputs/objects/block").string());
  }
  EXPECT_EQ(FindObjectInput("can", session_), "can");
  EXPECT_EQ(FindObjectInput(block_.string(), {}), block_.string());
}

TEST_F(InputCopies, BuffersOfAGltfComeAlongAndNothingFromOutside) {
  std::string yaml = kYaml;
  WriteFile(block_ / "object.yaml", yaml.replace(yaml.find("block.obj"), 9, "a.gltf"));
  const auto write_buffer_name = [&](const std::string& name) {
    WriteFile(block_ / "a.gltf", "{\"buffers\":[{\"uri\":\"" + name +
                                     "\"},{\"uri\":\"data:application/octet-stream;base64,\"}]}");
  };
  WriteFile(block_ / "a.bin", "bytes");
  write_buffer_name("a.bin");
  CopyInputs(config_, session_);
  EXPECT_EQ(ReadFile(session_ / "inputs/objects/block/a.bin"), "bytes");
  write_buffer_name("../secret");
  WriteFile(block_.parent_path() / "secret", "x");
  EXPECT_TRUE(Throws([&] { CopyInputs(config_, top_.path() / "other"); }, ErrorKind::kUsage,
                     "lies outside that folder"));
}

TEST_F(InputCopies, AHandBringsTheMeshesOfItsUrdf) {
  const fs::path hand = top_.path() / "mine" / "hand";
  fs::copy(FindDataRoot() / "core" / "hand" / "models" / "tum", hand, fs::copy_options::recursive);
  config_.hands = {hand.string()};
  const SessionHand original = LoadSessionInputs(config_).hands[0];
  CopyInputs(config_, session_);
  fs::remove_all(hand);
  const SessionHand copy = LoadSessionInputs(config_, FieldUse::kLater, session_).hands[0];
  EXPECT_EQ(copy.hand->id, "hand");
  EXPECT_EQ(copy.hand->content_hash, original.hand->content_hash);
  EXPECT_EQ(copy.hand->visuals.size(), original.hand->visuals.size());
  EXPECT_EQ(copy.grasps.size(), original.grasps.size());
}

}  // namespace

}  // namespace graspbench
