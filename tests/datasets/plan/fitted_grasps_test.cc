#include "datasets/plan/fitted_grasps.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <functional>

#include "core/base/files/files.h"
#include "core/base/hash.h"
#include "core/hand/load_hand.h"
#include "objects/catalogue.h"

namespace graspbench {
namespace {
namespace fs = std::filesystem;

class FittedGraspsTest : public testing::Test {
 protected:
  FittedGraspsTest() {
    ::setenv("XDG_CACHE_HOME", testing::TempDir().c_str(), 1);
    for (const Grasp& grasp : LoadStandardGrasps(hand_)) {
      if (grasp.id == "g4") grasp_ = grasp;
    }
  }
  /** As another run finds it. */
  FittedGrasp Find() const {
    FittedGrasps fitted;
    return fitted.Find(std::make_shared<const Hand>(hand_), grasp_,
                       std::make_shared<const GraspObject>(object_));
  }
  static std::vector<fs::path> ListFiles() {
    const fs::path folder = FindCacheRoot() / "fits";
    std::vector<fs::path> files;
    if (!fs::exists(folder)) return files;
    for (const auto& entry : fs::directory_iterator(folder)) files.push_back(entry.path());
    return files;
  }

  Hand hand_ = LoadHand("tum");
  GraspObject object_ = *LoadObject("golf_ball");
  Grasp grasp_;
};

void ExpectSame(const FittedGrasp& a, const FittedGrasp& b) {
  EXPECT_EQ(a.grasp.id, b.grasp.id);
  EXPECT_EQ(a.grasp.q_pre, b.grasp.q_pre);
  EXPECT_EQ(a.grasp.q_target, b.grasp.q_target);
  EXPECT_EQ(a.grasp.digits, b.grasp.digits);
  EXPECT_EQ(a.grasp.approach, b.grasp.approach);
  const GraspPrediction &p = a.prediction, &q = b.prediction;
  EXPECT_EQ(p.reach_miss, q.reach_miss);
  EXPECT_EQ(p.room, q.room);
  EXPECT_EQ(p.needed_room, q.needed_room);
  EXPECT_EQ(p.num_digits, q.num_digits);
  EXPECT_EQ(p.num_touching, q.num_touching);
  EXPECT_EQ(p.thumb_touches, q.thumb_touches);
  EXPECT_EQ(p.opposes, q.opposes);
  EXPECT_EQ(p.lifts, q.lifts);
  EXPECT_EQ(p.contact_height, q.contact_height);
  EXPECT_EQ(p.palm_is_near, q.palm_is_near);
}

FittedGrasp Calc(const Hand& hand, const Grasp& grasp, const GraspObject& object) {
  FittedGrasp fitted = {FitGrasp(hand, grasp, object), {}};
  fitted.prediction = PredictGrasp(hand, fitted.grasp, object);
  return fitted;
}

TEST_F(FittedGraspsTest, TheSecondRunReadsTheSameBits) {
  const FittedGrasp expected = Calc(hand_, grasp_, object_);
  ExpectSame(Find(), expected);
  const std::vector<fs::path> files = ListFiles();
  ASSERT_EQ(files.size(), 1u);
  const auto stamp = fs::last_write_time(files[0]);
  object_.field = nullptr;
  ExpectSame(Find(), expected);
  EXPECT_EQ(fs::last_write_time(files[0]), stamp);
}

// Everything by which a session may change a hand or an object, and a grasp.
TEST_F(FittedGraspsTest, WhatAChangedNumberGivesIsNotThatOfTheOldOne) {
  const std::vector<std::function<void()>> changes = {
      [&] { hand_.joint_accuracy *= 2.0; },
      [&] { hand_.coupling = CouplingRule::kFixed; },
      [&] { hand_.joints[1].upper -= 0.01; },
      [&] { hand_.links[2].X_PJ.translation().x() += 1e-4; },
      [&] { hand_.contact_spheres[3].radius *= 1.01; },
      [&] { hand_.digits[0].p_LPad.x() += 1e-4; },
      [&] { grasp_.q_pre[2] += 0.01; },
      [&] { grasp_.tilt += 0.01; },
      [&] { grasp_.approach = Approach::kSide; },
      [&] { object_.surface.friction_static *= 0.5; },
      [&] { object_.mass_properties.p_OOcm.x() += 1e-3; },
      [&] { object_.approach = Approach::kAbove; },
  };
  Find();
  size_t num_files = 1;
  for (const auto& change : changes) {
    change();
    SCOPED_TRACE(num_files);
    ExpectSame(Find(), Calc(hand_, grasp_, object_));
    ASSERT_EQ(ListFiles().size(), ++num_files);
  }
}

TEST_F(FittedGraspsTest, ADamagedFileIsReplacedAndANonsensicalOneRefused) {
  const FittedGrasp expected = Find();
  const fs::path path = ListFiles().at(0);
  const std::string good = ReadFile(path);
  std::string flipped = good, nonsense = good;
  flipped[30] = static_cast<char>(flipped[30] ^ 1);
  const double huge = 1e300;
  std::memcpy(nonsense.data() + 24, &huge, sizeof huge);  // with the right hash
  const uint64_t hash = CalcHash64(std::string_view(nonsense).substr(16));
  std::memcpy(nonsense.data() + 8, &hash, sizeof hash);
  for (const std::string& bad : {flipped, nonsense, good.substr(0, 40), std::string()}) {
    WriteFile(path, bad);
    ExpectSame(Find(), expected);
    EXPECT_EQ(ReadFile(path), good);
  }
}

}  // namespace
}  // namespace graspbench
