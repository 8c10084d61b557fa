#pragma once
/** @file
Worlds in which each of the five claims is true, false, or not asked. The generators draw persons,
objects and trials with a known effect and noise and put them where the program finds its data:
trials of a study through its statistics.csv, a map's trials, result.json of optimisations, the
records of sessions. They know nothing of the rules by which claims are judged. */

#include <cstdint>

#include "datasets/analysis/argument/argument_evidence.h"

namespace graspbench {

enum class Truth { kTrue, kFalse, kAbsent };

/** What is planted in a world: effects in the units of the claim. */
struct WorldSize {
  double shared_sd = 0.0;      ///< what people's digits share in a trial [s]; alone they have 30 ms
  double taken_away = 0.0;     ///< share of the digits' constant lateness that step 1 takes away
  double gain = 1.0;           ///< of stability by step 2
  double success = 0.0;        ///< change of the success probability
  bool is_at_ceiling = false;  ///< 99 of 100 grasps succeed before
  int num_scenes = 21;         ///< of each hand
  int num_trials = 40;         ///< of success, of each hand and object
};
/** Of true and false worlds as the tests have them. */
WorldSize SizeOf(Truth truth);

/** @param claim  0 for (a) .. 4 for (e); other claims have no data. */
ArgumentSources MakeArgumentWorld(int claim, Truth truth, const WorldSize& size, uint64_t seed);

/** The verdict on this claim of one world. */
ArgumentVerdict NameWorld(int claim, Truth truth, const WorldSize& size, uint64_t seed);

}  // namespace graspbench
