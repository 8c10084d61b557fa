#pragma once
/** @file
The argument of the thesis (Roethling, Bielefeld 2007) as five claims, each judged by numbers. The
numbers come from the analyses that make the underlying tables (argument_evidence.h); they are
judged here, not recomputed.

A number x has a null value, a direction that the claim expects, and a smallest effect of interest
b. With its 95 % interval [l, h], shifted and signed so that the claim expects x > 0,

    shown         l > 0
    refuted       else, if h < b: the effect is smaller than what matters, or has the opposite sign
    not decided   else; also ("ceiling") if h < b, but the largest possible change is smaller than
                  b, unless h < -b: an opposite effect that matters

A claim is shown if all numbers that decide it are shown, and refuted if one of them is refuted:
what holds for only one of two hands is not true of hands in general. A claim without a number is
not run and not decided, for absent data never refute. Rules and smallest effects are proposed by
graspbench and were fixed before the evidence was generated. */

#include <limits>
#include <string>
#include <vector>

#include "core/base/enum_table.h"
#include "core/base/text/csv.h"
#include "core/base/units.h"
#include "core/statistics/proportion.h"

namespace graspbench {

enum class ArgumentVerdict { kShown, kRefuted, kNotDecided };
inline constexpr NamedValue<ArgumentVerdict> kArgumentVerdicts[] = {
    {ArgumentVerdict::kShown, "shown"},
    {ArgumentVerdict::kRefuted, "refuted"},
    {ArgumentVerdict::kNotDecided, "not decided"}};
inline const char* NameOf(ArgumentVerdict verdict) {
  return RowOf(kArgumentVerdicts, verdict).name;
}

/** Meaning of a number and how it is judged. */
struct ArgumentMeasure {
  const char* text;  ///< "GFT after step 1 less GFT before"
  const char* unit;  ///< "ms"; empty for a factor
  int decimals;
  double null_value;      ///< value without an effect
  double least;           ///< smallest effect of interest, > 0
  double sign;            ///< 1: the claim expects more than the null value, -1: less
  const char* rule = "";  ///< in place of the rule above, where another analysis decides
};
extern const ArgumentMeasure kPeopleRatio;    ///< people's GFT over that of independent digits
extern const ArgumentMeasure kLateSuccess;    ///< change of success by 100 ms of delay
extern const ArgumentMeasure kLateThreshold;  ///< change of grip threshold by 100 ms of delay
extern const ArgumentMeasure kFormingTime;    ///< change of GFT by step 1
extern const ArgumentMeasure kStability;      ///< factor on stability by step 2
extern const ArgumentMeasure kSuccessChange;  ///< change of success by the optimisation

struct ArgumentNumber {
  const ArgumentMeasure* measure = nullptr;
  std::string subject;                   ///< "tum", "shadow: thumb alone, by sigma"
  bool decides = false;                  ///< whether it decides the claim
  double value = kUnset;                 ///< NaN: there is none
  Interval interval = {kUnset, kUnset};  ///< 95 %; NaN: none
  int n = 0;
  std::string of;  ///< what n counts: "scene"
  /** Largest change in the claimed direction that is possible, >= 0: 1.9 points after 98.1 %. */
  double room = std::numeric_limits<double>::infinity();
  std::string left_out;  ///< number and reason: "2 whose start holds nothing"; empty: none
  std::string detail;    ///< related figures
  std::string source;    ///< folders
  std::string command;   ///< that generated it
  ArgumentVerdict verdict = ArgumentVerdict::kNotDecided;
  std::string why;           ///< why it is not decided although the interval would: "ceiling: .."
  std::string would_decide;  ///< if it is not decided
};

/** Applies the rule above. */
ArgumentVerdict JudgeNumber(const ArgumentMeasure& measure, const Interval& interval);

/** Estimates the n at which the interval's half-width would equal the difference to be decided, the
larger of |x| and b - |x|, if further data were like these. 0: unknown or not more than n. The map
uses the same rule (simultaneity_map.h). */
int CountToDecide(const ArgumentMeasure& measure, double value, const Interval& interval, int n);

/** Sets `verdict`, `why` and `would_decide` by the rule. */
void Judge(ArgumentNumber& number);

/** States when a number is shown and when it is refuted, in sentences with their units. */
std::string DescribeRule(const ArgumentMeasure& measure);

/** Returns "about 32 objects instead of 21", and how many the catalogue has if it has fewer. */
std::string FormatWanted(int wanted, int n, const std::string& of);

/** Returns "not decided (ceiling: ..)". */
std::string FormatVerdict(const ArgumentNumber& number);

/** Returns "-23 ms (-41 to -9), 21 scenes; left out: ..", with "n/a" where there is no number. */
std::string FormatNumber(const ArgumentNumber& number);

/** Something that was not run, with the command that runs it. */
struct NotRun {
  std::string what, command;
};

/** One of the five claims as a question. */
struct ArgumentQuestion {
  const char* id;        ///< "a"
  const char* title;     ///< "People"
  const char* question;  ///< in plain English
  const char* shown;     ///< the answer for each verdict, one sentence
  const char* refuted;
  const char* open;
};
inline constexpr int kNumArgumentClaims = 5;
extern const ArgumentQuestion kArgumentQuestions[kNumArgumentClaims];

struct ArgumentClaim {
  const ArgumentQuestion* question = nullptr;
  std::vector<ArgumentNumber> numbers;  ///< deciding numbers first
  std::vector<NotRun> not_run;
  ArgumentVerdict verdict = ArgumentVerdict::kNotDecided;

  bool was_run() const;  ///< whether a deciding number exists
  /** The number to report: the first deciding one with the claim's verdict, else the first deciding
  one; null: none. */
  const ArgumentNumber* headline() const;
  /** The answer; if deciding numbers differ or one states why, also the verdict of each. */
  std::string sentence() const;
  /** What would decide each deciding number that is not decided; empty if the claim is decided. */
  std::string would_decide() const;
};

/** Judges a claim by its deciding numbers. */
ArgumentVerdict JudgeClaim(const std::vector<ArgumentNumber>& numbers);

/** Columns with one row per number, for the page and argument.json. */
std::vector<CsvColumn<ArgumentNumber>> ListArgumentColumns();

/** {claims: [{id, question, verdict, sentence, would_decide, number, numbers, not_run}]}. */
Json ToJson(const std::vector<ArgumentClaim>& claims);

/** "not run", or the verdict's name. */
std::string FormatVerdict(const ArgumentClaim& claim);

/** Formats one line per claim: "(b) not decided: sentence number". */
std::string FormatArgument(const std::vector<ArgumentClaim>& claims);

}  // namespace graspbench
