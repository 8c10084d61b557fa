#include "workbench/text/study_touches.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "datasets/journal/sealed_store.h"
#include "tests/datasets/session/fake_session.h"

namespace graspbench {
namespace {

void WriteStudy(const std::filesystem::path& folder, const std::string& trials,
                const std::string& events) {
  WriteFileAtomically(folder / "trials.csv", trials);
  WriteFileAtomically(folder / "events.csv", events);
  SealOutput(folder, {"trials.csv", "events.csv"}, {});
}

TEST(StudyTouches, AContactIsFoundOrNeverHappenedOrIsNotKnown) {
  TemporaryFolder folder;
  WriteStudy(folder.path(), "trial_id,is_kept,object\na,1,can\nb,0,can\nc,1,\n",
             "trial_id,event,digit,is_believed,time_s,missing\n"
             "a,maximum_opening,,1,1.2,\n"
             "a,last_maximum_opening,,0,1.3,\n"
             "a,contact,TH,0,9.0,\n"
             "a,contact,TH,1,1.5,\n"
             "a,contact,FF,1,,in the hold it moves at 52 mm/s against the object\n"
             "a,contact,MF,1,,not usable here: known to 103 ms only\n"
             "b,contact,TH,1,1.5,\n"
             "c,contact,TH,1,2.5,\n");
  const std::vector<TrialTouches> touches = ReadStudyTouches(folder.path());
  ASSERT_EQ(touches.size(), 2u);
  EXPECT_EQ(touches[0].object, "can");
  EXPECT_EQ(touches[0].start, 1.2);
  ASSERT_EQ(touches[0].contacts.size(), 2u);
  EXPECT_EQ(touches[0].contacts[0].digit, "TH");
  EXPECT_TRUE(touches[0].contacts[0].is_opposing);
  EXPECT_EQ(touches[0].contacts[0].time, 1.5);
  EXPECT_EQ(touches[0].contacts[1].digit, "FF");
  EXPECT_TRUE(std::isnan(touches[0].contacts[1].time));
  EXPECT_TRUE(std::isnan(touches[1].start));
}

TEST(StudyTouches, DamagedAndMissingTablesAreRefused) {
  TemporaryFolder folder;
  EXPECT_THROW(ReadStudyTouches(folder.path()), Error);
  WriteStudy(folder.path(), "trial_id,is_kept\na,1\n",
             "trial_id,event,digit,is_believed\na,contact,TH,1\n");
  EXPECT_THROW(ReadStudyTouches(folder.path()), Error);  // no times
  WriteStudy(folder.path(), "trial_id,is_kept\na,1\n",
             "trial_id,event,digit,is_believed,time_s\na,contact,TH,1,soon\n");
  EXPECT_THROW(ReadStudyTouches(folder.path()), Error);
}

}  // namespace
}  // namespace graspbench
