#pragma once
/** @file
The argument of the thesis (Roethling, Bielefeld 2007) as five claims, and what numbers say of each.
The numbers come from the analyses that make the tables behind them (argument_evidence.h); here they
are judged, and nothing is computed again.

A number x has a null value, a direction in which the claim expects it, and a smallest effect of
interest b. With its 95 % interval [l, h], turned so that the claim expects x above the null 0,

    shown         l > 0
    refuted       h < b: what there is, is smaller than what matters, or goes the other way
    not decided   else

A claim is shown when all numbers that decide it are, and refuted when one of them is: what holds
for one of two hands does not hold for hands. A claim without a number is not run, and not decided:
absent data never refute. Rules and smallest effects are proposed by graspbench, and were written
before the evidence was run. */

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

/** What a number is. */
struct ArgumentMeasure {
  const char* text;  ///< "grasp forming time (GFT), after less before"
  const char* unit;  ///< "ms"; empty: a factor
  int decimals;
  double null_value;  ///< says neither
  double least;       ///< smallest effect of interest, > 0
  double sign;        ///< 1: the claim expects more than the null value, -1: less
};
extern const ArgumentMeasure kPeopleRatio;    ///< people's GFT over that of independent digits
extern const ArgumentMeasure kLateSuccess;    ///< of 100 ms of delay
extern const ArgumentMeasure kLateThreshold;  ///< of 100 ms of delay
extern const ArgumentMeasure kFormingTime;    ///< of step 1
extern const ArgumentMeasure kStability;      ///< of step 2
extern const ArgumentMeasure kSuccessChange;  ///< of the optimisation

struct ArgumentNumber {
  const ArgumentMeasure* measure = nullptr;
  std::string subject;                   ///< "tum", "shadow: thumb alone, by sigma"
  bool decides = false;                  ///< the claim's verdict rests on it
  double value = kUnset;                 ///< NaN: there is none
  Interval interval = {kUnset, kUnset};  ///< 95 %; NaN: none
  int n = 0;
  std::string of;        ///< what n counts: "scene"
  std::string left_out;  ///< "2 whose start holds nothing"; empty: none
  std::string detail;    ///< the other figures that belong to it
  std::string source;    ///< folders
  std::string command;   ///< that made it
  ArgumentVerdict verdict = ArgumentVerdict::kNotDecided;
  std::string would_decide;  ///< of one that is not decided
};

/** The rule above. */
ArgumentVerdict JudgeNumber(const ArgumentMeasure& measure, const Interval& interval);

/** So many with which the interval would be half as wide as what is to be decided, the larger of
|x| and b - |x|, were they like these; 0: not known. As the map's (simultaneity_map.h). */
int CountToDecide(const ArgumentMeasure& measure, double value, const Interval& interval, int n);

/** Sets verdict and would_decide by the rule. */
void Judge(ArgumentNumber& number);

/** "-23 ms (-41 to -9), 21 scenes, 2 left out: .."; what is missing where there is no number. */
std::string FormatNumber(const ArgumentNumber& number);

/** Something that was not run, and the command that runs it. */
struct NotRun {
  std::string what, command;
};

/** One of the five. */
struct ArgumentQuestion {
  const char* id;        ///< "a"
  const char* title;     ///< "People"
  const char* question;  ///< in plain English
  const char* shown;     ///< the answer, one sentence each
  const char* refuted;
  const char* open;
};
inline constexpr int kNumArgumentClaims = 5;
extern const ArgumentQuestion kArgumentQuestions[kNumArgumentClaims];

struct ArgumentClaim {
  const ArgumentQuestion* question = nullptr;
  std::vector<ArgumentNumber> numbers;  ///< those that decide first
  std::vector<NotRun> not_run;
  ArgumentVerdict verdict = ArgumentVerdict::kNotDecided;

  bool was_run() const;  ///< a number that decides is there
  /** The one to name: of those that decide the first with the claim's verdict; null: none. */
  const ArgumentNumber* headline() const;
  /** The answer, and where those that decide differ what each says. */
  std::string sentence() const;
  std::string would_decide() const;  ///< empty where it is decided
};

/** By the numbers that decide. */
ArgumentVerdict JudgeClaim(const std::vector<ArgumentNumber>& numbers);

/** A row for each number, as the page and argument.json have it. */
std::vector<CsvColumn<ArgumentNumber>> ListArgumentColumns();

/** {claims: [{id, question, verdict, sentence, would_decide, number, numbers, not_run}]}. */
Json ToJson(const std::vector<ArgumentClaim>& claims);

/** A line a claim: "(a) not decided  sentence; number". */
std::string FormatArgument(const std::vector<ArgumentClaim>& claims);

}  // namespace graspbench
