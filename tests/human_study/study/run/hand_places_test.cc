#include "human_study/study/run/hand_places.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/units.h"
#include "human_study/study/synthetic/synthetic_study.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;

// The generator puts markers 8 mm off a standing cylinder, the thumb at 180 deg and the fingers at
// 15, 5, -5 and -15 deg, 10, 30, 10, -10 and -30 mm above its middle; the hand comes along +y.
TEST(HandPlaces, AreWhereTheGeneratorPutTheMarkers) {
  constexpr double kAzimuths_deg[] = {180.0, 15.0, 5.0, -5.0, -15.0};
  constexpr double kHeights[] = {0.01, 0.03, 0.01, -0.01, -0.03};
  SyntheticOptions options;
  options.num_people = 1;
  options.trials_per_size = 1;
  AnalysisOptions analysis;
  analysis.contact.detector = "surface";
  std::vector<HandPlaces> all;
  for (const SyntheticTrial& trial : MakeSyntheticStudy(options)) {
    const ReachTrial reach = MakeReachTrial(trial);
    const Answer<HandPlaces> places =
        FindHandPlaces(AnalyseTrial(reach, analysis), reach, analysis);
    ASSERT_TRUE(places) << places.reason();
    ASSERT_EQ(places->digits.size(), 5u);
    double sum = 0.0;
    for (size_t d = 0; d < 5; ++d) {
      const double azimuth = RadFromDeg(kAzimuths_deg[d]);
      const double radius = trial.diameter / 2 + kSyntheticPadOffset;
      const Vector3d truth(radius * std::cos(azimuth), radius * std::sin(azimuth), kHeights[d]);
      EXPECT_LT((places->digits[d].p_OContact - truth).norm(), 0.002) << d;
      sum += std::abs(places->digits[d].p_OOpen.x()) - std::abs(truth.x());
    }
    EXPECT_GT(sum / 5, 0.003);  // the hand was wider
    EXPECT_GT(places->approach_O.y(), 0.9);
    for (const DigitPlaces& digit : places->digits) {
      ASSERT_GT(digit.p_OCourse.size(), 10u);
      EXPECT_EQ(digit.p_OCourse.front(), digit.p_OContact);
      const auto widest = static_cast<size_t>(std::lround(places->from_widest / kCoursePeriod));
      EXPECT_LT((digit.p_OCourse.at(widest) - digit.p_OOpen).norm(), 0.012);  // within 10 ms
      EXPECT_LT(digit.p_OCourse.back().y(), digit.p_OOpen.y());               // it came along +y
    }
    ASSERT_TRUE(places->p_OWrist);
    EXPECT_LT(places->p_OWrist->y(), -0.1);
    all.push_back(*places);
  }
  const HandPlaces median = CalcMedianPlaces({all[0], all[0], all[1]});
  EXPECT_EQ(median.digits[3].p_OContact, all[0].digits[3].p_OContact);
  EXPECT_EQ(median.digits[3].p_OCourse[7], all[0].digits[3].p_OCourse[7]);
  EXPECT_EQ(median.from_widest, all[0].from_widest);
}

// Joints that keep their places beside the tip in the object's frame until it is lifted.
TEST(HandPlaces, HaveTheJointsOfDigits) {
  SyntheticOptions options;
  options.num_people = 1;
  options.trials_per_size = 1;
  AnalysisOptions analysis;
  analysis.contact.detector = "surface";
  ReachTrial reach = MakeReachTrial(MakeSyntheticStudy(options).front());
  const Vector3d beside[] = {{0.0, -0.08, 0.0}, {0.01, -0.04, 0.02}};
  for (const Vector3d& p : beside) {
    Trajectory joint = reach.digits[1].tip;
    joint.p.colwise() += p;
    reach.digits[1].joints.push_back(joint);
  }
  const Answer<HandPlaces> places = FindHandPlaces(AnalyseTrial(reach, analysis), reach, analysis);
  ASSERT_TRUE(places) << places.reason();
  EXPECT_TRUE(places->digits[0].p_OJoints.empty());
  ASSERT_EQ(places->digits[1].p_OJoints.size(), 2u);
  for (int k = 0; k < 2; ++k) {
    const Vector3d found = places->digits[1].p_OJoints[k] - places->digits[1].p_OContact;
    EXPECT_LT((found - beside[k]).norm(), 0.001) << k;
  }
  const HandPlaces median = CalcMedianPlaces({*places, *places, *places});
  EXPECT_EQ(median.digits[1].p_OJoints, places->digits[1].p_OJoints);
}

TEST(HandPlaces, SayWhatIsMissing) {
  SyntheticOptions options;
  options.num_people = 1;
  options.trials_per_size = 1;
  ReachTrial reach = MakeReachTrial(MakeSyntheticStudy(options).front());
  AnalysisOptions analysis;
  const TrialAnalysis found = AnalyseTrial(reach, analysis);
  reach.object = {};
  EXPECT_NE(FindHandPlaces(found, reach, analysis).reason().find("markers.object"),
            std::string::npos);
}

}  // namespace
}  // namespace graspbench
