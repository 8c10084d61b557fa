#include <gtest/gtest.h>

#include <cmath>

#include "core/base/error.h"
#include "core/base/random.h"
#include "core/base/units.h"
#include "human_study/recording/cleaning/butterworth.h"
#include "human_study/recording/cleaning/gaps.h"
#include "human_study/recording/cleaning/trajectory.h"
#include "human_study/recording/importers/importer.h"
#include "tests/human_study/events/trajectories.h"
#include "tests/support/mocap_data.h"

namespace graspbench {
namespace {

std::vector<double> EvenTimes(double rate, size_t count) {
  std::vector<double> times;
  for (size_t i = 0; i < count; ++i) times.push_back(static_cast<double>(i) / rate);
  return times;
}

void Hide(Trajectory& trajectory, size_t first, size_t last) {
  for (size_t i = first; i < last; ++i) {
    trajectory.states[i] = SampleState::kInvalid;
    trajectory.At(i).setConstant(std::nan(""));
  }
}

Eigen::VectorXd Sine(double frequency, double rate, Eigen::Index count) {
  Eigen::VectorXd signal(count);
  for (Eigen::Index n = 0; n < count; ++n) {
    signal[n] = std::sin(2 * kPi * frequency * static_cast<double>(n) / rate);
  }
  return signal;
}

TEST(FillGaps, AParabolaIsFilledExactlyByTheCubic) {
  // A cubic through a parabola's points and one-sided velocities errs by the velocities' error
  // only.
  const auto line = [](double t) { return Eigen::Vector3d(t, -2 * t, 3); };
  Trajectory trajectory = SamplePath(EvenTimes(100, 50), line);
  Hide(trajectory, 20, 25);
  const GapReport report = FillGaps(trajectory, 0.06);
  EXPECT_EQ(report.num_filled_samples, 5u);
  EXPECT_NEAR(report.longest_filled, 0.06, 1e-12);
  for (size_t i = 20; i < 25; ++i) {
    EXPECT_EQ(trajectory.states[i], SampleState::kFilled);
    EXPECT_LT((trajectory.At(i) - line(trajectory.times[i])).norm(), 1e-14);
  }
}

TEST(FillGaps, TheCubicHasNoCornerWhereTheLineHasOne) {
  const auto curve = [](double t) {
    return Eigen::Vector3d(std::sin(10 * t), std::cos(10 * t), 0);
  };
  double worst[2] = {0, 0};
  for (const GapFilling filling : {GapFilling::kLinear, GapFilling::kCubic}) {
    Trajectory trajectory = SamplePath(EvenTimes(100, 100), curve);
    Hide(trajectory, 40, 50);
    FillGaps(trajectory, 0.2, filling);
    for (size_t i = 40; i < 50; ++i) {
      double& error = worst[filling == GapFilling::kCubic];
      error = std::max(error, (trajectory.At(i) - curve(trajectory.times[i])).norm());
    }
  }
  EXPECT_GT(worst[0], 0.1);
  EXPECT_LT(worst[1], 0.02);
}

TEST(FillGapsAlong, TheTipFollowsItsCompanionAndMeasuredSamplesStay) {
  const auto companion_at = [](double t) {
    return Eigen::Vector3d(0.1 * std::sin(20.0 * t), 0.2 * t * t, 0.0);
  };
  const auto tip_at = [&](double t) {
    return Eigen::Vector3d(companion_at(t) + Eigen::Vector3d(0.03, 0.01 * t, 0.0));
  };
  const std::vector<double> times = MakeTimes(0.0, 2.0, 100.0);
  const Trajectory companion = SamplePath(times, companion_at), whole = SamplePath(times, tip_at);
  Trajectory tip = whole;
  HideSamples(tip, 0.495, 0.705);  // short enough
  HideSamples(tip, 1.195, 1.605);  // too long
  HideSamples(tip, 1.895, 2.005);  // at the end
  EXPECT_EQ(FillGapsAlong(tip, companion, 0.3), 21u);
  for (size_t i = 0; i < times.size(); ++i) {
    const bool is_open = (times[i] > 1.195 && times[i] < 1.605) || times[i] > 1.895;
    const bool is_filled = times[i] > 0.495 && times[i] < 0.705;
    EXPECT_EQ(tip.states[i], is_open     ? SampleState::kInvalid
                             : is_filled ? SampleState::kFilled
                                         : SampleState::kMeasured);
    const auto column = static_cast<Eigen::Index>(i);
    if (!is_open) {
      EXPECT_LT((tip.p.col(column) - whole.p.col(column)).norm(), is_filled ? 1e-12 : 1e-300);
    }
  }
}

TEST(FillGapsAlong, WhereTheCompanionIsHiddenTheGapStays) {
  const std::vector<double> times = MakeTimes(0.0, 1.0, 100.0);
  const auto path = [](double t) { return Eigen::Vector3d(t, 0, 0); };
  Trajectory tip = SamplePath(times, path), companion = SamplePath(times, path);
  HideSamples(tip, 0.395, 0.505);
  HideSamples(companion, 0.445, 0.605);
  EXPECT_EQ(FillGapsAlong(tip, companion, 0.3), 5u);
  EXPECT_EQ(tip.states[44], SampleState::kFilled);
  EXPECT_EQ(tip.states[45], SampleState::kInvalid);
  EXPECT_EQ(tip.states[55], SampleState::kMeasured);
}

TEST(FillGaps, LongGapsAndEndsStayOpenAndMeasuredSamplesStay) {
  const auto line = [](double t) { return Eigen::Vector3d(t, t, t); };
  Trajectory trajectory = SamplePath(EvenTimes(100, 50), line);
  Hide(trajectory, 0, 2);
  Hide(trajectory, 20, 26);
  Hide(trajectory, 49, 50);
  const GapReport report = FillGaps(trajectory, 0.06);
  EXPECT_EQ(report.num_filled_gaps, 0u);
  EXPECT_EQ(report.num_open_gaps, 3u);
  EXPECT_NEAR(report.longest_open, 0.07, 1e-12);
  EXPECT_EQ(FindGaps(trajectory).size(), 3u);
}

TEST(FrozenSamples, RepeatsAreHiddenTheFirstIsKept) {
  Trajectory trajectory =
      SamplePath(EvenTimes(100, 10), [](double t) { return Eigen::Vector3d(t, 0, 0); });
  trajectory.p.col(4) = trajectory.p.col(5) = trajectory.p.col(3);
  trajectory.p.col(8) = trajectory.p.col(7);
  Trajectory copy = trajectory;
  EXPECT_EQ(InvalidateFrozenSamples(trajectory), 3u);
  EXPECT_TRUE(trajectory.IsValid(3));
  EXPECT_FALSE(trajectory.IsValid(5));
  EXPECT_EQ(InvalidateFrozenSamples(copy, 2), 2u);
  EXPECT_TRUE(copy.IsValid(8));
}

TEST(FrozenSamples, ARoundedMarkerAtRestIsKept) {
  // Rests 0.2 s, moves 0.3 m in 0.5 s, rests; in whole millimetres.
  const auto path = [](double t) {
    const double x = 0.3 * Ease(t, 0.2, 0.7);
    return Eigen::Vector3d(0.001 * std::round(1000.0 * x), 0.1, 0);
  };
  Trajectory rest = SamplePath(EvenTimes(200, 180), path);
  Trajectory held = rest;
  EXPECT_EQ(InvalidateFrozenSamples(rest), 0u);
  for (Eigen::Index i = 91; i < 100; ++i) held.p.col(i) = held.p.col(90);  // at full speed
  EXPECT_EQ(InvalidateFrozenSamples(held), 9u);
  // Lost in the middle of the reach and never seen again.
  Trajectory lost = SamplePath(EvenTimes(200, 180), path);
  for (Eigen::Index i = 91; i < 180; ++i) lost.p.col(i) = lost.p.col(90);
  EXPECT_EQ(InvalidateFrozenSamples(lost), 89u);
}

/** A reach of 0.4 m in 0.8 s at 100 Hz (minimum jerk) with noise of 0.3 mm. */
Trajectory MakeNoisyReach() {
  RandomStream random("spikes", "noise");
  return SamplePath(EvenTimes(100, 200), [&](double t) {
    const Eigen::Vector3d way(0.4 * Ease(t, 0.5, 1.3), 0.0, 0.0);
    const Eigen::Vector3d noise(random.NextNormal(), random.NextNormal(), random.NextNormal());
    return Eigen::Vector3d(way + 0.3e-3 * noise);
  });
}

TEST(InvalidateSpikes, TakesWhatWasPutInAndNothingElse) {
  Trajectory path = MakeNoisyReach();
  for (const int at : {30, 70, 71, 95, 150}) path.p(at % 3, at) += 0.03;  // two in a row, too
  EXPECT_EQ(InvalidateSpikes(path), 5u);
  for (size_t i = 0; i < path.size(); ++i) {
    const bool is_spike = i == 30 || i == 70 || i == 71 || i == 95 || i == 150;
    EXPECT_EQ(path.IsValid(i), !is_spike) << i;
    EXPECT_EQ(std::isnan(path.p(0, static_cast<Eigen::Index>(i))), is_spike) << i;
  }
}

TEST(InvalidateSpikes, LeavesReachesJumpsThatStayAndNoiseAlone) {
  Trajectory path = MakeNoisyReach();
  EXPECT_EQ(InvalidateSpikes(path), 0u);
  for (int i = 120; i < 200; ++i) path.p(1, i) += 0.05;  // labels exchanged
  EXPECT_EQ(InvalidateSpikes(path), 0u);
  RandomStream random("spikes", "coarse");
  for (int i = 0; i < 200; ++i) path.p(2, i) += 5e-3 * random.NextNormal();
  EXPECT_EQ(InvalidateSpikes(path), 0u);
}

TEST(Resample, AStraightLineIsKeptAndHolesStayHoles) {
  const auto line = [](double t) { return Eigen::Vector3d(2 * t, 1 - t, 0); };
  Trajectory trajectory = SamplePath({0.0, 0.011, 0.019, 0.033, 0.1, 0.11, 0.12}, line);
  trajectory.states[5] = SampleState::kFilled;
  EXPECT_FALSE(FindSampling(trajectory.times).is_even);
  const Trajectory even = Resample(trajectory, 100.0, 0.02);
  ASSERT_EQ(even.size(), 13u);
  for (size_t i = 0; i < even.size(); ++i) {
    const bool in_hole = i >= 4 && i <= 9;
    EXPECT_EQ(even.IsValid(i), !in_hole) << i;
    if (even.IsValid(i)) {
      EXPECT_LT((even.At(i) - line(even.times[i])).norm(), 1e-12);
    }
  }
  EXPECT_EQ(even.states[11], SampleState::kFilled);
  EXPECT_EQ(even.states[12], SampleState::kMeasured);
  EXPECT_TRUE(FindSampling(even.times).is_even);
}

TEST(Butterworth, TheCutoffIsWhereItWasAskedFor) {
  for (const double cutoff : {6.0, 10.0, 20.0}) {
    const Biquad pass = MakeLowPass(cutoff, 200.0);
    const Eigen::VectorXd in = Sine(cutoff, 200.0, 4000);
    const Eigen::VectorXd out = FilterZeroPhase(pass, in);
    const double gain = out.segment(1000, 2000).norm() / in.segment(1000, 2000).norm();
    EXPECT_NEAR(gain, std::sqrt(0.5), 1e-3) << cutoff;
    // Zero phase: what remains is the signal itself, smaller.
    EXPECT_LT((out - gain * in).segment(1000, 2000).cwiseAbs().maxCoeff(), 1e-3);
  }
}

TEST(Butterworth, ConstantsAndRampsPassUnchanged) {
  const Biquad pass = MakeLowPass(10.0, 100.0);
  const Eigen::VectorXd ramp = Eigen::VectorXd::LinSpaced(300, -1.0, 5.0);
  EXPECT_LT((FilterZeroPhase(pass, ramp) - ramp).cwiseAbs().maxCoeff(), 1e-4);
  const Eigen::VectorXd constant = Eigen::VectorXd::Constant(50, 3.25);
  EXPECT_LT((FilterZeroPhase(pass, constant) - constant).cwiseAbs().maxCoeff(), 1e-12);
}

// The recursion as butterworth.h states it, signal by signal, over the ends' point reflections.
TEST(Butterworth, SignalsSideBySideAreFilteredAsEachAlone) {
  const Biquad f = MakeLowPass(15.0, 200.0);
  const auto run = [&](std::vector<double> x) {
    std::vector<double> y;
    for (size_t n = 0; n < x.size(); ++n) {
      const auto in = [&](size_t back) { return n < back ? x[0] : x[n - back]; };
      const auto out = [&](size_t back) { return n < back ? x[0] : y[n - back]; };
      y.push_back(f.b0 * in(0) + f.b1 * in(1) + f.b2 * in(2) - f.a1 * out(1) - f.a2 * out(2));
    }
    return std::vector<double>(y.rbegin(), y.rend());
  };
  const Eigen::Matrix3Xd signals = Eigen::Matrix3Xd::Random(3, 150);
  const Eigen::Matrix3Xd found = FilterZeroPhase(f, signals);
  // Farther out than the filter remembers, a longer reflection changes nothing.
  constexpr Eigen::Index kPad = 149;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> x;
    for (Eigen::Index i = kPad; i > 0; --i) x.push_back(2.0 * signals(axis, 0) - signals(axis, i));
    for (Eigen::Index i = 0; i < 150; ++i) x.push_back(signals(axis, i));
    for (Eigen::Index i = 0; i < kPad; ++i) {
      x.push_back(2.0 * signals(axis, 149) - signals(axis, 148 - i));
    }
    const std::vector<double> expected = run(run(x));
    for (Eigen::Index i = 0; i < 150; ++i) {
      EXPECT_NEAR(found(axis, i), expected[static_cast<size_t>(kPad + i)], 2e-5) << axis << i;
    }
    EXPECT_EQ(found.row(axis), FilterZeroPhase(f, Eigen::VectorXd(signals.row(axis))).transpose());
  }
}

TEST(Butterworth, RiseTimesOfTheCorrectedPair) {
  // 10 to 90 %, in ms, computed independently for these cut-offs.
  const std::pair<double, double> known[] = {{6, 60},  {8, 45},  {10, 36},
                                             {12, 30}, {15, 24}, {20, 18}};
  const double rate = 10000.0;
  Eigen::VectorXd step = Eigen::VectorXd::Zero(10000);
  step.tail(5000).setOnes();
  for (const auto& [cutoff, rise_ms] : known) {
    const Eigen::VectorXd out = FilterZeroPhase(MakeLowPass(cutoff, rate), step);
    Eigen::Index low = 5000, high = 5000;
    while (out[low] > 0.1) --low;
    while (out[high] < 0.9) ++high;
    EXPECT_NEAR(static_cast<double>(high - low) / rate * 1e3, rise_ms, 0.5) << cutoff;
  }
}

TEST(Butterworth, WrongCutoffsAndUnevenTimesAreRefused) {
  EXPECT_THROW(MakeLowPass(0.0, 100.0), Error);
  EXPECT_THROW(MakeLowPass(40.0, 100.0), Error);
  EXPECT_THROW(MakeLowPass(std::nan(""), 100.0), Error);
  Trajectory trajectory =
      SamplePath({0.0, 0.01, 0.03, 0.04}, [](double t) { return Eigen::Vector3d(t, t, t); });
  EXPECT_THROW(FilterLowPass(trajectory, 10.0), Error);
}

TEST(Butterworth, GapsStayGapsAndDoNotBleed) {
  Trajectory trajectory = SamplePath(
      EvenTimes(100, 100), [](double t) { return Eigen::Vector3d(t < 0.5 ? 0 : 1, 0, 0); });
  Hide(trajectory, 45, 55);
  FilterLowPass(trajectory, 10.0);
  EXPECT_EQ(FindGaps(trajectory).size(), 1u);
  EXPECT_NEAR(trajectory.p(0, 44), 0.0, 1e-9) << "the step beyond the gap is not seen";
  EXPECT_NEAR(trajectory.p(0, 55), 1.0, 1e-9);
}

TEST(ResidualAnalysis, FindsTheNoiseOfAKnownSignal) {
  RandomStream random("residual analysis", "noise");
  const double noise = 0.3e-3;
  Trajectory trajectory = SamplePath(EvenTimes(200, 2000), [&](double t) {
    return Eigen::Vector3d(0.2 * std::sin(2 * kPi * t) + noise * random.NextNormal(),
                           0.1 * std::sin(4 * kPi * t) + noise * random.NextNormal(),
                           noise * random.NextNormal());
  });
  const ResidualAnalysis analysis = FindCutoff(trajectory);
  EXPECT_NEAR(analysis.noise, noise * std::sqrt(3.0), 0.05 * noise);
  EXPECT_GT(analysis.cutoff, 4.0) << "above the signal";
  EXPECT_LT(analysis.cutoff, 20.0);
  // Ten times the noise asks for a lower cut-off.
  for (Eigen::Index i = 0; i < trajectory.p.cols(); ++i) {
    for (int k = 0; k < 3; ++k) trajectory.p(k, i) += 10 * noise * random.NextNormal();
  }
  EXPECT_LT(FindCutoff(trajectory).cutoff, analysis.cutoff);
  EXPECT_THROW(
      FindCutoff(SamplePath(EvenTimes(200, 100), [](double) { return Eigen::Vector3d::Zero(); })),
      Error);
}

TEST(KnownTrajectories, FingertipsDropOutWhereTheHandCloses) {
  GRASPBENCH_REQUIRE_MOCAP(path, "dfki-hand_embodiment/recording.tsv");
  const Recording recording = LoadRecording(path);
  Trajectory thumb = MakeTrajectory(recording, "thumb_tip");
  EXPECT_EQ(FindGaps(thumb).size(), 17u);
  size_t longest = 0;
  for (const SampleRun& gap : FindGaps(thumb)) longest = std::max(longest, gap.size());
  EXPECT_EQ(longest, 57u);
  FillGaps(thumb, 0.1);
  EXPECT_GT(FindGaps(thumb).size(), 0u) << "a gap of 570 ms is no short gap";
}

struct Export {
  double rate = 200.0;     // [Hz]
  double noise = 0.25e-3;  // of a coordinate [m]
  double cutoff = 0.0;     // [Hz]; 0: as recorded
  bool is_causal = true;
  double tremor = 0.0;  // [m]
};

/** Butterworth of second order in the difference equation of textbooks, forwards. */
void Filter(double cutoff, double rate, Eigen::VectorXd& x) {
  const double k = std::tan(3.14159265358979 * cutoff / rate), q = std::sqrt(2.0);
  const double a0 = k * k + q * k + 1.0;
  double x1 = x[0], x2 = x[0], y1 = x[0], y2 = x[0];
  for (double& value : x) {
    const double y =
        (k * k * (value + 2.0 * x1 + x2) - 2.0 * (k * k - 1.0) * y1 - (k * k - q * k + 1.0) * y2) /
        a0;
    x2 = x1, x1 = value, y2 = y1, y1 = value = y;
  }
}

/** A marker that rests, is moved by 0.3 m in 0.8 s and hit on the way, and rests: 2.5 s. */
Trajectory MakeMarker(const Export& settings, const std::string& name) {
  RandomStream random(name, "marker of an export");
  Trajectory track;
  const int count = static_cast<int>(2.5 * settings.rate);
  track.p.resize(3, count);
  track.states.assign(static_cast<size_t>(count), SampleState::kMeasured);
  const double phase = random.NextUniform(0.0, 6.28);
  for (int i = 0; i < count; ++i) {
    const double t = i / settings.rate;
    const double hit = t > 1.4 ? 0.0 : 0.1 * (1.4 - t);  // a corner of 100 mm/s
    track.times.push_back(t);
    const double way =
        0.3 * Ease(t, 0.7, 1.5) + hit + settings.tremor * std::sin(6.2832 * 9.5 * t + phase);
    for (int axis = 0; axis < 3; ++axis) {
      track.p(axis, i) = way + settings.noise * random.NextNormal();
    }
  }
  for (int axis = 0; axis < 3 && settings.cutoff > 0.0; ++axis) {
    Eigen::VectorXd x = track.p.row(axis);
    Filter(settings.cutoff, settings.rate, x);
    if (!settings.is_causal) {
      x = x.reverse().eval();
      Filter(settings.cutoff, settings.rate, x);
      x = x.reverse().eval();
    }
    track.p.row(axis) = x;
  }
  return track;
}

double FindOf(const Export& settings, const std::string& name) {
  std::vector<Trajectory> markers;
  for (int i = 0; i < 6; ++i) markers.push_back(MakeMarker(settings, name + std::to_string(i)));
  std::vector<const Trajectory*> tracks;
  for (const Trajectory& marker : markers) tracks.push_back(&marker);
  return FindLowPassTrace(tracks);
}

TEST(FindLowPassTrace, FindsAFilterAndItsCutoff) {
  for (const double rate : {100.0, 200.0, 500.0}) {
    for (const double cutoff : {6.0, 10.0}) {
      for (const bool is_causal : {true, false}) {
        Export settings;
        settings.rate = rate;
        settings.cutoff = cutoff;
        settings.is_causal = is_causal;
        const double found = FindOf(settings, "filtered" + std::to_string(rate + cutoff));
        // Two passes have their -3 dB point at 0.80 of that of one.
        EXPECT_NEAR(found, is_causal ? cutoff : 0.8 * cutoff, 0.35 * cutoff)
            << rate << " " << cutoff << " " << is_causal;
      }
    }
  }
}

TEST(FindLowPassTrace, LeavesRecordingsAsTheyWereTakenAlone) {
  for (const double rate : {30.0, 60.0, 100.0, 200.0, 500.0}) {
    for (const double noise : {0.03e-3, 0.25e-3, 1e-3}) {
      for (const double tremor : {0.0, 0.4e-3}) {
        Export settings;
        settings.rate = rate;
        settings.noise = noise;
        settings.tremor = tremor;
        EXPECT_TRUE(std::isnan(FindOf(settings, "raw"))) << rate << " " << noise << " " << tremor;
      }
    }
  }
}

TEST(FindLowPassTrace, SaysNothingWithoutNoiseOrWithoutSamples) {
  Export settings;
  settings.noise = 0.0;
  EXPECT_TRUE(std::isnan(FindOf(settings, "clean")));
  EXPECT_TRUE(std::isnan(FindLowPassTrace({})));
}

}  // namespace
}  // namespace graspbench
