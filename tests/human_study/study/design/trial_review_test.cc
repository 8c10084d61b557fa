#include "human_study/study/design/trial_review.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "core/base/text/text.h"
#include "human_study/study/output/study_tables.h"
#include "human_study/study/synthetic/demo_study.h"
#include "tests/human_study/faults.h"

namespace graspbench {
namespace {

namespace fs = std::filesystem;

/** One person's demo study, analysed once without a review. */
class ReplayedReview : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    SyntheticOptions options;
    options.seed = "trial_review_test";
    options.num_people = 1;
    options.trials_per_size = 2;
    options.diameters = {0.03, 0.06};
    folder_ = fs::path(::testing::TempDir()) / "trial_review";
    WriteDemoStudy(MakeSyntheticStudy(options), folder_);
    before_ = RunStudy(LoadStudy(folder_ / "study.yaml", {}, {"bias_trials=0"}));
  }
  static void TearDownTestSuite() { fs::remove_all(folder_); }

  StudyResult RunWith(const std::string& rows) const {
    WriteFileAtomically(folder_ / "reviews.csv", "trial,digit,verdict,contact_s,by\n" + rows);
    return RunStudy(
        LoadStudy(folder_ / "study.yaml", {}, {"bias_trials=0", "reviews=reviews.csv"}));
  }
  static const DigitContactEvents& FindIndex(const StudyTrial& trial) {
    for (const DigitContactEvents& digit : trial.analysis->contacts) {
      if (digit.digit == "FF") return digit;
    }
    return trial.analysis->contacts.front();
  }

  inline static fs::path folder_;
  inline static StudyResult before_;
};

TEST_F(ReplayedReview, ACorrectionMovesTheContactAndEveryMeasure) {
  const StudyTrial& trial = before_.trials[0];
  ASSERT_TRUE(trial.IsKept()) << trial.removed;
  const double late = FindLastContact(trial.analysis->contacts) + 0.05;
  const StudyResult after =
      RunWith(trial.id + ",index,corrected," + std::to_string(late) + ",FR\n");
  const StudyTrial& own = after.trials[0];
  EXPECT_NEAR(FindIndex(own).contact.time, late, 1e-6);
  double first = late;
  for (const DigitContactEvents& digit : own.analysis->contacts) {
    first = std::min(first, digit.contact.time);
  }
  EXPECT_NEAR(own.analysis->timing.gft, late - first, 1e-6);
  // The same in every universe, and nothing else has moved.
  EXPECT_EQ(DescribeReviews(own.reviews), "index corrected to " + FormatFixed(late, 3) + " s (FR)");
  EXPECT_EQ(after.trials[1].analysis->timing.gft, before_.trials[1].analysis->timing.gft);
  const std::vector<StudyEvent> events = ListEvents(own, after.study.config);
  const auto review = std::find_if(events.begin(), events.end(),
                                   [](const StudyEvent& e) { return e.detector == "review"; });
  ASSERT_NE(review, events.end());
  EXPECT_EQ(review->digit, "FF");
  EXPECT_TRUE(review->is_believed);
}

TEST_F(ReplayedReview, AConfirmationChangesNothingAndAFalseContactGoes) {
  const std::string id = before_.trials[0].id;
  const StudyResult confirmed = RunWith(id + ",index,confirmed,,\n");
  EXPECT_EQ(confirmed.trials[0].analysis->timing.gft, before_.trials[0].analysis->timing.gft);
  EXPECT_TRUE(confirmed.trials[0].IsKept()) << confirmed.trials[0].removed;
  const StudyResult gone = RunWith(id + ",index,no_contact,,\n");
  EXPECT_FALSE(FindIndex(gone.trials[0]).contact.IsFound());
  EXPECT_EQ(gone.trials[0].analysis->num_touching, before_.trials[0].analysis->num_touching - 1);
}

TEST_F(ReplayedReview, AConfirmationHoldsForItsTimeAndAFrame) {
  const StudyTrial& trial = before_.trials[0];
  const double found = FindIndex(trial).contact.time;
  const auto confirm = [&](double time) {
    return RunWith(trial.id + ",index,confirmed," + FormatFixed(time, 6) + ",FR\n");
  };
  const StudyResult near = confirm(found + 0.004);  // recorded at 200 Hz
  EXPECT_TRUE(FindIndex(near.trials[0]).is_reviewed);
  EXPECT_TRUE(near.warnings.empty());
  const StudyResult far = confirm(found + 0.009);
  EXPECT_FALSE(FindIndex(far.trials[0]).is_reviewed);
  EXPECT_TRUE(far.trials[0].reviews.empty());
  ASSERT_EQ(far.warnings.size(), 1u);
  EXPECT_EQ(far.warnings[0].code, "review_lapsed");
  EXPECT_EQ(far.warnings[0].text, "reviews.csv, line 2: contact of the index in trial " + trial.id +
                                      " confirmed at " + FormatFixed(found + 0.009, 4) +
                                      " s, now at " + FormatFixed(found, 4) +
                                      " s; it counts as not confirmed, look again");
}

TEST_F(ReplayedReview, WhatFitsNoTrialStopsTheRun) {
  const std::string id = before_.trials[0].id;
  ExpectHolds(FaultOf([&] { RunWith("P9-1,index,confirmed,,\n"); }),
              "trial \"P9-1\" is not of this study");
  ExpectHolds(FaultOf([&] { RunWith(id + ",index,corrected,900,\n"); }),
              "contact_s 900.000 lies outside of trial " + id);
}

}  // namespace
}  // namespace graspbench
