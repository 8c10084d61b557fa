#pragma once
/** @file
Reaches of people who do not move as an analysis would like: a second generator, written from the
protocols of the experiments alone, without knowledge of human_study/events and human_study/study.

What it adds to protocol_reach.h: speed profiles of three families whose peak is anywhere between
40 and 60 % of the movement, digits that time their touch independently of each other about the true
start of the movement (or share a delay), distances that nobody declares, ends with a noise of their
own, drift over a session, a digit that touches, leaves and returns, objects that are pushed or
turned before all digits have arrived, very soft touches, tremor, and what laboratories do to files:
spikes, a causal low-pass, swapped labels, an "object" marker on the table.

A digit closes along the surface normal on a cubic that meets the surface at a given speed; the
truth is the instant at which skin and surface meet on a clock of 0.1 ms, the object being where it
is then. World frame W: z up, table at z = 0, the object's axis at x = y = 0. SI units. */

#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

namespace graspbench::everyday {

constexpr int kNumDigits = 5;            ///< thumb, index, middle, ring, little
constexpr double kObjectRadius = 32e-3;  ///< [m]
constexpr double kObjectHeight = 0.11;   ///< [m]

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
  double rate = 200.0;         ///< [Hz]
  double noise_sd = 0.25e-3;   ///< of each coordinate [m]
  int num_object_markers = 3;  ///< 1 (top) or 3 (triangle on the top)

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

  /** Of the pad of a finger, over which its stiffness grows e-fold (pushed_reach.h alone); 0: stiff
  skin [m]. */
  double pad_depth = 0.0;

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
};

struct Reach {
  std::vector<double> times;                                    ///< [s]
  std::array<std::vector<Eigen::Vector3d>, kNumDigits> digits;  ///< p_WM [m]
  std::vector<Eigen::Vector3d> wrist;
  std::vector<std::vector<Eigen::Vector3d>> object_markers;
  // The truth [s].
  std::array<double, kNumDigits> touch_times{};    ///< first touch; NaN: never
  std::array<double, kNumDigits> hold_times{};     ///< the touch after which the digit stays
  std::array<double, kNumDigits> release_times{};  ///< NaN unless the digit left again
  double onset = 0.0;
  double widest = 0.0;  ///< the thumb is farthest from the surface
  double lift_off = 0.0;
};

/** A pure function of conditions, id and trial (from 0, in the order of the session). */
Reach MakeReach(const Conditions& conditions, const std::string& id, int trial);

}  // namespace graspbench::everyday
