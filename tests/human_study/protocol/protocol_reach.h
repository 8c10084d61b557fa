#pragma once
/** @file
Reaches made from the protocol alone, to judge the analysis with.

Written from a description of the experiment (a person reaches for an upright cylinder on a table,
takes it with five digits and lifts it), not from the analysis: it shares no code and no curve with
human_study/. What it takes from the literature and from mechanics:

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

World frame W: z up, table at z = 0, the object's axis at x = y = 0. SI units. */

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace graspbench::protocol {

constexpr int kNumDigits = 5;  ///< thumb, index, middle, ring, little

struct ReachConditions {
  double rate = 200.0;             ///< [Hz]
  double noise_sd = 0.3e-3;        ///< of each coordinate [m]
  int num_object_markers = 3;      ///< 0, 1 (top centre) or 3 (equilateral triangle on the top)
  double triangle_edge = 30e-3;    ///< [m]
  double yield = 0.2e-3;           ///< of the skin [m]
  bool nail_markers = false;       ///< else beside the pad
  double push = 0.0;               ///< of the object by the first digit [m]
  double min_touch_speed = 60e-3;  ///< [m/s]
  double max_touch_speed = 150e-3;
  double hidden_share = 0.0;  ///< of all contacts: the marker vanishes around the touch
  int hovering_digit = -1;    ///< stays `hover_gap` off the surface; -1: every digit touches
  double hover_gap = 9e-3;    ///< [m]
  double min_gft = 30e-3;     ///< true time from first to last touch, uniform [s]
  double max_gft = 90e-3;
};

struct Reach {
  std::vector<double> times;                                    ///< [s]
  std::array<std::vector<Eigen::Vector3d>, kNumDigits> digits;  ///< p_WM [m]; NaN where hidden
  std::vector<Eigen::Vector3d> wrist;
  std::vector<std::vector<Eigen::Vector3d>> object_markers;
  // The truth.
  std::array<double, kNumDigits> touch_times{};  ///< [s]; NaN: never touched
  double onset = 0.0;                            ///< of the hand [s]
  double transport_end = 0.0;                    ///< the wrist stands [s]
  double lift_off = 0.0;                         ///< [s]
};

constexpr double kObjectRadius = 35e-3;  ///< [m]
constexpr double kObjectHeight = 0.12;   ///< [m]

/** A pure function of conditions, id and trial number; streams of different ids are independent. */
Reach MakeReach(const ReachConditions& conditions, const std::string& id, int trial);

}  // namespace graspbench::protocol
