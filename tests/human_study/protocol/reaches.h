#pragma once
/** @file
Reaches whose events are known, made from the protocols of the experiments alone (a person reaches
for an upright cylinder on a table, takes it with five digits and lifts it), without knowledge of
human_study/events and human_study/study. Four generators take the same conditions and share no code
with the analysis. World frame W: z up, table at z = 0, the object's axis at x = y = 0. SI units. */

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <limits>
#include <string>
#include <vector>

namespace graspbench::protocol {

constexpr int kNumDigits = 5;            ///< thumb, index, middle, ring, little
constexpr double kObjectRadius = 32e-3;  ///< of all generators but MakeProtocolReach [m]
constexpr double kObjectHeight = 0.11;   ///< [m]

inline double MinimumJerk(double u) {
  u = std::clamp(u, 0.0, 1.0);
  return u * u * u * (10.0 - 15.0 * u + 6.0 * u * u);
}

/** Position over time of a movement of length and duration one, its speed largest at `peak`. */
class SpeedProfile {
 public:
  enum class Family {
    kWarped,  ///< minimum jerk in a time u^g
    kBeta,    ///< speed as u^p (1 - u)^q, p + q = 4
    kHalves,  ///< minimum jerk halves of unequal duration
  };
  SpeedProfile(Family family, double peak);
  double PositionAt(double u) const;

 private:
  double RawPositionAt(double u) const;
  Family family_;
  double peak_;
  double exponent_ = 1.0;
  std::vector<double> table_;
};

struct Conditions {
  double rate = 200.0;           ///< [Hz]
  double noise_sd = 0.25e-3;     ///< of each coordinate [m]
  int num_object_markers = 3;    ///< 0, 1 (top) or 3 (triangle on the top)
  double triangle_edge = 30e-3;  ///< MakeProtocolReach alone [m]

  // The person.
  SpeedProfile::Family family = SpeedProfile::Family::kWarped;
  double min_peak = 0.5;  ///< share of the movement at which the hand is fastest, uniform
  double max_peak = 0.5;
  std::vector<double> distances{0.35};  ///< of the hand, one drawn for each trial [m]
  double end_sd = 0.0;                  ///< of the wrist's end, independent of the digits [s]
  double digit_sd = 25e-3;              ///< of each digit's touch about the true start [s]
  double shared_sd = 0.0;               ///< of a delay that all digits of a trial share [s]
  double lag = 0.0;                     ///< fixed, from each digit to the next [s]
  double drift = 0.0;                   ///< of all touches, from one trial to the next [s]
  double wander = 0.0;                  ///< the same by chance each time: a random walk, SD [s]
  double min_touch_speed = 60e-3;       ///< [m/s]
  double max_touch_speed = 160e-3;
  double tremor = 0.0;  ///< RMS along each axis, 8 to 11 Hz, less once the digit touches [m]
  /** Of the pad of a finger, over which its stiffness grows e-fold (MakePushedReach alone); 0: stiff
  skin [m]. */
  double pad_depth = 0.0;
  double yield = 0.2e-3;      ///< of the skin, MakeProtocolReach alone, as all to max_gft [m]
  bool nail_markers = false;  ///< else beside the pad
  double min_gft = 30e-3;     ///< true time from first to last touch, uniform [s]
  double max_gft = 90e-3;

  // What happens.
  int regrasping_digit = -1;     ///< touches, leaves by `leave_gap` and returns; -1: none
  double leave_gap = 9e-3;       ///< [m]
  double push = 0.0;             ///< of the object by the first digit [m]
  bool is_push_at_once = false;  ///< the object takes on the digit's speed; else minimum jerk
  double turn = 0.0;             ///< of the object about the vertical at the same time [rad]
  int hovering_digit = -1;       ///< comes to rest `hover_gap` off the surface
  double hover_gap = 3e-3;       ///< [m]

  // What the laboratory does to it.
  bool is_object_left_behind = false;  ///< the object's markers rest on the table
  double low_pass_hz = 0.0;            ///< causal, second order; 0: none
  bool is_swapped = false;             ///< thumb and index carry each other's label
  double spike_share = 0.0;            ///< of all samples of each marker
  double spike_size = 30e-3;           ///< [m]
  double hidden_share = 0.0;           ///< of all contacts: the marker vanishes around the touch
};

struct Reach {
  std::vector<double> times;                                    ///< [s]
  std::array<std::vector<Eigen::Vector3d>, kNumDigits> digits;  ///< p_WM [m]; NaN where hidden
  std::vector<Eigen::Vector3d> wrist;
  std::vector<std::vector<Eigen::Vector3d>> object_markers;
  // The truth [s].
  std::array<double, kNumDigits> touch_times{};    ///< first touch; NaN: never
  std::array<double, kNumDigits> hold_times{};     ///< the touch after which the digit stays
  std::array<double, kNumDigits> release_times{};  ///< NaN unless the digit left again
  double onset = 0.0;
  double widest = 0.0;  ///< the thumb is farthest from the surface
  double lift_off = 0.0;
  double object_radius = kObjectRadius, object_height = kObjectHeight;  ///< [m]
};

/** A pure function of conditions, id (of a person) and trial (from 0, in the order of the session);
streams of different ids are independent. */
using ReachMaker = Reach (*)(const Conditions& conditions, const std::string& id, int trial);

/** The first generator. What it takes from the literature and from mechanics:

  * hand and digits move along quintic (minimum jerk) paths; the digits open beyond the object and
    close along its surface normal (Flash and Hogan 1985; Smeets and Brenner 1999);
  * a digit aims at a point beneath the surface and is stopped by the surface: its speed at touch is
    given, the truth is the instant at which the gap between its skin and the surface is first zero,
    found on a clock of 0.1 ms;
  * after touch the skin yields: depth(t) = yield (1 - exp(-speed t / yield)), so that the speed
    at touch goes on and dies away; a marker on the nail turns with the phalanx about the touch by
    10 to 14 degrees in 0.15 s;
  * the first digit may push the object along the table; the object is lifted with a little tilt;
  * cameras add white noise to every coordinate of every marker, those of the object included.

What counts: the camera, touch speeds, yield to max_gft, push, hovering_digit, hidden_share. */
Reach MakeProtocolReach(const Conditions& conditions, const std::string& id, int trial);
/** Its usual conditions. */
inline Conditions MakeProtocolConditions() {
  Conditions conditions;
  conditions.noise_sd = 0.3e-3;
  conditions.max_touch_speed = 150e-3;
  conditions.hover_gap = 9e-3;
  return conditions;
}

/** People who do not move as an analysis would like. What it adds: speed profiles of three families
whose peak is anywhere between 40 and 60 % of the movement, digits that time their touch
independently of each other about the true start of the movement (or share a delay), distances that
nobody declares, ends with a noise of their own, drift over a session, a digit that touches, leaves
and returns, objects that are pushed or turned before all digits have arrived, very soft touches,
tremor, and what laboratories do to files.

A digit closes along the surface normal on a cubic that meets the surface at a given speed; the truth
is the instant at which skin and surface meet on a clock of 0.1 ms, the object being where it is
then. */
Reach MakeEverydayReach(const Conditions& conditions, const std::string& id, int trial);

/** Written from the protocol of MakeEverydayReach alone and before its author had read how
human_study/ finds events and judges independence. Nothing moves on the same curve:

  * the hand accelerates and decelerates by half sines of unequal length, or by one large bell and a
    small correcting one that overlaps it (Meyer et al. 1988), by the person;
  * time follows the logarithm of the distance (Fitts 1954);
  * every person has own mean times of each digit; single trials scatter uniformly about them;
  * digits close on a raised cosine that aims beneath the surface and is stopped by it, beside a
    path that bows by some millimetres; the object is never put down twice at the same place.

A drift slows the whole hand from trial to trial, a random walk delays the digits alone. What happens
and what the laboratory does is not in here. */
Reach MakeStrangerReach(const Conditions& conditions, const std::string& id, int trial);

/** The first digit pushes the object before the others arrive, from mechanics alone.

A rigid upright cylinder of mass m slides on a table with Coulomb friction mu m g. The tip of a digit
is a small mass on a spring and a damper that pull it along its plan (impedance control, Hogan 1985);
the plan is two overlapping minimum-jerk strokes (Flash & Henis 1991), to a place beside the object
and from there onto it. Skin and surface meet as a stiff unilateral spring with friction. Once a
digit feels the object its plan slows down within some millimetres: the first digit's by as much
further as the object is to be pushed. When all digits have arrived they grip in balance, then lift.
Nobody prescribes the object's way: it follows from the forces. The truth is the step of the
integration (0.1 ms) in which skin and surface first meet.

A soft pad resists exponentially (Pawluk & Howe 1999): about 0.9 mm at 0.5 N with a pad_depth of
0.5 mm, and it sinks in again when the grip is built up.

What counts: the camera, distances, digit_sd, touch speeds, push (0: the object is too heavy to
slide), pad_depth, is_object_left_behind. */
Reach MakePushedReach(const Conditions& conditions, const std::string& id, int trial);

}  // namespace graspbench::protocol
