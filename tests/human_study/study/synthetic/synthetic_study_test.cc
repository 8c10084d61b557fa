#include "human_study/study/synthetic/synthetic_study.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "core/base/files/files.h"
#include "core/statistics/summary.h"
#include "human_study/recording/importers/importer.h"
#include "tests/human_study/events/trajectories.h"
#include "tests/human_study/faults.h"

namespace graspbench {
namespace {

SyntheticOptions MakeOptions() {
  SyntheticOptions options;
  options.seed = "generator";
  options.num_people = 3;
  options.trials_per_size = 2;
  return options;
}

double Last(const SyntheticTruth& truth) {
  return *std::max_element(truth.contacts.begin(), truth.contacts.end());
}
double First(const SyntheticTruth& truth) {
  return *std::min_element(truth.contacts.begin(), truth.contacts.end());
}

TEST(SyntheticStudy, TheSameSeedGivesTheSameBitsAndAnotherDoesNot) {
  SyntheticOptions options = MakeOptions();
  const std::vector<SyntheticTrial> a = MakeSyntheticStudy(options),
                                    b = MakeSyntheticStudy(options);
  options.seed = "other";
  const std::vector<SyntheticTrial> c = MakeSyntheticStudy(options);
  ASSERT_EQ(a.size(), 24u);
  for (size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].recording.points[2].xyz, b[i].recording.points[2].xyz);
  }
  EXPECT_NE(a[0].recording.points[2].xyz, c[0].recording.points[2].xyz);
}

TEST(SyntheticStudy, NoiseDoesNotChangeTheMovement) {
  SyntheticOptions options = MakeOptions();
  const std::vector<SyntheticTrial> a = MakeSyntheticStudy(options);
  options.noise = 0.0;
  const std::vector<SyntheticTrial> b = MakeSyntheticStudy(options);
  for (size_t i = 0; i < a.size(); ++i) EXPECT_EQ(a[i].truth.contacts, b[i].truth.contacts);
}

TEST(SyntheticStudy, EachTipTouchesAtItsTimeAndNotBefore) {
  SyntheticOptions options = MakeOptions();
  options.noise = 0.0;
  options.rate = 1000.0;
  options.num_people = 1;
  for (const SyntheticTrial& trial : MakeSyntheticStudy(options)) {
    const ReachTrial reach = MakeReachTrial(trial);
    for (size_t d = 0; d < 5; ++d) {
      for (size_t i = 0; i < reach.times.size(); ++i) {
        const Eigen::Vector3d p_O =
            reach.object.X_LO[i].inverse() * Eigen::Vector3d(reach.digits[d].tip.At(i));
        const double clearance = reach.object.distance(p_O) - kSyntheticPadOffset;
        const double late = reach.times[i] - trial.truth.contacts[d];
        if (late >= 0.0) {
          ASSERT_NEAR(clearance, 0.0, 2e-6);  // coordinates are stored in 32 bits
        } else {
          ASSERT_GT(clearance, -2e-6) << "digit " << d << " at " << late;
          if (late < -0.004) {
            ASSERT_GT(clearance, 2e-5);
          }
        }
      }
    }
  }
}

TEST(SyntheticStudy, MovesAsPeopleDo) {
  SyntheticOptions options = MakeOptions();
  options.num_people = 10;
  std::vector<double> sizes, apertures, excess, peak_shares, preloads, formings;
  for (const SyntheticTrial& trial : MakeSyntheticStudy(options)) {
    const SyntheticTruth& truth = trial.truth;
    sizes.push_back(trial.diameter);
    apertures.push_back(truth.peak_aperture);
    excess.push_back(truth.peak_aperture - trial.diameter);
    peak_shares.push_back((truth.peak_aperture_time - truth.onset) / (Last(truth) - truth.onset));
    preloads.push_back(truth.lift_off - Last(truth));
    formings.push_back(Last(truth) - First(truth));
  }
  const double mean_size = CalcMoments(sizes).mean, mean_aperture = CalcMoments(apertures).mean;
  double covariance = 0.0;
  for (size_t i = 0; i < sizes.size(); ++i) {
    covariance += (sizes[i] - mean_size) * (apertures[i] - mean_aperture);
  }
  const double slope = covariance / CalcMoments(sizes).sum_of_squares;
  EXPECT_GT(slope, 0.7);
  EXPECT_LT(slope, 0.87);
  EXPECT_GT(CalcMoments(excess).mean, 0.015);
  EXPECT_LT(CalcMoments(excess).mean, 0.040);
  EXPECT_GT(CalcMoments(peak_shares).mean, 0.6);
  EXPECT_LT(CalcMoments(peak_shares).mean, 0.8);
  EXPECT_NEAR(CalcMoments(preloads).mean, 0.2, 0.02);
  EXPECT_NEAR(CalcMoments(formings).mean, 0.03, 0.012);
}

TEST(SyntheticStudy, TheFormingTimeIsWhatWasAsked) {
  SyntheticOptions options = MakeOptions();
  for (const double forming_time : {0.0, 0.03, 0.1}) {
    options.forming_time = forming_time;
    for (const SyntheticTrial& trial : MakeSyntheticStudy(options)) {
      EXPECT_NEAR(Last(trial.truth) - First(trial.truth), forming_time, 1e-12);
    }
  }
}

TEST(SyntheticStudy, DropoutsAreAsManyAndAsLongAsAsked) {
  SyntheticOptions options = MakeOptions();
  options.num_people = 10;
  options.dropouts_per_second = 0.5;
  options.dropout_duration = 0.05;
  double hidden = 0.0, all = 0.0;
  for (const SyntheticTrial& trial : MakeSyntheticStudy(options)) {
    hidden += static_cast<double>(trial.recording.points[0].CountStates(SampleState::kInvalid));
    all += static_cast<double>(trial.recording.num_frames);
    EXPECT_EQ(trial.recording.points[5].CountStates(SampleState::kInvalid), 0u);  // the wrist
  }
  EXPECT_NEAR(hidden / all, 0.025, 0.008);
}

TEST(SyntheticStudy, FilesHoldTheTrialsAndTheTruth) {
  SyntheticOptions options = MakeOptions();
  options.num_people = 1;
  options.trials_per_size = 1;
  options.has_force = true;
  options.dropouts_per_second = 1.0;
  const std::vector<SyntheticTrial> trials = MakeSyntheticStudy(options);
  const std::filesystem::path folder =
      std::filesystem::path(testing::TempDir()) / "graspbench_synthetic_study";
  for (const SyntheticFormat format : {SyntheticFormat::kC3d, SyntheticFormat::kQualisysTsv}) {
    std::filesystem::remove_all(folder);
    SaveSyntheticStudy(trials, format, folder);
    for (const SyntheticTrial& trial : trials) {
      const Recording read = LoadRecording(folder / SyntheticFileName(trial, format));
      ASSERT_EQ(read.points.size(), 9u);
      EXPECT_EQ(read.num_frames, trial.recording.num_frames);
      EXPECT_EQ(read.points[1].label, "index_tip");
      EXPECT_EQ(read.points[1].states, trial.recording.points[1].states);
      const size_t last = read.num_frames - 1;
      EXPECT_LT((read.points[6].Position(last) - trial.recording.points[6].Position(last)).norm(),
                1e-6);
      if (format == SyntheticFormat::kC3d) {
        ASSERT_EQ(read.analog.size(), 5u);
        EXPECT_EQ(read.analog[4].samples, trial.recording.analog[4].samples);
      }
    }
  }
  const std::string truth = ReadFile(folder / "truth.csv");
  EXPECT_EQ(
      truth.substr(0, truth.find('\n')),
      "file,person,trial,diameter_m,onset_s,movement_end_s,peak_opening_s,peak_aperture_m,"
      "peak_aperture_s,lift_off_s,release_s,contact_TH_s,contact_FF_s,contact_MF_s,contact_RF_s,"
      "contact_LF_s");
  EXPECT_EQ(std::count(truth.begin(), truth.end(), '\n'), 5);
  ExpectHolds(truth, "\nsub-01_trial-004.tsv,01,4,");
  std::filesystem::remove_all(folder);
}

TEST(SyntheticStudy, WhatIsNotLiftedIsHeldAndLeftTheWayItWasReached) {
  SyntheticOptions options = MakeOptions();
  options.noise = 0.0;
  options.push = 0.0;
  options.rate = 1000.0;
  options.num_people = 1;
  options.lifts = false;
  options.has_force = true;
  for (const bool rests : {true, false}) {
    options.rests = rests;
    for (const SyntheticTrial& trial : MakeSyntheticStudy(options)) {
      const SyntheticTruth& truth = trial.truth;
      EXPECT_TRUE(std::isnan(truth.lift_off));
      EXPECT_GT(truth.release, Last(truth) + 0.3);
      const ReachTrial reach = MakeReachTrial(trial);
      const auto tip_at = [&](size_t digit, double t) {
        return Eigen::Vector3d(reach.digits[digit].tip.At(std::lround(1000.0 * t)));
      };
      for (size_t d = 0; d < 5; ++d) {
        const Eigen::Vector3d held = tip_at(d, truth.release);
        EXPECT_LT((tip_at(d, truth.contacts[d]) - held).norm(), 2e-4);
        for (const double t : {0.1, 0.3, 0.6}) {  // a millisecond of rounding at 1 m/s
          EXPECT_LT((tip_at(d, truth.release + t) - tip_at(d, truth.contacts[d] - t)).norm(), 2e-3);
          EXPECT_GT((tip_at(d, truth.release + t) - held).norm(), 0.005 * t);
        }
        const double before = (tip_at(d, truth.onset - 0.1) - tip_at(d, truth.onset)).norm();
        const double after = (tip_at(d, truth.onset + 0.1) - tip_at(d, truth.onset)).norm();
        EXPECT_NEAR(before, rests ? 0.0 : after, 2e-3);
        const ForceChannel& force = reach.digits[d].force;
        EXPECT_LT(std::abs(force.values.back()), 0.1);
      }
    }
  }
}

TEST(SyntheticStudy, ImpossibleStudiesAreRefused) {
  const auto fault_of = [](const std::function<void(SyntheticOptions&)>& spoil) {
    SyntheticOptions options;
    spoil(options);
    return FaultOf([&] { MakeSyntheticStudy(options); });
  };
  EXPECT_EQ(fault_of([](SyntheticOptions& o) { o.num_digits = 6; }),
            "synthetic study: the number of digits must be 2 to 5");
  EXPECT_EQ(fault_of([](SyntheticOptions& o) { o.diameters = {}; }),
            "synthetic study: the list of diameters must be not empty");
  EXPECT_EQ(fault_of([](SyntheticOptions& o) { o.rate = 1e9; }),
            "synthetic study: the rate must be 20 to 2000 Hz");
  EXPECT_EQ(fault_of([](SyntheticOptions& o) { o.noise = std::nan(""); }),
            "synthetic study: the noise must be 0 to 0.01 m");
}

}  // namespace
}  // namespace graspbench
