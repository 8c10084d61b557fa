#include "human_study/study/run/removal_advice.h"

#include <gtest/gtest.h>

#include "human_study/study/design/study_config.h"

namespace graspbench {
namespace {

TEST(RemovalAdvice, EveryReasonHasItsOwn) {
  for (const char* code :
       {"left_out",           "unreadable",        "missing_marker",     "no_reach",
        "no_onset",           "no_hold",           "no_opening",         "no_contact",
        "not_usable",         "filled_event",      "gap_event",          "disagreement",
        "carried_unseen",     "other_lift_axis",   "wrong_unit",         "label_jump",
        "no_movement",        "far_digit",         "hand_centred",       "wrong_shape",
        "contact_after_end",  "closure_too_long",  "detectors_disagree", "moved_before_touch",
        "object_left_behind", "thumb_not_opposed", "same_recording",     "cutoff_too_high",
        "frame_jump"}) {
    EXPECT_STREQ(FindRemovalAdvice(code).code, code);
  }
  EXPECT_EQ(FindRemovalAdvice("of_tomorrow").curve, RemovalCurve::kOpening);
  EXPECT_EQ(FindRemovalAdvice("no_onset").curve, RemovalCurve::kSpeed);
}

// Limits and rules are what study suggest tries by itself.
TEST(RemovalAdvice, BeyondSettingsIsWhatAPersonCanLookAt) {
  EXPECT_EQ(FindAdviceBeyondSettings("no_onset"), "start_s, for a rest before it");
  EXPECT_EQ(FindAdviceBeyondSettings("closure_too_long"), "");
  EXPECT_EQ(FindAdviceBeyondSettings("wrong_shape"),
            "sizes and centre in objects.csv, pad_offsets_m");
}

// "movement.rule: regression" must be a key of today.
TEST(RemovalAdvice, NamesKeysThatThereAre) {
  for (const char* key :
       {"movement.rule", "movement.speed_threshold_m_per_s", "hold.speed_threshold_m_per_s",
        "cleaning.max_gap_s", "contact.max_pad_offset_m", "contact.max_uncertainty_s",
        "removal.filled_event", "removal.gap_event", "removal.max_disagreement_s",
        "removal.implausible", "recording.unit", "plausibility.max_hold_distance_m",
        "plausibility.max_contact_after_end_s", "plausibility.max_closure_time_s",
        "plausibility.max_disagreement_s", "plausibility.max_moved_before_s"}) {
    EXPECT_NE(FindFileKey(ListStudyKeys(), key), nullptr) << key;
  }
}

}  // namespace
}  // namespace graspbench
