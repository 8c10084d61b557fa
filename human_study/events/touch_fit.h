#pragma once
/** @file
When a fingertip that comes nearer in one dimension touched, and how well that can be known.

A marker does not stop when the skin touches: the skin sinks in, a phalanx turns on its pad. With s
the time to the touch tc, the marker's clearance g is taken to be

    before   g = r + D + v s + a s^2 / 2 + j s^3 / 6 - (m - m_c)        s = tc - t > 0
    after    g = r + D exp(-(v + w) (t - tc) / D) + c (t - tc)

r: place in the hold; v: speed at touch; D: depth by which it goes on; m: how far the object has
gone along the clearance by itself (another digit pushes or turns it), m_c and w: that and its rate
at the touch. A digit's way is smooth in the laboratory before it touches and at rest against the
object after. The speed against the object is continuous at the touch: a deep D and a late tc look
alike, and noise decides how alike. So the answer is not one fit but all of them, weighed by how
well they explain the samples (Bayes): D over a list of depths, tc over a bracket of time, the rest
integrated out, as it is linear with normal priors (people's reaches: v about 0.1 m/s, a about 1
m/s^2). Samples far from the touch count less, as the polynomials hold near it only. The depth
belongs to the skin and the marker's place, not to the trial: its weights may be learned from all
contacts of a study (LearnDepths), and then one contact whose own samples cannot tell is found
without bias.

Skin resists exponentially (Pawluk & Howe 1999, J. Biomech. Eng. 121:178): its first part gives way
without a trace that a fit could find. The touch is earlier than the path tells by that depth over
the speed v of the touch (TouchFit::toe):

    depth = 0.55 mm, SD = 0.28 mm

The depth covers stiff tips as well as soft pads (0.2 to 0.8 N/mm at first, on fingers of 120 to 260
N/m). A slow touch has no stop of its own: the digit goes on as the grip grows, which drives skin in
at up to 50 mm/s. Two things tell a stop that may not be the touch: it is slow, and the digit was
within skin's reach (from `earliest` on) for long before it, or took long from there to its rest at
`latest`. With [x..y] 0 at x, 1 at y and linear between, and T = latest - earliest,

    share = 0.7 [60..40 mm/s](v) max([60..140 ms](stop - earliest), [0.4..0.6 s](T))

is how likely the touch is anywhere from `earliest` on to the stop, and where T is long to `latest`.

Known limits: a way of settling that is not like the exponential; a digit that stops off the surface
stops as one that touches does. */

#include <Eigen/Core>
#include <array>
#include <limits>
#include <vector>

#include "human_study/events/scalar_curve.h"

namespace graspbench {

/** Depths D that are weighed [m]. */
inline constexpr std::array<double, 8> kSettlingDepths = {0.0,    0.3e-3, 0.6e-3, 1.0e-3,
                                                          1.5e-3, 2.0e-3, 2.5e-3, 3.5e-3};
/** A weight for each of them. */
using DepthWeights = std::array<double, kSettlingDepths.size()>;

/** Before anything is learned: shallow is more likely than deep. */
extern const DepthWeights kUsualDepths;
/** The mean of the depths under these weights [m]. @pre their sum is positive. */
double CalcMeanDepth(const DepthWeights& weights);

struct TouchSamples {
  std::vector<double> times;   ///< [s], increasing
  std::vector<double> places;  ///< clearance, about 0 in the hold [m]
  /** m: the object's own motion along the clearance, as many, from anywhere; away from the digit is
  negative [m]. Empty: it rests. */
  std::vector<double> object_motion;
  double noise = 0.0;   ///< SD of a place [m]
  double tremor = 0.0;  ///< RMS of a place while the digit is free (8 to 12 Hz) [m]
  double first = 0.0;   ///< the touch lies between first ..
  double last = 0.0;    ///< .. and last [s]
  /** Clearance at the touch, skin uncompressed, where a pad offset is given [m]; else NaN. */
  double touch_place = std::numeric_limits<double>::quiet_NaN();
  /** Of the clearance, unit; zero: along a surface's normal. No part of the fit. */
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();
};

/** What the samples say for each depth. */
struct TouchFit {
  std::array<double, kSettlingDepths.size()> log_evidence{};
  std::array<double, kSettlingDepths.size()> time{};      ///< mean [s]
  std::array<double, kSettlingDepths.size()> variance{};  ///< of the time [s^2]
  double toe = 0.0;          ///< in which skin gives way unseen, at most 0.3 s [s]
  double toe_unsure = 0.0;   ///< SD of it [s]
  double noisy = 0.0;        ///< by which noise may have moved it (SD) [s]
  double speed = 0.0;        ///< of the approach against the object at the touch [m/s]
  double earliest = 0.0;     ///< when it came within skin's reach [s]
  double latest = 0.0;       ///< when it has come to rest [s]
  double noise_ratio = 1.0;  ///< RMS of the best fit's residuals over the noise
  std::string missing;       ///< why there is none; empty when there is one
};

/** @pre times and places are as many, first < last. */
TouchFit FitTouch(const TouchSamples& samples);

/** One of two touches: each depth's time and variance are those of both, the toe is the likelier's.
@param share  how likely it is the second, between 0 and 1. @pre neither is missing. */
TouchFit MixFits(const TouchFit& a, const TouchFit& b, double share);

/** The touch under those weights: mean and standard deviation over all depths, less the toe. The
deviation contains the toe's, and 0.75 of the time that noise beyond 0.6 mm takes at the touch's
speed. A slow touch is partly anywhere within reach, as said above. Weights that were learned add
one and a half times what they move the touch by beyond half a standard deviation, at most 20 ms: of
a soft arrival that looks like settling the usual depths, too, make a part. */
EventTime CalcTouchTime(const TouchFit& fit, const DepthWeights& weights);

/** Where the path seems to stop under the usual depths, skin that gives way unseen included [s].
@pre fit.missing is empty. */
double CalcStopTime(const TouchFit& fit);

/** The part of that standard deviation which is not about the depth [s]: digits do not share it, so
it is what makes touching at once look like a sequence. NaN when the touch is missing. */
double CalcOwnUncertainty(const TouchFit& fit, const DepthWeights& weights);

/** Weights of the depths from many contacts: those under which all are most likely (expectation
maximisation of the mixture), with kUsualDepths as three contacts seen before. */
DepthWeights LearnDepths(const std::vector<TouchFit>& fits);

}  // namespace graspbench
