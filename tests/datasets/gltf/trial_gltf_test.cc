#include "datasets/gltf/trial_gltf.h"

#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <assimp/Importer.hpp>
#include <limits>
#include <map>

#include "core/trial/trial_runner.h"
#include "objects/catalogue.h"
#include "tests/datasets/find_error.h"
#include "tests/datasets/gltf/read_glb.h"
#include "tests/datasets/mjcf/best_grasp_setup.h"

namespace graspbench {
namespace {

struct DoneTrial {
  TrialSetup setup;
  TracedTrial traced;
};

/** Simulated once for all tests. */
const DoneTrial& GetTrial(const std::string& hand) {
  static std::map<std::string, DoneTrial> trials;
  DoneTrial& trial = trials[hand];
  if (!trial.setup.hand) {
    trial.setup = MakeBestGraspSetup(hand, "golf_ball");
    trial.setup.object = CompleteObject(trial.setup.object);
    TrialRunner runner(trial.setup.hand, trial.setup.object);
    trial.traced = TraceTrial(runner, trial.setup, 0.01);
  }
  return trial;
}

Pose PoseFromAssimp(const aiMatrix4x4& m) {
  Pose pose = Pose::Identity();
  for (unsigned row = 0; row < 3; ++row) {
    for (unsigned column = 0; column < 4; ++column) {
      pose.matrix()(row, column) = static_cast<double>(m[row][column]);
    }
  }
  return pose;
}

/** Poses of all nodes below `node`, by name, at a key. */
void FindPoses(const aiNode& node, const aiAnimation& animation, unsigned key, const Pose& X_parent,
               std::map<std::string, Pose>* poses) {
  aiVector3D scale, translation;
  aiQuaternion rotation;
  node.mTransformation.Decompose(scale, rotation, translation);
  for (unsigned c = 0; c < animation.mNumChannels; ++c) {
    const aiNodeAnim& channel = *animation.mChannels[c];
    if (channel.mNodeName != node.mName) continue;
    if (channel.mNumPositionKeys > 1) translation = channel.mPositionKeys[key].mValue;
    if (channel.mNumRotationKeys > 1) rotation = channel.mRotationKeys[key].mValue;
  }
  const Pose X = X_parent * PoseFromAssimp(aiMatrix4x4(aiVector3D(1.0f), rotation, translation));
  (*poses)[node.mName.C_Str()] = X;
  for (unsigned c = 0; c < node.mNumChildren; ++c) {
    FindPoses(*node.mChildren[c], animation, key, X, poses);
  }
}

class TrialGltf : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Hands, TrialGltf, testing::Values("tum-evolved", "shadow-evolved"));

TEST_P(TrialGltf, NodesAreWhereTheSimulationWas) {
  const DoneTrial& trial = GetTrial(GetParam());
  const std::string glb = MakeTrialGlb(*trial.setup.hand, *trial.setup.object, trial.traced);
  const ReadGlb read(glb);
  const Json times = read.json["scenes"][0]["extras"]["times_s"];
  Assimp::Importer importer;
  const aiScene* scene = importer.ReadFileFromMemory(glb.data(), glb.size(), 0, "glb");
  ASSERT_TRUE(scene) << importer.GetErrorString();
  ASSERT_EQ(scene->mNumAnimations, 1u);
  const Pose X_YW = MakePose(MakeRotationRpy(-kPi / 2.0, 0.0, 0.0), Eigen::Vector3d::Zero());
  double farthest = 0.0;
  for (size_t key = 0; key < times.size(); ++key) {
    const TraceInstant& instant = FindInstant(trial.traced.trace, times[key].get<double>());
    ASSERT_NEAR(instant.time, times[key].get<double>(), 1e-4);
    std::map<std::string, Pose> poses;
    FindPoses(*scene->mRootNode, *scene->mAnimations[0], static_cast<unsigned>(key),
              Pose::Identity(), &poses);
    const auto expect = [&](const std::string& name, const Pose& X_W) {
      ASSERT_EQ(poses.count(name), 1u) << name;
      EXPECT_LT((poses[name].matrix() - (X_YW * X_W).matrix()).cwiseAbs().maxCoeff(), 3e-6)
          << name << " at " << instant.time << " s";
    };
    expect("object", instant.X_WO);
    const std::vector<Pose> X_HL = CalcLinkPoses(*trial.setup.hand, instant.q);
    for (size_t l = 0; l < X_HL.size(); ++l) {
      expect("hand/" + trial.setup.hand->links[l].name, instant.X_WH * X_HL[l]);
    }
    farthest = std::max(
        farthest,
        (instant.X_WO.translation() - trial.traced.trace.front().X_WO.translation()).norm());
  }
  EXPECT_GT(farthest, 0.05) << "it was lifted";
}

TEST_P(TrialGltf, HoldsPhasesAndContacts) {
  const DoneTrial& trial = GetTrial(GetParam());
  const ReadGlb glb(MakeTrialGlb(*trial.setup.hand, *trial.setup.object, trial.traced));
  const Json& extras = glb.json["scenes"][0]["extras"];
  EXPECT_EQ(extras["outcome"], NameOf(trial.traced.result.outcome));
  std::vector<std::string> phases;
  for (const Json& phase : extras["phases"]) phases.push_back(phase["name"].str());
  EXPECT_EQ(phases,
            (std::vector<std::string>{"placing", "closure", "stabilisation", "lift-off", "hold"}));
  for (const Json& phase : extras["phases"]) {  // it begins when the one before ends
    const double start = phase["time_s"].get<double>();
    for (const TraceInstant& instant : trial.traced.trace) {
      if (NameOf(instant.phase) == phase["name"].get<std::string>()) {
        EXPECT_GE(instant.time, start - 1e-4);
        EXPECT_LE(instant.time, start + 10.0);
        break;
      }
    }
  }
  size_t num_contacts = 0;
  for (size_t key = 0; key < extras["times_s"].size(); ++key) {
    const TraceInstant& instant =
        FindInstant(trial.traced.trace, extras["times_s"][key].get<double>());
    const Json& contacts = extras["contacts"]["keys"][key];
    ASSERT_EQ(contacts.size(), instant.contacts.size());
    num_contacts += contacts.size();
    Eigen::Vector3d force_W = Eigen::Vector3d::Zero(), sum_W = Eigen::Vector3d::Zero();
    for (size_t c = 0; c < contacts.size(); ++c) {
      const HandContact& contact = instant.contacts[c];
      EXPECT_EQ(contacts[c][0], contact.link);
      for (int axis = 0; axis < 3; ++axis) {
        const auto at = static_cast<size_t>(axis);
        EXPECT_NEAR(1e-4 * contacts[c][1 + at].get<double>(), contact.p_WC[axis], 5.1e-5);
        EXPECT_NEAR(1e-3 * contacts[c][4 + at].get<double>(), contact.nhat_W[axis], 5.1e-4);
        sum_W[axis] += 1e-3 * contacts[c][7 + at].get<double>();
      }
      force_W += contact.normal_force * contact.nhat_W + contact.friction_W;
      const size_t state = contacts[c][11].get<size_t>();
      EXPECT_EQ(extras["contacts"]["states"][state], DescribeState(contact));
    }
    EXPECT_LT((sum_W - force_W).norm(), 1e-3 * static_cast<double>(contacts.size() + 1));
  }
  EXPECT_GT(num_contacts, 100u);
}

TEST_P(TrialGltf, LeavesOutWhatStandsStillAndIsCoarse) {
  const DoneTrial& trial = GetTrial(GetParam());
  const ReadGlb glb(MakeTrialGlb(*trial.setup.hand, *trial.setup.object, trial.traced));
  for (const Json& channel : glb.json["animations"][0]["channels"]) {
    const Json& target = channel["target"];
    const std::string& name = glb.json["nodes"].at(target["node"].get<size_t>())["name"].str();
    if (name == "hand" || name == "object") continue;
    EXPECT_EQ(target["path"], "rotation") << name;
    const int link = trial.setup.hand->FindLink(name.substr(5));
    EXPECT_GE(trial.setup.hand->links.at(static_cast<size_t>(link)).joint, 0) << name;
  }
  EXPECT_LE(glb.CountTriangles(), 10500u);
  EXPECT_GT(glb.CountTriangles(), 2000u);
}

TEST_P(TrialGltf, PartsMakeTheWhole) {
  const DoneTrial& trial = GetTrial(GetParam());
  const std::string whole = MakeTrialGlb(*trial.setup.hand, *trial.setup.object, trial.traced);
  EXPECT_EQ(whole, MakeTrialGlb(*trial.setup.hand, *trial.setup.object, trial.traced))
      << "same input, same bytes";
  const ReadGlb all(whole),
      motion(MakeMotionGlb(*trial.setup.hand, *trial.setup.object, trial.traced)),
      hand(MakeHandGlb(*trial.setup.hand)), object(MakeObjectGlb(*trial.setup.object));
  EXPECT_EQ(hand.CountTriangles() + object.CountTriangles(), all.CountTriangles());
  EXPECT_EQ(motion.CountTriangles(), 0u);
  EXPECT_EQ(motion.json["scenes"], all.json["scenes"]);
  EXPECT_EQ(motion.json["animations"], all.json["animations"]);
  for (const Json& node : hand.json["nodes"]) {
    const int part = node["extras"]["part"].get<int>();
    const Json& at = motion.json["nodes"].at(static_cast<size_t>(part) + 2);
    EXPECT_EQ(at["extras"]["part"], part);
  }
  EXPECT_EQ(object.json["nodes"][0]["extras"]["part"], -1);
}

TEST(TrialGltfNames, StayText) {
  DoneTrial trial = GetTrial("tum-evolved");
  Hand hand = *trial.setup.hand;
  hand.links[1].name = "\"}],</script>\n";
  trial.setup.hand = std::make_shared<const Hand>(hand);
  trial.traced.result.reason = "\\\"]}";
  const ReadGlb glb(MakeTrialGlb(*trial.setup.hand, *trial.setup.object, trial.traced));
  EXPECT_EQ(glb.json["nodes"][3]["name"], "hand/\"}],</script>\n");
  EXPECT_EQ(glb.json["scenes"][0]["extras"]["reason"], "\\\"]}");
}

TEST(TrialGltfFailures, OfTheSimulationAreLeftOut) {
  DoneTrial trial = GetTrial("tum-evolved");
  std::vector<TraceInstant>& trace = trial.traced.trace;
  const size_t middle = trace.size() / 2;
  trace[middle].X_WO.translation().x() = std::numeric_limits<double>::quiet_NaN();
  const ReadGlb glb(MakeTrialGlb(*trial.setup.hand, *trial.setup.object, trial.traced));
  EXPECT_NEAR(glb.json["scenes"][0]["extras"]["times_s"].back().get<double>(),
              trace[middle - 1].time, 1e-4);
  trace.clear();
  EXPECT_TRUE(
      Has(FindError([&] { MakeTrialGlb(*trial.setup.hand, *trial.setup.object, trial.traced); }),
          "could not begin"));
}

}  // namespace
}  // namespace graspbench
