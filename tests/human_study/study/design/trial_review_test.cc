#include "human_study/study/design/trial_review.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "core/base/text/data_table.h"
#include "core/base/text/text.h"
#include "human_study/study/output/study_tables.h"
#include "human_study/study/synthetic/demo_study.h"

namespace graspbench {
namespace {

namespace fs = std::filesystem;

std::string FindFaults(const std::string& text) {
  Diagnostics problems;
  DataTable table(text, "reviews.csv", problems);
  ReadReviews(table, problems);
  return problems.Format();
}

TEST(TrialReview, FaultsHaveTheirLines) {
  const std::string head = "trial,digit,verdict,contact_s,uncertainty_s\n";
  EXPECT_EQ(FindFaults(head + "P1-1,index,,,\nP1-1,thumb,confirmed,,\n"), "");
  const auto expect = [&](const std::string& rows, const std::string& part) {
    const std::string faults = FindFaults(head + rows);
    EXPECT_NE(faults.find(part), std::string::npos) << part << " is missing in " << faults;
  };
  expect("P1-1,pinky,confirmed,,\n", "reviews.csv:2: error: digit \"pinky\" is not known");
  expect("P1-1,index,yes,,\n", "reviews.csv:2: error: verdict \"yes\" is not known");
  expect("P1-1,index,corrected,,\n", "reviews.csv:2: error: corrected without a time");
  expect("P1-1,index,corrected,1.2,0\n", "uncertainty_s: expected more than 0");
  expect(",index,confirmed,,\n", "trial: empty");
  expect("P1-1,index,confirmed,,\nP1-1,FF,no_contact,,\n",
         "reviews.csv:3: error: trial P1-1 has a verdict on the index already in line 2");
}

class ReplayedReview : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(::testing::TempDir()) /
              (std::string("trial_review_") +
               ::testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::remove_all(folder_);
    SyntheticOptions options;
    options.seed = "trial_review_test";
    options.num_people = 1;
    options.trials_per_size = 2;
    options.diameters = {0.03, 0.06};
    WriteDemoStudy(MakeSyntheticStudy(options), folder_);
    std::ofstream(folder_ / "study.yaml", std::ios::app) << "bias_trials: 0\n";
    before_ = Run();
  }
  void TearDown() override { fs::remove_all(folder_); }

  StudyResult Run() const { return RunStudy(LoadStudy(folder_ / "study.yaml")); }
  StudyResult RunWith(const std::string& rows) const {
    std::ofstream(folder_ / "reviews.csv") << "trial,digit,verdict,contact_s,by\n" << rows;
    return RunStudy(LoadStudy(folder_ / "study.yaml", {}, {"reviews=reviews.csv"}));
  }
  static const DigitContactEvents& FindIndex(const StudyTrial& trial) {
    for (const DigitContactEvents& digit : trial.analysis->contacts) {
      if (digit.digit == "FF") return digit;
    }
    return trial.analysis->contacts.front();
  }

  fs::path folder_;
  StudyResult before_;
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
  const auto expect = [&](const std::string& rows, const std::string& part) {
    try {
      RunWith(rows);
      ADD_FAILURE() << "no fault for " << rows;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
    }
  };
  expect("P9-1,index,confirmed,,\n", "trial \"P9-1\" is not of this study");
  expect(id + ",index,corrected,900,\n", "contact_s 900.000 lies outside of trial " + id);
}

}  // namespace
}  // namespace graspbench
