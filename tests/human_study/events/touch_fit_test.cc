#include "human_study/events/touch_fit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/base/random.h"

namespace graspbench {
namespace {

struct Approach {
  double touch = 0.4;     // of skin and surface [s]
  double toe = 0.55e-3;   // of skin that gives way as if nothing were there [m]
  double speed = 0.1;     // at touch [m/s]
  double slowing = 0.7;   // before it [m/s^2]
  double depth = 0.0;     // that it goes on by [m]
  double noise = 0.2e-3;  // [m]
  double CalcStop() const { return touch + toe / speed; }
};

/** A digit that slows evenly, touches and sinks in; the bracket is known to 60 ms. */
TouchSamples Sample(const Approach& approach, RandomStream& random) {
  TouchSamples samples;
  samples.noise = approach.noise;
  const double stop = approach.CalcStop();
  samples.first = stop - 0.035;
  samples.last = stop + 0.025;
  for (double t = stop - 0.09; t < stop + 0.1; t += 0.005) {
    const double before = stop - t;
    double place =
        approach.depth + approach.speed * before + approach.slowing * before * before / 2;
    if (before < 0.0) {
      place = approach.depth > 0.0
                  ? approach.depth * std::exp(approach.speed * before / approach.depth)
                  : 0.0;
    }
    samples.times.push_back(t);
    samples.places.push_back(place + approach.noise * random.NextNormal());
  }
  return samples;
}

DepthWeights OnlyDepth(size_t index) {
  DepthWeights weights{};
  weights[index] = 1.0;
  return weights;
}

TEST(FitTouch, WithoutNoiseTheTouchIsFoundForEveryDepth) {
  RandomStream random("touch", "no noise");
  for (const size_t k : {size_t{0}, size_t{3}, size_t{5}}) {
    Approach approach;
    approach.depth = kSettlingDepths[k];
    approach.noise = 1e-7;
    TouchSamples samples = Sample(approach, random);
    samples.noise = 3e-5;
    const EventTime found = CalcTouchTime(FitTouch(samples), OnlyDepth(k));
    ASSERT_TRUE(found.IsFound());
    EXPECT_NEAR(found.time, approach.touch, 0.0015) << kSettlingDepths[k];
  }
}

TEST(FitTouch, AnotherClockGivesTheSameTouch) {
  RandomStream random("touch", "clock");
  TouchSamples samples = Sample({}, random);
  const EventTime found = CalcTouchTime(FitTouch(samples), kUsualDepths);
  for (double& time : samples.times) time += 64.0;
  samples.first += 64.0;
  samples.last += 64.0;
  const EventTime later = CalcTouchTime(FitTouch(samples), kUsualDepths);
  EXPECT_NEAR(later.time, found.time + 64.0, 1e-6);
  EXPECT_NEAR(later.uncertainty, found.uncertainty, 1e-6);
}

// Another digit pushes the object towards the digit or away from it within 60 ms, seen in O as a
// way that no digit goes by itself. 10 mm away would be 0.14 m/s at the touch, and a digit at
// 0.1 m/s would never arrive.
TEST(FitTouch, TheObjectsOwnMotionIsNoMotionOfTheDigit) {
  RandomStream random("touch", "pushed");
  for (const double push : {-0.004, 0.01}) {
    double wrong = 0.0, right = 0.0, covered = 0.0;
    for (int i = 0; i < 20; ++i) {
      Approach approach;
      approach.touch = 0.4 + 0.005 * random.NextUnit();
      TouchSamples samples = Sample(approach, random);
      const auto moved = [&](double t) {
        const double u = std::clamp((t - approach.CalcStop() + 0.05) / 0.06, 0.0, 1.0);
        return push * u * u * (3.0 - 2.0 * u);
      };
      for (size_t k = 0; k < samples.times.size(); ++k) {
        samples.object_motion.push_back(moved(samples.times[k]));
        if (samples.times[k] > approach.CalcStop()) continue;
        samples.places[k] -= moved(samples.times[k]) - moved(approach.CalcStop());
      }
      // Skin gives way at the speed against the object.
      const double stop = approach.CalcStop();
      const double touch =
          stop - approach.toe / (approach.speed + (moved(stop + 1e-4) - moved(stop)) / 1e-4);
      const TouchFit fit = FitTouch(samples);
      const EventTime seen = CalcTouchTime(fit, kUsualDepths);
      covered += std::abs(seen.time - touch) <= seen.CalcHalfWidth();
      right += std::pow(CalcStopTime(fit) - stop, 2);
      samples.object_motion.clear();
      wrong += std::pow(CalcStopTime(FitTouch(samples)) - stop, 2);
    }
    // Away from it leaves 44 mm/s against the object, which noise hides for longer, and that is
    // said.
    if (push > 0.0) {
      EXPECT_LT(std::sqrt(right / 20.0), 0.004);
    }
    EXPECT_GE(covered, 18.0) << push;
    EXPECT_LT(right, 0.3 * wrong) << push;
  }
}

// Digits that slow down to 12 mm/s touch later than it looks, learned depths or not.
TEST(LearnDepths, SoftArrivalsAreCovered) {
  RandomStream random("touch", "soft");
  Approach soft;
  soft.speed = 0.012;
  soft.slowing = 1.6;
  soft.depth = 0.25e-3;
  soft.toe = 0.0;
  soft.noise = 0.25e-3;
  constexpr int kNumContacts = 200;
  std::vector<TouchFit> fits;
  for (int i = 0; i < kNumContacts; ++i) fits.push_back(FitTouch(Sample(soft, random)));
  const DepthWeights weights = LearnDepths(fits);
  int num_covered = 0;
  for (const TouchFit& fit : fits) {
    const EventTime found = CalcTouchTime(fit, weights);
    num_covered += std::abs(found.time - soft.touch) < 1.96 * found.uncertainty;
  }
  EXPECT_GE(num_covered, 0.9 * kNumContacts);
}

TEST(FitTouch, TremorMakesATouchLessCertain) {
  RandomStream random("touch", "tremor");
  TouchSamples samples = Sample({}, random);
  const double still = CalcOwnUncertainty(FitTouch(samples), kUsualDepths);
  samples.tremor = 0.5e-3;
  EXPECT_GT(CalcOwnUncertainty(FitTouch(samples), kUsualDepths), 1.3 * still);
}

TEST(FitTouch, AGivenPadOffsetTellsShallowFromDeep) {
  RandomStream random("touch", "pad");
  double blind = 0.0, seen = 0.0, covered = 0.0;
  for (int i = 0; i < 40; ++i) {
    Approach approach;
    approach.depth = 2e-3;
    TouchSamples samples = Sample(approach, random);
    blind += CalcTouchTime(FitTouch(samples), kUsualDepths).time - approach.touch;
    samples.touch_place = approach.depth + approach.toe;  // where skin and surface meet
    const EventTime found = CalcTouchTime(FitTouch(samples), kUsualDepths);
    seen += found.time - approach.touch;
    covered += std::abs(found.time - approach.touch) <= found.CalcHalfWidth();
  }
  EXPECT_LT(std::abs(seen), 0.5 * std::abs(blind));
  EXPECT_GE(covered, 36.0);
}

// From all contacts of a study the depth becomes known, and with it each contact.
TEST(LearnDepths, UncertaintiesCoverAndNoBiasIsLeft) {
  for (const double depth : {0.0, 2e-3}) {
    RandomStream random("touch", "learn " + std::to_string(depth));
    std::vector<TouchFit> fits;
    std::vector<double> truth;
    for (int i = 0; i < 150; ++i) {
      Approach approach;
      approach.touch = 0.4 + 0.005 * random.NextUnit();
      approach.speed = random.NextUniform(0.06, 0.15);
      approach.slowing = random.NextUniform(0.2, 1.2);
      approach.depth = depth;
      truth.push_back(approach.touch);
      fits.push_back(FitTouch(Sample(approach, random)));
    }
    const DepthWeights weights = LearnDepths(fits);
    double bias = 0.0, covered = 0.0, usual_bias = 0.0;
    for (size_t i = 0; i < fits.size(); ++i) {
      const EventTime found = CalcTouchTime(fits[i], weights);
      bias += (found.time - truth[i]) / 150.0;
      usual_bias += (CalcTouchTime(fits[i], kUsualDepths).time - truth[i]) / 150.0;
      covered += (std::abs(found.time - truth[i]) <= found.CalcHalfWidth()) / 150.0;
    }
    EXPECT_LT(std::abs(bias), 0.003) << depth;
    EXPECT_GE(covered, 0.9) << depth;
    if (depth > 0.0) {
      EXPECT_LT(std::abs(bias), 0.5 * std::abs(usual_bias));
    }
    double mean_depth = 0.0;
    const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
    for (size_t k = 0; k < weights.size(); ++k) mean_depth += weights[k] * kSettlingDepths[k] / sum;
    EXPECT_NEAR(mean_depth, depth, 0.5e-3);
  }
}

// A soft arrival looks like settling: the more learned depths move it, the less it is known.
TEST(CalcTouchTime, WhatWasLearnedIsStatedAsUncertain) {
  RandomStream random("touch", "learned");
  Approach soft;
  soft.speed = 0.02;
  soft.noise = 0.5e-3;
  const TouchFit fit = FitTouch(Sample(soft, random));
  const DepthWeights deep = OnlyDepth(5);
  const EventTime learned = CalcTouchTime(fit, deep);
  const double moved = std::abs(learned.time - CalcTouchTime(fit, kUsualDepths).time);
  const double own = CalcOwnUncertainty(fit, deep);
  ASSERT_GT(moved, own);
  EXPECT_GT(learned.uncertainty, std::min(1.4 * moved, 0.02));
  EXPECT_LT(learned.uncertainty, std::hypot(std::hypot(own, 0.021), fit.toe_unsure));
}

// Two touches that nothing tells apart: the mean between them, and their distance in what is
// stated.
TEST(MixFits, TheDistanceOfTwoTouchesIsInTheUncertainty) {
  RandomStream random("touch", "mix");
  Approach early, late;
  late.touch = early.touch + 0.08;
  const TouchFit a = FitTouch(Sample(early, random)), b = FitTouch(Sample(late, random));
  for (const double share : {0.18, 0.5}) {
    const TouchFit mixed = MixFits(a, b, share);
    const EventTime mix = CalcTouchTime(mixed, kUsualDepths);
    EXPECT_LT(CalcTouchTime(b, kUsualDepths).time - mix.time, 3.0 * mix.uncertainty) << share;
    EXPECT_LT(mix.time - CalcTouchTime(a, kUsualDepths).time, 3.0 * mix.uncertainty) << share;
    // Of one depth, a mixture's moments; how well each explains its samples shifts the shares.
    const auto likeliest = static_cast<size_t>(
        std::max_element(a.log_evidence.begin(), a.log_evidence.end()) - a.log_evidence.begin());
    const double best_b = *std::max_element(b.log_evidence.begin(), b.log_evidence.end());
    const double weight_b = share * std::exp(b.log_evidence[likeliest] - best_b);
    const double share_b = weight_b / (weight_b + 1.0 - share);
    const double apart = b.time[likeliest] - a.time[likeliest];
    const double variance = (1.0 - share_b) * a.variance[likeliest] +
                            share_b * b.variance[likeliest] +
                            share_b * (1.0 - share_b) * apart * apart;
    EXPECT_NEAR(mixed.time[likeliest], a.time[likeliest] + share_b * apart, 1e-12) << share;
    EXPECT_NEAR(mixed.variance[likeliest], variance, 1e-15) << share;
  }
}

// A slow stop long after the digit came within reach: in 0.7 of all the touch is anywhere from there
// to the stop, or to its rest where that takes long. Mean and deviation of what is drawn so.
TEST(CalcTouchTime, ASlowTouchIsAnywhereWithinReach) {
  TouchFit fit;
  fit.log_evidence.fill(-INFINITY);
  fit.log_evidence[0] = 0.0;
  fit.time.fill(1.0);
  fit.variance.fill(1e-4);
  fit.speed = 0.02;
  fit.earliest = 0.8;
  RandomStream random("touch", "slow");
  for (const double latest : {1.05, 1.6}) {
    fit.latest = latest;
    const double end = latest > 1.5 ? latest : 1.0;
    constexpr int kNumDraws = 200000;
    double sum = 0.0, squares = 0.0;
    for (int i = 0; i < kNumDraws; ++i) {
      const double time = random.NextUniform(0.0, 1.0) < 0.7 ? random.NextUniform(0.8, end)
                                                             : 1.0 + 0.01 * random.NextNormal();
      sum += time;
      squares += time * time;
    }
    const double mean = sum / kNumDraws, sd = std::sqrt(squares / kNumDraws - mean * mean);
    const EventTime found = CalcTouchTime(fit, kUsualDepths);
    EXPECT_NEAR(found.time, mean, 2e-3) << latest;
    EXPECT_NEAR(found.uncertainty, sd, 3e-3) << latest;
  }
  for (const bool is_fast : {false, true}) {  // soon after it came within reach, or fast
    fit.latest = 1.05;
    fit.earliest = is_fast ? 0.8 : 0.95;
    fit.speed = is_fast ? 0.07 : 0.02;
    EXPECT_NEAR(CalcTouchTime(fit, kUsualDepths).uncertainty, 0.01, 1e-4) << is_fast;
    EXPECT_DOUBLE_EQ(CalcTouchTime(fit, kUsualDepths).time, 1.0) << is_fast;
  }
}

TEST(FitTouch, TooFewSamplesAreTold) {
  RandomStream random("touch", "missing");
  TouchSamples few = Sample({}, random);
  few.times.resize(5);
  few.places.resize(5);
  EXPECT_EQ(FitTouch(few).missing, "too few measured samples before or after the contact");
  EXPECT_EQ(CalcTouchTime(FitTouch(few), kUsualDepths).missing, FitTouch(few).missing);
  EXPECT_TRUE(std::isnan(CalcOwnUncertainty(FitTouch(few), kUsualDepths)));
}

}  // namespace
}  // namespace graspbench
