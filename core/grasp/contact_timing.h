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

#include <vector>

#include "core/base/interned_name.h"

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

}  // namespace graspbench
