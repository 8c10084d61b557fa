#pragma once
/** @file
Simultaneity of contacts, for robots and people alike.

With t_i the first contacts of the grasping digits, T the thumb and t0 the start of closure
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
  /** The one digit of a grasp that opposes the others: the thumb where it takes part. Records keep
  it under the name `is_thumb`. */
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
  double gct = 0.0;  ///< [s]; NaN where not defined, as all below
  double gft = 0.0;
  double got = 0.0;
  double gft_ratio = 0.0;
  double got_ratio = 0.0;
  /** A contact came before t0 (GFT > GCT is then possible): reported, never clipped. */
  bool contact_before_start = false;
};

/** Stands beside the times of a trial with a contact before the start. */
inline constexpr char kNotComparable[] = "early contact: not comparable";

/** A digit that never touches makes GCT and GFT missing; GOT needs the thumb and one other digit.
An unknown t0 (NaN) makes GCT missing, GCT missing or 0 the ratios. @pre at most one thumb. Asserts
the order of the three measures. */
ContactTiming CalcContactTiming(const std::vector<DigitContact>& contacts, double t0);

/** Which digit touched first, second, .. - as far as the data can tell; for robots and people
alike.

Two neighbours in time are tied when

    t_b - t_a <= z sqrt(u_a^2 + u_b^2)

with u the standard uncertainties of their times: what 95 % of a normal error can explain. */
struct ContactOrder {
  /** Groups of tied digits in order of time, also within a group: {{"TH", "FF"}, {"MF"}}. Digits
  that never touched are in none. */
  std::vector<std::vector<std::string>> groups;
  int num_ties = 0;  ///< pairs of neighbours that are tied

  int FindRank(const std::string& digit) const;  ///< 1 for the first group; 0 when it is in none
  std::string Format() const;                    ///< "TH=FF<MF"; empty when none touched
};

/** @param uncertainties  of the contacts' times, each >= 0 [s]; not read where a time is missing.
 */
ContactOrder FindContactOrder(const std::vector<DigitContact>& contacts,
                              const std::vector<double>& uncertainties);

/** How simultaneous contacts could be if only scatter were left: what remains of GFT% when a
pre-grasp lets every digit come at the same time on average.

With t_ik the first contact of digit i in trial k, m_i the median of t_ik over the trials in which
the digit touched, and M = max m_i, each digit's times are shifted by its own median, to that of the
last digit:

    t'_ik = t_ik - m_i + M
    floor = median over k of GFT%(t'_1k, t'_2k, ..)

So no digit is hurried, earlier ones wait, and what is left is how they scatter from trial to trial,
because the object's place and the joints vary. It is an oracle: it knows the medians of the very
trials it is shown for. Digits that are late by constants have a floor of 0. A trial in which a
digit never touched counts as infinite, as no shift makes it touch. Medians are not the shifts with
the smallest median ratio, so GFT% may lie a little below its floor. Proposed by graspbench.

The floor is not known from fewer trials in which all digits touched. */
inline constexpr int kLeastTrialsOfFloor = 5;
/** GFT% of at most so many floors: hardly anything but scatter is left. */
inline constexpr double kNearGftFloor = 1.2;

/** m_i of each digit [s]; NaN for one that never touched.
@param trials  the contacts of each, of the same digits in the same order; empty: it gave up. */
std::vector<double> CalcMedianTimes(const std::vector<std::vector<DigitContact>>& trials);

/** As a ratio.
@param trials  the contacts of each, of the same digits in the same order; empty: it gave up.
@param t0  start of closure [s].
@returns no answer where fewer than two digits ever touched, all touched in fewer than five trials,
or half of the trials or more lack a contact. */
Answer<double> CalcGftFloor(const std::vector<std::vector<DigitContact>>& trials, double t0 = 0.0);

}  // namespace graspbench
