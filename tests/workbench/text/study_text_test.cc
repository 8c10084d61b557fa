#include "workbench/text/study_text.h"

#include <gtest/gtest.h>

namespace graspbench {
namespace {

TEST(FormatRemoved, NamesTheTrialsAndTheKeys) {
  StudyResult result;
  for (int i = 0; i < 8; ++i) {
    StudyTrial trial;
    trial.id = "P1-" + std::to_string(i);
    trial.removed = "an event fell into a gap";
    trial.removed_code = "gap_event";
    result.trials.push_back(trial);
  }
  EXPECT_EQ(FormatRemoved(result),
            "no trial counts:\nremoved  8 [gap_event] an event fell into a gap\n"
            "         trials: P1-0, P1-1, P1-2, P1-3, P1-4, P1-5 ..\n"
            "         keys: markers.companions and cleaning.max_gap_s; removal.gap_event: false "
            "keeps it\n");
}

TEST(FormatRemoved, WhereHalfOfTheAnalysedDoNotCountTheWayOnIsNamed) {
  StudyResult result;
  result.study.file = "my study.yaml";
  result.study.folder = result.study.recordings = "there";
  result.trials.resize(4);
  for (StudyTrial& trial : result.trials) trial.analysis.emplace();
  result.trials[0].removed_code = result.trials[0].removed = "no_hold";
  EXPECT_EQ(FormatRemoved(result).find("advice"), std::string::npos);
  result.trials[1].removed_code = result.trials[1].removed = "no_hold";
  EXPECT_NE(FormatRemoved(result).find("advice   graspbench study suggest 'my study.yaml' proposes "
                                       "keys with which more trials are included\n"),
            std::string::npos);
  result.study.recordings = "elsewhere";
  EXPECT_NE(FormatRemoved(result).find("'my study.yaml' --data elsewhere proposes"),
            std::string::npos);
}

TEST(FormatWarnings, ManyOfAKindAreCounted) {
  StudyResult result;
  for (int i = 0; i < 200; ++i) {
    result.warnings.push_back({"review_lapsed", "line " + std::to_string(i)});
  }
  EXPECT_EQ(FormatWarnings(result),
            "warning  [review_lapsed] line 0\nwarning  [review_lapsed] line 1\n"
            "warning  [review_lapsed] line 2\nwarning  [review_lapsed] and 197 more\n");
}

TEST(FormatSuggestions, SaysWhyWhatItCostsAndWhatIsLeft) {
  StudySuggestions suggestions;
  suggestions.num_rows = suggestions.num_all_rows = 1;
  suggestions.num_trials = suggestions.num_trials_then = 21;
  suggestions.num_kept_then = 15;
  suggestions.suggestions = {{{"movement.rule=regression"}, "no rest", "it is less exact", 15}};
  suggestions.others = {{"no_contact", "no contact of the thumb: hidden", {"p1-1"}}};
  EXPECT_EQ(
      FormatSuggestions(suggestions),
      "now      0 of 21 trials included\nsuggest  movement.rule: regression\n         why: no "
      "rest\n         cost: it is less exact\n         then 15 trials included\nthen     15 "
      "of 21 trials included\nleft     1 [no_contact] no contact of the thumb: hidden\n      "
      "   trials: p1-1\n         look at: the marker of that digit under markers; "
      "markers.companions, if it is hidden\n");
}

}  // namespace
}  // namespace graspbench
