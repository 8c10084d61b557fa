#include "human_study/events/trial_analysis.h"

#include <gtest/gtest.h>

#include <map>

#include "core/base/random.h"
#include "core/base/units.h"
#include "human_study/recording/cleaning/gaps.h"
#include "human_study/study/synthetic/synthetic_study.h"
#include "tests/human_study/events/trajectories.h"
#include "tests/human_study/faults.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;

/** Of one made-up study, kept for all tests. */
const SyntheticTrial& MakeOne(int num_digits = 5) {
  static std::map<int, SyntheticTrial> made;
  if (made.count(num_digits) == 0) {
    SyntheticOptions options;
    options.seed = "analysis";
    options.num_people = 1;
    options.trials_per_size = 1;
    options.num_digits = num_digits;
    options.has_force = true;
    made[num_digits] = MakeSyntheticStudy(options)[1];
  }
  return made.at(num_digits);
}

void ExpectSame(const TrialAnalysis& a, const TrialAnalysis& b, double tolerance) {
  for (const TrialMeasure& measure : TrialMeasureList()) {
    EXPECT_NEAR(measure.value(a), measure.value(b), tolerance) << measure.id;
  }
}

TEST(AnalyseTrial, FindsWhatTheTruthSays) {
  const SyntheticTrial& trial = MakeOne();
  const TrialAnalysis analysis = AnalyseTrial(MakeReachTrial(trial), AnalysisOptions());
  const SyntheticTruth& truth = trial.truth;
  EXPECT_NEAR(analysis.object.lift_off.time, truth.lift_off, 0.05);
  EXPECT_NEAR(analysis.movement.onset.time, truth.onset, 0.08);
  EXPECT_NEAR(analysis.movement.end.time, truth.movement_end, 0.08);
  EXPECT_NEAR(analysis.closure_start.time, truth.peak_opening, 0.015);
  ASSERT_EQ(analysis.contacts.size(), 5u);
  for (size_t d = 0; d < 5; ++d) {
    EXPECT_NEAR(analysis.contacts[d].contact.time, truth.contacts[d], 0.015);
    EXPECT_LT(analysis.contacts[d].disagreement, 0.08);
    for (const EventTime& event : analysis.contacts[d].by_detector) {
      EXPECT_TRUE(event.IsFound()) << event.missing;
    }
  }
  EXPECT_EQ(analysis.num_touching, 5);
  EXPECT_GE(analysis.timing.gct, analysis.timing.gft);
  EXPECT_GE(analysis.timing.gft, analysis.timing.got);
  const double first_finger = *std::min_element(truth.contacts.begin() + 1, truth.contacts.end());
  for (const TrialMeasure& measure : TrialMeasureList()) {
    if (std::string(measure.id) != "opposing_lag_s") continue;
    EXPECT_NEAR(measure.value(analysis), first_finger - truth.contacts[0], 0.015);
    EXPECT_NEAR(std::abs(measure.value(analysis)), analysis.timing.got, 1e-12);
  }
  EXPECT_GT(analysis.gft_uncertainty, 0.001);
  EXPECT_LT(analysis.gft_uncertainty, 0.02);
  EXPECT_GT(analysis.closure_start_value, analysis.final_opening);
  EXPECT_FALSE(analysis.used_filled);
  EXPECT_FALSE(analysis.used_gap);
}

/** The thumb's channel becomes a switch that closes at `closing`. */
ReachTrial MakeSwitched(const SyntheticTrial& trial, double closing, double open, double closed) {
  ReachTrial reach = MakeReachTrial(trial);
  ForceChannel& force = reach.digits[0].force;
  for (size_t i = 0; i < force.times.size(); ++i) {
    force.values[i] = force.times[i] < closing ? open : closed;
  }
  return reach;
}

// A switch has no filter: the instant lies between two of its samples.
TEST(AnalyseTrial, ATouchSwitchTellsTheInstantItStaysClosed) {
  const SyntheticTrial& trial = MakeOne();
  const double closing = trial.truth.contacts[0];
  const size_t detector = FindContactDetector("force");
  for (const auto& [open, closed] : {std::pair(0.0, 1.0), {5.0, 0.02}, {-3.0, -2.0}}) {
    ReachTrial reach = MakeSwitched(trial, closing, open, closed);
    ForceChannel& force = reach.digits[0].force;
    const double interval = force.times[1] - force.times[0];
    const auto find = [&] {
      return AnalyseTrial(reach, AnalysisOptions()).contacts[0].by_detector[detector];
    };
    EXPECT_NEAR(find().time, closing, interval) << open;
    EXPECT_LT(find().uncertainty, 2.0 * interval);
    // Bounces after the closing, and a touch that was let go of before it.
    for (size_t i = 0; i < force.times.size(); ++i) {
      const double after = force.times[i] - closing;
      if (after > 0.006 && after < 0.009) force.values[i] = open;
      if (after > -0.08 && after < -0.05) force.values[i] = closed;
    }
    EXPECT_NEAR(find().time, closing, interval) << open;
    // Open again in the hold: it touched nothing there.
    for (size_t i = 0; i < force.times.size(); ++i) {
      if (force.times[i] > trial.truth.lift_off - 0.05) force.values[i] = open;
    }
    EXPECT_EQ(find().missing, "the touch switch is open in the hold");
  }
  // Never closed: no switch, and no force that rises.
  const ReachTrial never = MakeSwitched(trial, INFINITY, 1.0, 0.0);
  EXPECT_FALSE(AnalyseTrial(never, AnalysisOptions()).contacts[0].by_detector[detector].IsFound());
}

/** Every measure and what the tables print beside them, with the same bits. */
void ExpectEqual(const TrialAnalysis& a, const TrialAnalysis& b, const std::string& what) {
  const auto is_same = [](double x, double y) {
    return x == y || (std::isnan(x) && std::isnan(y));
  };
  for (const TrialMeasure& measure : TrialMeasureList()) {
    EXPECT_TRUE(is_same(measure.value(a), measure.value(b))) << what << ", " << measure.id;
  }
  EXPECT_TRUE(is_same(a.gft_uncertainty, b.gft_uncertainty)) << what;
  EXPECT_TRUE(is_same(a.got_uncertainty, b.got_uncertainty)) << what;
  EXPECT_TRUE(is_same(a.gct_uncertainty, b.gct_uncertainty)) << what;
  EXPECT_EQ(a.order.Format(), b.order.Format()) << what;
  EXPECT_EQ(a.used_filled, b.used_filled) << what;
  EXPECT_EQ(a.used_gap, b.used_gap) << what;
}

TEST(AnalyseTrial, ManyOptionsOfOneTrialGiveWhatEachAloneWould) {
  SyntheticOptions synthetic;
  synthetic.seed = "shared";
  synthetic.num_people = 1;
  synthetic.trials_per_size = 1;
  synthetic.dropouts_per_second = 2.0;
  synthetic.has_force = true;
  for (const SyntheticTrial& made : MakeSyntheticStudy(synthetic)) {
    ReachTrial trial = MakeReachTrial(made);
    // The thumb's contact falls into a gap for all detectors but the force's, which comes last.
    HideSamples(trial.digits[0].tip, made.truth.contacts[0] - 0.02, made.truth.contacts[0] + 0.02);
    FilteredTrial filtered(trial);
    for (const double cutoff : {20.0, 10.0}) {
      for (const char* opening : {"virtual_finger", "aperture"}) {
        AnalysisOptions options;
        options.contact.cutoff = cutoff;
        options.opening.measure = opening;
        TrialAnalysis shared = AnalyseTrial(filtered, options);
        for (const ContactDetector& detector : ContactDetectorList()) {
          options.contact.detector = detector.id;
          BelieveDetector(detector.id, options, shared);
          ExpectEqual(shared, AnalyseTrial(trial, options), detector.id);
        }
      }
    }
  }
}

TEST(AnalyseTrial, AShiftInTimeShiftsEventsAndLeavesMeasures) {
  const ReachTrial trial = MakeReachTrial(MakeOne());
  ReachTrial shifted = trial;
  const auto shift = [](std::vector<double>& times) {
    for (double& time : times) time += 16.0;  // exact in binary for these times
  };
  shift(shifted.times);
  shift(shifted.wrist.times);
  for (DigitTrack& digit : shifted.digits) {
    shift(digit.tip.times);
    shift(digit.force.times);
  }
  const TrialAnalysis a = AnalyseTrial(trial, AnalysisOptions());
  const TrialAnalysis b = AnalyseTrial(shifted, AnalysisOptions());
  ExpectSame(a, b, 1e-6);
  EXPECT_NEAR(b.movement.onset.time, a.movement.onset.time + 16.0, 1e-6);
  for (size_t d = 0; d < 5; ++d) {
    for (size_t k = 0; k < ContactDetectorList().size(); ++k) {
      EXPECT_NEAR(b.contacts[d].by_detector[k].time, a.contacts[d].by_detector[k].time + 16.0, 1e-6)
          << ContactDetectorList()[k].id;
    }
  }
}

TEST(AnalyseTrial, AnotherLaboratoryFrameChangesNothing) {
  const ReachTrial trial = MakeReachTrial(MakeOne());
  const Pose X = MakePose(MakeRotationRpy(0.4, -0.7, 2.0), Vector3d(1, -2, 0.5));
  ReachTrial moved = trial;
  const auto move = [&](Trajectory& path) {
    for (Eigen::Index i = 0; i < path.p.cols(); ++i) path.p.col(i) = X * Vector3d(path.p.col(i));
  };
  move(moved.wrist);
  for (DigitTrack& digit : moved.digits) move(digit.tip);
  for (Pose& pose : moved.object.X_LO) pose = X * pose;
  AnalysisOptions options;
  const Vector3d up = X.linear().col(2);
  options.lift_off.up_x = up.x();
  options.lift_off.up_y = up.y();
  options.lift_off.up_z = up.z();
  ExpectSame(AnalyseTrial(trial, AnalysisOptions()), AnalyseTrial(moved, options), 1e-5);
}

TEST(AnalyseTrial, MillimetresAndMetresGiveTheSame) {
  SyntheticTrial trial = MakeOne();
  const TrialAnalysis in_mm = AnalyseTrial(MakeReachTrial(trial), AnalysisOptions());
  for (RecordedPoint& point : trial.recording.points) {
    point.unit = "m";
    point.metres_per_unit = 1.0;
    for (float& value : point.xyz) value = static_cast<float>(MFromMm(static_cast<double>(value)));
  }
  ExpectSame(in_mm, AnalyseTrial(MakeReachTrial(trial), AnalysisOptions()), 1e-5);
}

TEST(AnalyseTrial, ADigitThatHoversIsMissingNotLate) {
  ReachTrial trial = MakeReachTrial(MakeOne());
  DigitTrack& little = trial.digits[4];
  for (size_t i = 0; i < trial.times.size(); ++i) {
    // 30 mm farther out, moving with the object.
    const Vector3d out = trial.object.X_LO[i].linear() * Vector3d(0.03, 0, 0);
    little.tip.At(i) += out;
  }
  const TrialAnalysis analysis = AnalyseTrial(trial, AnalysisOptions());
  EXPECT_EQ(analysis.contacts[4].contact.missing.substr(0, 26), "in the hold its marker is ");
  EXPECT_EQ(analysis.num_touching, 4);
  EXPECT_FALSE(std::isnan(analysis.timing.gft));
  EXPECT_TRUE(std::isnan(analysis.timing_all.gft));
  EXPECT_FALSE(std::isnan(analysis.timing_all.got));
  EXPECT_EQ(analysis.order.FindRank("LF"), 0);
  EXPECT_GT(analysis.order.FindRank("RF"), 0);
}

TEST(AnalyseTrial, AHiddenThumbMakesOppositionMissing) {
  ReachTrial trial = MakeReachTrial(MakeOne());
  HideSamples(trial.digits[0].tip, 0.8, 10.0);
  trial.digits[0].force = ForceChannel();
  const TrialAnalysis analysis = AnalyseTrial(trial, AnalysisOptions());
  EXPECT_EQ(analysis.contacts[0].contact.missing, "the digit is hidden in the hold");
  EXPECT_TRUE(std::isnan(analysis.timing.got));
  EXPECT_TRUE(std::isnan(analysis.got_uncertainty));
  EXPECT_FALSE(std::isnan(analysis.timing.gft));
}

TEST(AnalyseTrial, AContactInAGapSaysSoFilledOrNot) {
  const SyntheticTrial& synthetic = MakeOne();
  ReachTrial trial = MakeReachTrial(synthetic);
  const double contact = synthetic.truth.contacts[1];
  HideSamples(trial.digits[1].tip, contact - 0.03, contact + 0.03);
  const TrialAnalysis open = AnalyseTrial(trial, AnalysisOptions());
  EXPECT_TRUE(open.used_gap);
  EXPECT_TRUE(open.contacts[1].contact.is_in_gap);
  const TrialAnalysis seen = AnalyseTrial(MakeReachTrial(synthetic), AnalysisOptions());
  EXPECT_GT(open.contacts[1].contact.uncertainty, 2.0 * seen.contacts[1].contact.uncertainty);
  EXPECT_LT(std::abs(open.contacts[1].contact.time - contact), 0.04);

  FillGaps(trial.digits[1].tip, 0.1);
  const TrialAnalysis filled = AnalyseTrial(trial, AnalysisOptions());
  EXPECT_TRUE(filled.used_filled || filled.used_gap);
  for (const EventTime& event : filled.contacts[1].by_detector) {
    const bool is_force = &event == &filled.contacts[1].by_detector[FindContactDetector("force")];
    EXPECT_EQ(event.is_filled || event.is_in_gap, !is_force);
  }
}

// What the object or the tip did meanwhile nobody saw, so no time is told, however well a curve runs
// across.
TEST(AnalyseTrial, AContactInALongGapIsNotTold) {
  const SyntheticTrial& trial = MakeOne();
  const double contact = trial.truth.contacts[0];
  for (const bool hides_object : {false, true}) {
    ReachTrial reach = MakeReachTrial(trial);
    if (hides_object) {
      for (size_t i = 0; i < reach.times.size(); ++i) {
        if (std::abs(reach.times[i] - contact) < 0.2) {
          reach.object.states[i] = SampleState::kInvalid;
        }
      }
    } else {
      HideSamples(reach.digits[0].tip, contact - 0.2, contact + 0.2);
    }
    const TrialAnalysis analysis = AnalyseTrial(reach, AnalysisOptions());
    const EventTime& event = analysis.contacts[0].contact;
    EXPECT_FALSE(event.IsFound()) << event.time << " for " << contact;
    EXPECT_NE(event.missing, "");
    // Nobody knows whether it was the first or the last.
    EXPECT_GT(analysis.num_unresolved, 0) << event.missing;
    EXPECT_TRUE(std::isnan(analysis.timing.gft));
    EXPECT_TRUE(std::isnan(analysis.timing.got));
    EXPECT_TRUE(std::isnan(analysis.final_opening));
  }
}

TEST(AnalyseTrial, TwoDigitsOppositionIsForming) {
  const TrialAnalysis analysis = AnalyseTrial(MakeReachTrial(MakeOne(2)), AnalysisOptions());
  EXPECT_EQ(analysis.timing.gft, analysis.timing.got);
  EXPECT_EQ(analysis.gft_uncertainty, analysis.got_uncertainty);
}

TEST(AnalyseTrial, WithoutObjectAndWristTheHandAloneIsAnalysed) {
  const SyntheticTrial& synthetic = MakeOne(2);
  ReachTrial trial = MakeReachTrial(synthetic);
  trial.object = ObjectTrack();
  trial.wrist = Trajectory();
  // Until just before the lift, as such studies are cut.
  const size_t count = FindSamples(trial.times, 0.0, synthetic.truth.lift_off).last;
  trial.times.resize(count);
  for (DigitTrack& digit : trial.digits) {
    digit.tip.times.resize(count);
    digit.tip.states.resize(count);
    digit.tip.p.conservativeResize(3, static_cast<Eigen::Index>(count));
  }
  const TrialAnalysis analysis = AnalyseTrial(trial, AnalysisOptions());
  EXPECT_EQ(analysis.object.lift_off.missing, "the object was not recorded");
  ASSERT_TRUE(analysis.movement.end.IsFound()) << analysis.movement.end.missing;
  EXPECT_NEAR(analysis.contacts[0].contact.time, synthetic.truth.contacts[0], 0.05);
  EXPECT_EQ(analysis.contacts[0].by_detector[FindContactDetector("surface")].missing,
            "the object's pose or shape is not known");
}

TEST(AnalyseTrial, AHandThatNeverMovesHasNoEventsAndNoError) {
  ReachTrial trial = MakeReachTrial(MakeOne());
  for (DigitTrack& digit : trial.digits) {
    digit.tip = SamplePath(trial.times, [](double) { return Vector3d(0.1, 0.2, 0.3); });
  }
  trial.wrist = trial.digits[0].tip;
  trial.object = ObjectTrack();
  const TrialAnalysis analysis = AnalyseTrial(trial, AnalysisOptions());
  EXPECT_FALSE(analysis.movement.onset.IsFound());
  EXPECT_EQ(analysis.num_touching, 0);
  for (const TrialMeasure& measure : TrialMeasureList()) {
    const double value = measure.value(analysis);
    EXPECT_TRUE(!(value > 1e-9)) << measure.id << " " << value;
  }
}

void ExpectWhole(const EventTime& event, const std::string& what) {
  // A contact that is known badly has a time and says so.
  const bool is_wide = IsUnresolved(event) && std::isfinite(event.time);
  EXPECT_EQ(std::isfinite(event.time), event.missing.empty() || is_wide)
      << what << ": " << event.missing;
  if (event.IsFound()) {
    EXPECT_GT(event.uncertainty, 0.0) << what;
    EXPECT_TRUE(std::isfinite(event.uncertainty)) << what;
  }
}

TEST(AnalyseTrial, SpoiltTrialsGiveAnswersOrReasonsAndNeverFail) {
  const ReachTrial good = MakeReachTrial(MakeOne());
  RandomStream random("spoilt", "trials");
  for (int round = 0; round < 150; ++round) {
    ReachTrial trial = good;
    AnalysisOptions options;
    const std::vector<MovementRule>& rules = MovementRuleList();
    options.movement.rule = rules[static_cast<size_t>(random.NextIndex(6))].id;
    const std::vector<HandOpening>& openings = HandOpeningList();
    options.opening.measure =
        openings[static_cast<size_t>(random.NextIndex(static_cast<int>(openings.size())))].id;
    options.opening.maximum = random.NextUnit() < 0.5 ? "largest" : "last";
    const double noise = random.NextUnit() < 0.3 ? 0.02 * random.NextUnit() : 0.0;
    const double end = trial.times.back();
    for (DigitTrack& digit : trial.digits) {
      for (double& value : digit.tip.p.reshaped()) value += noise * random.NextNormal();
      while (random.NextUnit() < 0.5) {
        const double begin = random.NextUniform(0.0, end);
        HideSamples(digit.tip, begin, begin + random.NextUniform(0.0, 0.5));
      }
      if (random.NextUnit() < 0.3) FillGaps(digit.tip, 0.2);
      if (random.NextUnit() < 0.2) HideSamples(digit.tip, 0.0, end);
      if (random.NextUnit() < 0.2)
        digit.force.values.assign(digit.force.values.size(), std::nan(""));
    }
    if (random.NextUnit() < 0.3) HideSamples(trial.wrist, random.NextUniform(0.0, end), end);
    if (random.NextUnit() < 0.2) trial.object = ObjectTrack();
    for (SampleState& state : trial.object.states) {
      if (random.NextUnit() < 0.02) state = SampleState::kInvalid;
    }
    const TrialAnalysis analysis = AnalyseTrial(trial, options);
    ExpectWhole(analysis.movement.onset, "onset");
    ExpectWhole(analysis.movement.end, "end");
    ExpectWhole(analysis.object.moved, "moved");
    ExpectWhole(analysis.object.lift_off, "lift-off");
    ExpectWhole(analysis.closure_start, "closure start");
    for (const DigitContactEvents& digit : analysis.contacts) {
      for (size_t k = 0; k < digit.by_detector.size(); ++k) {
        ExpectWhole(digit.by_detector[k], digit.digit + " by " + ContactDetectorList()[k].id +
                                              " in " + std::to_string(round));
      }
    }
  }
}

// Three tenths to four tenths of the rate: below the filter's limit.
TEST(FitCutoffs, LowersWhatNobodyStatedForASlowRecordingAlone) {
  const AnalysisOptions defaults;
  for (const double rate : {60.0, 100.0, 200.0, 1000.0}) {
    EXPECT_EQ(ListCutoffs(FitCutoffs(defaults, rate)), ListCutoffs(defaults)) << rate;
  }
  for (const double rate : {10.0, 25.0, 30.0, 50.0}) {
    const AnalysisOptions fitted = FitCutoffs(defaults, rate);
    EXPECT_EQ(FindCutoffFault(ListCutoffs(fitted), rate), "") << rate;
    EXPECT_GT(fitted.contact.cutoff, 0.3 * rate);
  }
  AnalysisOptions stated;
  stated.stated_cutoffs = {"contact.cutoff_hz", "opening.cutoff_hz"};
  const AnalysisOptions fitted = FitCutoffs(stated, 20.0);
  EXPECT_EQ(fitted.contact.cutoff, stated.contact.cutoff);
  EXPECT_LT(fitted.contact.object_cutoff, 8.0);
  EXPECT_EQ(FindCutoffFault(ListCutoffs(fitted), 20.0),
            "opening.cutoff_hz is 10, contact.cutoff_hz is 20; this recording of 20 Hz allows less "
            "than 8. Choose a lower one, or leave the key out: the cut-off then follows the rate");
}

TEST(AnalyseTrial, ACutoffThatTheRateDoesNotAllowNamesItsKey) {
  SyntheticOptions options;
  options.num_people = options.trials_per_size = 1;
  options.rate = 40.0;
  const ReachTrial trial = MakeReachTrial(MakeSyntheticStudy(options)[0]);
  EXPECT_EQ(
      FaultOf([&] { AnalyseTrial(trial, AnalysisOptions()); }),
      "contact.cutoff_hz is 20; this recording of 40 Hz allows less than 16. Choose a lower one, "
      "or leave the key out: the cut-off then follows the rate");
}

TEST(CheckOptions, NamesTheKeyAndTheChoices) {
  const auto fault_of = [](void (*spoil)(AnalysisOptions&)) {
    AnalysisOptions options;
    spoil(options);
    return FaultOf([&] { CheckOptions(options); });
  };
  EXPECT_EQ(fault_of([](AnalysisOptions&) {}), "");
  const std::pair<void (*)(AnalysisOptions&), const char*> wrong[] = {
      {[](AnalysisOptions& o) { o.contact.detector = "sped"; },
       "no contact detector \"sped\"; did you mean \"speed\"?"},
      {[](AnalysisOptions& o) { o.hold.rule = "multiplid"; },
       "no hold rule \"multiplid\"; did you mean \"multiplied\"?"},
      {[](AnalysisOptions& o) { o.movement.rule = "treshold"; }, "did you mean \"threshold\"?"},
      {[](AnalysisOptions& o) { o.lift_off.rule = "rises"; }, "did you mean \"rise\"?"},
      {[](AnalysisOptions& o) { o.opening.maximum = "first"; }, "opening.maximum is \"first\""},
      {[](AnalysisOptions& o) { o.contact.cutoff = -1.0; },
       "contact.cutoff_hz is -1; expected above 0"},
      {[](AnalysisOptions& o) { o.hold.cutoff = NAN; }, "hold.cutoff_hz is nan; expected above 0"},
      {[](AnalysisOptions& o) { o.lift_off.up_z = 0.0; },
       "lift_off.up_z is 0, up_x 0 and up_y 0, which is no direction"}};
  for (const auto& [spoil, says] : wrong) ExpectHolds(fault_of(spoil), says);
}

}  // namespace
}  // namespace graspbench
