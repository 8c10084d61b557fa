#include <gtest/gtest.h>

#include <functional>

#include "human_study/study/run/run_study.h"
#include "tests/human_study/faults.h"

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

TEST(FindWarnings, NamesTheDigitThatNeverTouchesInTheStudyOrAtOneObject) {
  const auto texts = [](const std::function<bool(int)>& touches) {
    std::vector<std::string> starts;
    for (const StudyWarning& warning : FindWarnings(MakeResult(touches))) {
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
  // A touch at an unknown instant is a touch.
  StudyResult result = MakeResult([](int) { return false; });
  for (StudyTrial& trial : result.trials) {
    trial.analysis->contacts.back().contact = MissingEvent(std::string(kNotUsable) + ": hidden");
  }
  EXPECT_TRUE(FindWarnings(result).empty());
}

/** The only warning of the result, "" without any. */
std::string FindText(const StudyResult& result, const std::string& code) {
  const std::vector<StudyWarning> warnings = FindWarnings(result);
  EXPECT_LE(warnings.size(), 1u);
  if (warnings.empty()) return "";
  EXPECT_EQ(warnings[0].code, code);
  return warnings[0].text;
}

TEST(FindWarnings, EachHasItsLimit) {
  StudyResult frozen;
  frozen.num_samples = 1000;
  frozen.num_frozen = 199;
  EXPECT_EQ(FindText(frozen, "frozen_samples"), "");
  frozen.num_frozen = 205;
  ExpectHolds(FindText(frozen, "frozen_samples"), "20 % of all samples");

  StudyResult filtered;
  filtered.trials.resize(15);
  for (StudyTrial& trial : filtered.trials) trial.analysis.emplace();
  StudyResult exchanged = filtered;
  EXPECT_EQ(FindText(filtered, "filtered_export"), "");
  filtered.trials[0].analysis->low_pass = filtered.trials[2].analysis->low_pass = 6.0;
  ExpectHolds(FindText(filtered, "filtered_export"),
              "of 2 of 15 trials were low-passed at about 6 Hz");
  ExpectHolds(FindText(filtered, "filtered_export"), "some 38 ms late");

  // From three trials and a fifth on.
  for (const size_t i : {0, 1}) exchanged.trials[i].analysis->may_be_exchanged = true;
  EXPECT_EQ(FindText(exchanged, "thumb_exchanged"), "");
  exchanged.trials[7].analysis->may_be_exchanged = true;
  ExpectHolds(FindText(exchanged, "thumb_exchanged"), "in 3 of 15 trials");
  exchanged.trials.resize(16);
  EXPECT_EQ(FindText(exchanged, "thumb_exchanged"), "");

  StudyResult lost;
  lost.trials.resize(8);
  EXPECT_EQ(FindText(lost, "frames_lost"), "");
  lost.trials[2].removed_code = "frame_jump";
  ExpectHolds(FindText(lost, "frames_lost"),
              "1 of 8 trials are removed because frames are missing");

  StudyResult rates;
  rates.lowest_rate = 199.0;
  rates.highest_rate = 200.0;
  EXPECT_EQ(FindText(rates, "two_rates"), "");
  rates.lowest_rate = 100.0;
  ExpectHolds(FindText(rates, "two_rates"), "100 to 200 samples a second");
}

}  // namespace
}  // namespace graspbench
