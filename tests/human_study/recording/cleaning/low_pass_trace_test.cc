#include "human_study/recording/cleaning/low_pass_trace.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.h"

namespace graspbench {
namespace {

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
    const double t = i / settings.rate, u = std::min(1.0, std::max(0.0, (t - 0.7) / 0.8));
    const double hit = t > 1.4 ? 0.0 : 0.1 * (1.4 - t);  // a corner of 100 mm/s
    track.times.push_back(t);
    const double way = 0.3 * u * u * u * (10.0 - 15.0 * u + 6.0 * u * u) + hit +
                       settings.tremor * std::sin(6.2832 * 9.5 * t + phase);
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
