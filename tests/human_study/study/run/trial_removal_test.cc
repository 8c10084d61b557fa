#include "human_study/study/run/trial_removal.h"

#include <gtest/gtest.h>

#include "human_study/study/design/study_config.h"
#include "human_study/study/run/run_study.h"

namespace graspbench {

namespace {

TEST(FindRemoval, ADoubtAboutTheTrialComesBeforeWhatItExplains) {
  TrialAnalysis analysis;
  analysis.movement.onset = MissingEvent("it never moves");
  analysis.trial_doubts = {{"carried_unseen", "the hand carried it"}};
  analysis.doubts = analysis.trial_doubts;
  EXPECT_EQ(FindRemoval(analysis, {}).code, "carried_unseen");
  RemovalConfig lenient;
  lenient.implausible = false;
  EXPECT_EQ(FindRemoval(analysis, lenient).code, "no_onset");
}

// A contact that is known to an interval bounds the trial; one without a bound does not.
TEST(FindRemoval, AnIntervalKeepsTheTrialHoweverWide) {
  TrialAnalysis analysis;
  analysis.movement.onset.time = analysis.hold.time = analysis.closure_start.time = 1.0;
  for (const char* digit : {"TH", "FF"}) {
    DigitContactEvents& events = analysis.contacts.emplace_back();
    events.digit = digit;
    events.is_thumb = digit == std::string("TH");
    events.contact.time = 1.2;
    events.contact.uncertainty = 0.3;
    events.contact.missing = std::string(kNotUsable) + ": known to \u00b1 588 ms only";
  }
  EXPECT_EQ(FindRemoval(analysis, {}).code, "");
  RemovalConfig strict;
  strict.missing_digit = true;  // they touched
  EXPECT_EQ(FindRemoval(analysis, strict).code, "");
  analysis.contacts[0].contact = MissingEvent(std::string(kNotUsable) + ": hidden");
  EXPECT_EQ(FindRemoval(analysis, {}).code, "not_usable");
  analysis.contacts[0].contact = MissingEvent("it moves");
  EXPECT_EQ(FindRemoval(analysis, {}).code, "no_contact");
}

TEST(GroupRemoved, TextsThatDifferInNumbersAreOneReason) {
  std::vector<StudyTrial> trials(4);
  const char* texts[] = {"late by 3 ms", "", "late by 4.5 ms", "hidden"};
  for (size_t i = 0; i < 4; ++i) {
    trials[i].id = std::to_string(i);
    trials[i].removed = texts[i];
  }
  const std::vector<RemovalGroup> groups = GroupRemoved(trials);
  ASSERT_EQ(groups.size(), 2u);
  EXPECT_EQ(groups[0].text, "late by 3..4.5 ms");
  EXPECT_EQ(groups[0].trials, (std::vector<std::string>{"0", "2"}));
  EXPECT_EQ(groups[1].text, "hidden");
}

TEST(MergeNumbers, GivesTheRangeOfWhatDiffersAndKeepsTheRest) {
  EXPECT_EQ(MergeNumbers({"10 mm away (at most 20).", "9.5 mm away (at most 20).",
                          "31 mm away (at most 20)."}),
            "9.5..31 mm away (at most 20).");
  EXPECT_EQ(MergeNumbers({"are 5.2e-05 m apart", "are 7e-06 m apart", "are 0.001 m apart"}),
            "are 7e-06..0.001 m apart");
  EXPECT_EQ(MergeNumbers({"trial-3.c3d: 7 frames", "trial-12.c3d: 7 frames"}),
            "trial-\u2026.c\u2026d: 7 frames");
  EXPECT_EQ(MergeNumbers({"trial-3.c3d: cut", "trial-3.c3d: cut"}), "trial-3.c3d: cut");
}

TEST(TrialFlags, AreCountedOverTheTrialsThatCount) {
  StudyResult result;
  result.trials.resize(4);
  for (StudyTrial& trial : result.trials) trial.analysis.emplace();
  result.trials[0].analysis->used_filled = true;
  result.trials[1].analysis->used_filled = true;
  result.trials[1].analysis->used_gap = true;
  result.trials[2].analysis->used_filled = true;
  result.trials[2].removed = "no contact";
  EXPECT_EQ(FormatFlags(*result.trials[1].analysis), "filled, gap");
  EXPECT_EQ(FormatFlags(*result.trials[3].analysis), "");
  for (const FlagCount& counted : CountFlags(result)) {
    const std::string name = counted.flag->name;
    EXPECT_EQ(counted.count, name == "filled" ? 2 : name == "gap" ? 1 : 0) << name;
    EXPECT_DOUBLE_EQ(counted.share, counted.count / 3.0) << name;
  }
}

// The one to begin with has no flag and a usual GFT.
TEST(FindGoodTrial, IsWithoutFlagAndNearTheMedian) {
  StudyResult result;
  EXPECT_EQ(FindGoodTrial(result), nullptr);
  const double gfts[] = {0.01, 0.03, 0.0325, 0.2, 0.031};
  for (const double gft : gfts) {
    StudyTrial trial;
    trial.id = std::to_string(result.trials.size());
    trial.analysis.emplace();
    trial.analysis->timing.gft = gft;
    result.trials.push_back(trial);
  }
  result.trials[4].analysis->used_gap = true;  // the median itself, but in a gap
  EXPECT_EQ(FindGoodTrial(result)->id, "1");
  result.trials[1].removed = "late";
  EXPECT_EQ(FindGoodTrial(result)->id, "2");
}

// How well a contact is known is a number of its own, and no flag.
TEST(TrialFlags, FilteredExportsAndHandsThatCloseOnAreFlagged) {
  TrialAnalysis analysis;
  DigitContactEvents& digit = analysis.contacts.emplace_back();
  digit.contact.time = 1.0;
  digit.contact.uncertainty = 0.04;
  digit.is_verified = true;
  analysis.num_touching = 1;
  EXPECT_EQ(FormatFlags(analysis), "");
  analysis.low_pass = 6.0;
  EXPECT_EQ(FormatFlags(analysis), "filtered export");
  analysis.closes_on = 7.9e-3;
  EXPECT_EQ(FormatFlags(analysis), "filtered export");
  analysis.closes_on = 8.1e-3;
  EXPECT_EQ(FormatFlags(analysis), "closes on, filtered export");
}

TEST(RemovalAdvice, EveryReasonHasItsOwn) {
  for (const char* code :
       {"left_out",          "unreadable",       "missing_marker",     "no_reach",
        "no_onset",          "no_hold",          "no_opening",         "no_contact",
        "not_usable",        "filled_event",     "gap_event",          "disagreement",
        "carried_unseen",    "other_lift_axis",  "wrong_unit",         "label_jump",
        "no_movement",       "far_digit",        "hand_centred",       "wrong_shape",
        "contact_after_end", "closure_too_long", "moved_before_touch", "object_left_behind",
        "thumb_not_opposed", "same_recording",   "cutoff_too_high",    "frame_jump",
        "constant_shape",    "regrasp"}) {
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
        "removal.implausible", "removal.regrasp", "recording.unit",
        "plausibility.max_hold_distance_m", "plausibility.max_contact_after_end_s",
        "plausibility.max_closure_time_s", "plausibility.max_disagreement_s",
        "plausibility.max_moved_before_s"}) {
    EXPECT_NE(FindFileKey(ListStudyKeys(), key), nullptr) << key;
  }
}

}  // namespace

}  // namespace graspbench
