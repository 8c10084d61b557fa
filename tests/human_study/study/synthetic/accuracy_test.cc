/** @file
What the README promises about contact times, on trials whose contacts are known exactly. The seeds
are used nowhere else: no rule was chosen by looking at these trials. */

#include <gtest/gtest.h>

#include <cmath>

#include "core/statistics/summary.h"
#include "human_study/study/synthetic/bias_card.h"

namespace graspbench {
namespace {

SyntheticOptions MakeOptions(const std::string& seed) {
  SyntheticOptions options;
  options.seed = seed;
  options.num_people = 5;
  options.trials_per_size = 2;
  options.rate = 200.0;
  options.noise = 0.0003;
  options.forming_time = 0.03;
  return options;
}

/** The usual options with what a study learns from these trials. */
AnalysisOptions LearnOptions(const std::vector<SyntheticTrial>& trials) {
  AnalysisOptions options;
  std::vector<TouchFit> fits;
  for (const SyntheticTrial& trial : trials) {
    for (const DigitContactEvents& digit : AnalyseTrial(MakeReachTrial(trial), options).contacts) {
      if (digit.contact.IsFound()) fits.push_back(digit.fit);
    }
  }
  options.contact.depths = LearnDepths(fits);
  return options;
}

// Skin sinks in by half a millimetre and more (Pawluk & Howe 1999); what stops dead is covered by
// more than is stated.
TEST(ContactAccuracy, TheDefaultDetectorKeepsItsPromise) {
  for (const char* seed : {"accuracy a", "accuracy b", "accuracy c"}) {
    SyntheticOptions options = MakeOptions(seed);
    options.pad_compression = 0.5e-3;
    const std::vector<SyntheticTrial> trials = MakeSyntheticStudy(options);
    const BiasRow row = CalcBiasRow(trials, LearnOptions(trials));
    EXPECT_EQ(row.num_missing, 0) << seed;
    EXPECT_EQ(row.num_trials, 40);
    EXPECT_LT(std::abs(row.contact_bias), 0.005) << seed;
    EXPECT_LT(row.contact_sd, 0.010) << seed;
    EXPECT_NEAR(row.mean_gft, 0.03, 0.003) << seed;
    // All have the usual skin: how skins differ is stated, and not in these errors.
    EXPECT_GT(row.coverage, 0.85) << seed;
  }
}

// Nothing is lifted: the hold is found from the hand alone, and the way back is in the recording.
TEST(ContactAccuracy, TheDefaultDetectorKeepsItsPromiseWithoutALift) {
  for (const bool rests : {true, false}) {
    SyntheticOptions options = MakeOptions(rests ? "accuracy f" : "accuracy g");
    options.lifts = false;
    options.rests = rests;
    options.pad_compression = 0.5e-3;
    const BiasRow row = CalcBiasRow(MakeSyntheticStudy(options), AnalysisOptions());
    EXPECT_EQ(row.num_missing, 0) << rests;
    EXPECT_LT(std::abs(row.contact_bias), 0.005) << rests;
    EXPECT_LT(row.contact_sd, 0.010) << rests;
    EXPECT_NEAR(row.mean_gft, 0.03, 0.003) << rests;
    EXPECT_GT(row.coverage, 0.85) << rests;
  }
}

TEST(OnsetAccuracy, RegressionNeedsNoRestBeforeTheReach) {
  SyntheticOptions options = MakeOptions("accuracy h");
  options.lifts = false;
  options.rests = false;
  AnalysisOptions analysis;
  analysis.movement.rule = "regression";
  std::vector<double> errors;
  for (const SyntheticTrial& trial : MakeSyntheticStudy(options)) {
    const EventTime onset = AnalyseTrial(MakeReachTrial(trial), analysis).movement.onset;
    ASSERT_TRUE(onset.IsFound()) << onset.missing;
    errors.push_back(onset.time - trial.truth.onset);
  }
  const Moments moments = CalcMoments(errors);
  EXPECT_NEAR(moments.mean, 0.0, 0.005);
  EXPECT_LT(std::sqrt(moments.sum_of_squares / static_cast<double>(errors.size() - 1)), 0.015);
}

TEST(ContactAccuracy, FasterContactsAreFoundBetter) {
  SyntheticOptions options = MakeOptions("accuracy d");
  options.min_contact_speed = 0.08;
  options.max_contact_speed = 0.25;
  const BiasRow row = CalcBiasRow(MakeSyntheticStudy(options), AnalysisOptions());
  EXPECT_LT(std::abs(row.contact_bias), 0.004);
  EXPECT_LT(row.contact_sd, 0.007);
}

TEST(ContactAccuracy, EveryDetectorFindsContactsWhereItsEvidenceIs) {
  SyntheticOptions options = MakeOptions("accuracy e");
  options.has_force = true;
  const std::vector<SyntheticTrial> trials = MakeSyntheticStudy(options);
  for (const ContactDetector& detector : ContactDetectorList()) {
    AnalysisOptions analysis;
    analysis.contact.detector = detector.id;
    const BiasRow row = CalcBiasRow(trials, analysis);
    EXPECT_LE(row.num_missing, 2) << detector.id;
    EXPECT_LT(std::abs(row.contact_bias), 0.015) << detector.id;
    EXPECT_LT(row.contact_sd, 0.015) << detector.id;
    EXPECT_NEAR(row.mean_gft, 0.03, 0.010) << detector.id;
  }
}

TEST(BiasCard, ALowCutoffIsSeenToBlurTheSpeedRule) {
  AnalysisOptions options;
  options.contact.detector = "speed";
  BiasCase sharp;
  sharp.text = "20 Hz";
  sharp.noise = 0.0001;
  sharp.options = options;
  BiasCase blurred = sharp;
  blurred.text = "6 Hz";
  blurred.options.contact.cutoff = 6.0;
  const std::vector<BiasRow> rows = CalcBiasCard({sharp, blurred}, {0.0, 0.03}, 20, "card");
  ASSERT_EQ(rows.size(), 4u);
  EXPECT_EQ(rows[0].text, "20 Hz");
  EXPECT_EQ(rows[3].text, "6 Hz");
  EXPECT_NEAR(rows[0].true_gft, 0.0, 1e-9);
  EXPECT_NEAR(rows[3].true_gft, 0.03, 1e-9);
  EXPECT_GT(rows[0].mean_gft, 0.0);  // noise alone makes touching together look like a sequence
  EXPECT_LT(rows[2].mean_gft, rows[3].mean_gft);
}

}  // namespace
}  // namespace graspbench
