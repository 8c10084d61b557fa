#include "human_study/study/run/study_warnings.h"

#include <gtest/gtest.h>

#include "human_study/study/run/run_study.h"

namespace graspbench {
namespace {

/** Ten trials, five with each object; the ring finger touches in those that `touches` says. */
StudyResult MakeResult(const std::function<bool(int)>& touches) {
  StudyResult result;
  result.digits = {"TH", "RF"};
  for (int i = 0; i < 10; ++i) {
    StudyTrial trial;
    trial.object = i < 5 ? "cup" : "ball";
    trial.analysis.emplace();
    for (const std::string& digit : result.digits) {
      DigitContactEvents contact;
      contact.digit = digit;
      contact.contact.time = 1.0;
      if (digit == "RF" && !touches(i)) contact.contact = MissingEvent("held 40 mm away");
      trial.analysis->contacts.push_back(contact);
    }
    result.trials.push_back(trial);
  }
  return result;
}

TEST(FindNeverTouching, NamesTheDigitOfTheStudyOrOfOneObject) {
  const auto texts = [](const std::function<bool(int)>& touches) {
    std::vector<std::string> starts;
    for (const StudyWarning& warning : FindNeverTouching(MakeResult(touches))) {
      EXPECT_EQ(warning.code, "digit_never_touches");
      starts.push_back(warning.text.substr(0, warning.text.find(';')));
    }
    return starts;
  };
  using Texts = std::vector<std::string>;
  EXPECT_EQ(texts([](int) { return true; }), Texts{});
  EXPECT_EQ(texts([](int i) { return i >= 7; }),
            Texts{"the ring touches in 0 of 5 trials of object \"cup\" only (held 40 mm away)"});
  EXPECT_EQ(texts([](int i) { return i >= 8; }),
            Texts{"the ring touches in 2 of 10 trials only (held 40 mm away)"});
}

TEST(FindNeverTouching, ATouchAtAnUnknownInstantIsATouch) {
  StudyResult result = MakeResult([](int) { return false; });
  for (StudyTrial& trial : result.trials) {
    trial.analysis->contacts.back().contact = MissingEvent(std::string(kNotUsable) + ": hidden");
  }
  EXPECT_TRUE(FindNeverTouching(result).empty());
}

TEST(FindManyFrozen, FromAFifthOn) {
  StudyResult result;
  EXPECT_TRUE(FindManyFrozen(result).empty());
  result.num_samples = 1000;
  result.num_frozen = 199;
  EXPECT_TRUE(FindManyFrozen(result).empty());
  result.num_frozen = 205;
  ASSERT_EQ(FindManyFrozen(result).size(), 1u);
  EXPECT_EQ(FindManyFrozen(result)[0].text.find("20 % of all samples"), 0u);
}

TEST(FindFilteredExports, SaysHowManyAndHowLate) {
  StudyResult result;
  result.trials.resize(3);
  for (StudyTrial& trial : result.trials) trial.analysis.emplace();
  EXPECT_TRUE(FindFilteredExports(result).empty());
  result.trials[0].analysis->low_pass = result.trials[2].analysis->low_pass = 6.0;
  const std::vector<StudyWarning> warnings = FindFilteredExports(result);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(warnings[0].code, "filtered_export");
  EXPECT_NE(warnings[0].text.find("of 2 of 3 trials were low-passed at about 6 Hz"),
            std::string::npos);
  EXPECT_NE(warnings[0].text.find("some 38 ms late"), std::string::npos);
}

TEST(FindExchangedThumbs, FromThreeTrialsAndAFifthOn) {
  StudyResult result;
  result.trials.resize(15);
  for (StudyTrial& trial : result.trials) trial.analysis.emplace();
  result.trials[0].analysis->may_be_exchanged = result.trials[1].analysis->may_be_exchanged = true;
  EXPECT_TRUE(FindExchangedThumbs(result).empty());
  result.trials[7].analysis->may_be_exchanged = true;
  ASSERT_EQ(FindExchangedThumbs(result).size(), 1u);
  EXPECT_EQ(FindExchangedThumbs(result)[0].text.find("in 3 of 15 trials"), 0u);
  result.trials.resize(16);
  EXPECT_TRUE(FindExchangedThumbs(result).empty());
}

TEST(FindTwoRates, NamesBothBeyondTwoPerCent) {
  StudyResult result;
  result.lowest_rate = 199.0;
  result.highest_rate = 200.0;
  EXPECT_TRUE(FindTwoRates(result).empty());
  result.lowest_rate = 100.0;
  const std::vector<StudyWarning> warnings = FindTwoRates(result);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].text.find("100 to 200 samples a second"), std::string::npos);
}

}  // namespace
}  // namespace graspbench
