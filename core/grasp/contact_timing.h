#pragma once
/** @file
Simultaneity of contacts, for robots and people alike.

Let t_i be the first contacts of the grasping digits, T the thumb and t0 the start of closure
(simulation: start of phase 3; human: instant of the widest hand opening):

    GCT = max t_i - t0                      grasp closure time
    GFT = max t_i - min t_i                 grasp forming time
    GOT = |t_T - min of the others|         grasp opposing time
    GFT% = GFT / GCT,  GOT% = GOT / GCT     (as ratios here)

Source: Roethling 2007 (names, ratios); the formulas are inferred. GCT >= GFT >= GOT whenever every
contact comes after t0; with two digits GFT = GOT. */

#include <string>
#include <vector>

#include "core/base/interned_name.h"
#include "core/statistics/answer.h"

namespace graspbench {

struct DigitContact {
  InternedName digit;  ///< "TH", "FF", ...
  /** Whether this digit opposes the others: the thumb where it takes part. At most one per grasp.
  Stored in records as `is_thumb`. */
  bool is_opposing = false;
  double time = 0.0;  ///< first contact [s]; NaN: never touched

  template <class V>
  static void ListFields(V&& field) {
    field("digit", &DigitContact::digit);
    field("is_thumb", &DigitContact::is_opposing);
    field("time_s", &DigitContact::time);
  }
};

struct ContactTiming {
  double gct = 0.0;  ///< [s]; this and all below are NaN where undefined
  double gft = 0.0;
  double got = 0.0;
  double gft_ratio = 0.0;
  double got_ratio = 0.0;
  /** A contact came before t0, so GFT > GCT is possible; the times are reported unclipped. */
  bool contact_before_start = false;
};

/** Remark on the times of a trial with a contact before the start. */
inline constexpr char kNotComparable[] = "early contact: not comparable";

/** Computes GCT, GFT, GOT and their ratios. GCT and GFT are NaN if a digit never touched. GOT is
NaN unless the thumb and another digit touched. GCT is also NaN if t0 is NaN, and the ratios are NaN
unless GCT > 0. Asserts the order of the three measures. @pre at most one opposing digit. */
ContactTiming CalcContactTiming(const std::vector<DigitContact>& contacts, double t0);

/** Order in which the digits touched, as far as the data resolve it; for robots and people alike.

Two consecutive contacts are tied when

    t_b - t_a <= z sqrt(u_a^2 + u_b^2)

where u are the standard uncertainties of their times and z = 1.96, the 95 % normal quantile. */
struct ContactOrder {
  /** Groups of tied digits, by time between and within groups: {{"TH", "FF"}, {"MF"}}. Digits that
  never touched are left out. */
  std::vector<std::vector<std::string>> groups;
  int num_ties = 0;  ///< pairs of consecutive contacts that are tied

  int FindRank(const std::string& digit) const;  ///< 1 for the first group; 0 if in none
  std::string Format() const;                    ///< "TH=FF<MF"; empty if none touched
};

/** @param uncertainties  standard uncertainties of the contact times, each >= 0 [s]; ignored where
a time is missing. */
ContactOrder FindContactOrder(const std::vector<DigitContact>& contacts,
                              const std::vector<double>& uncertainties);

/** Floor of GFT%: what scatter alone leaves when a pre-grasp lets all digits touch at the same time
on average.

Let t_ik be the first contact of digit i in trial k, m_i the median of t_ik over the trials in which
the digit touched, and M = max m_i. The times of each digit are shifted so that its median becomes
that of the last digit:

    t'_ik = t_ik - m_i + M
    floor = median over k of GFT%(t'_1k, t'_2k, ..)

No digit is made faster: earlier ones wait. What remains is the scatter between trials, because the
object's pose and the joints vary. The floor is an oracle: it uses the medians of the same trials
that it is computed for. Digits that are late by constants have a floor of 0. A trial in which a
digit never touched counts as infinite, since no shift makes it touch. Medians do not minimise the
median ratio, so GFT% may lie slightly below its floor. Proposed by graspbench.

The floor needs at least this many trials in which all digits touched. */
inline constexpr int kLeastTrialsOfFloor = 5;
/** GFT% of at most this multiple of the floor: hardly anything but scatter remains. */
inline constexpr double kNearGftFloor = 1.2;

/** Median contact time m_i of each digit [s]; NaN for a digit that never touched.
@param trials  contacts per trial, with the same digits in the same order; empty: it timed out. */
std::vector<double> CalcMedianTimes(const std::vector<std::vector<DigitContact>>& trials);

/** Computes the floor of GFT% as a ratio.
@param trials  contacts per trial, with the same digits in the same order; empty: it timed out.
@param t0  start of closure [s].
@returns no answer if fewer than two digits ever touched, if all digits touched in fewer than five
trials, or if at least half of the trials lack a contact. */
Answer<double> CalcGftFloor(const std::vector<std::vector<DigitContact>>& trials, double t0 = 0.0);

}  // namespace graspbench
