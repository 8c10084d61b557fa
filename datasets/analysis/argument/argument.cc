#include "datasets/analysis/argument/argument.h"

#include <algorithm>
#include <cmath>

#include "core/base/text/text.h"
#include "objects/catalogue.h"

namespace graspbench {

const ArgumentMeasure kPeopleRatio = {
    "people's GFT over that of digits that move independently",
    "",
    2,
    1.0,
    0.1,
    -1.0,
    "Shown: the study's own verdict is \"more simultaneous\". All its clocks must agree on it, and "
    "the digits must share more variation than an error of the clock explains. Refuted: the whole "
    "interval lies right of 0.90 (marked) and is not all left of 1. The value is that of the "
    "clock with the smallest difference. The interval covers the intervals of all clocks."};
const ArgumentMeasure kLateSuccess = {
    "change of success by 100 ms of delay of the last digit",
    "points",
    1,
    0.0,
    2.0,
    -1.0,
    "Shown: the interval lies left of 0 and the test by random signs of the objects gives p of at "
    "most 0.05. This p is adjusted for all hands and both late digits of the map. Refuted: the "
    "whole interval lies within 2 points of 0 (marked), or it lies right of 0 with such a p. "
    "An interval that meets both is shown. Where 97.5 % or more succeed without delay, an interval "
    "within 2 points is a ceiling and decides nothing."};
const ArgumentMeasure kLateThreshold = {
    "change of the smallest grip that holds, by 100 ms of delay",
    "doublings",
    3,
    0.0,
    0.07,
    1.0,
    "Shown: the interval lies right of 0, with p as for success. Refuted: the whole interval lies "
    "within 0.07 of 0, or it lies left of 0 with such a p."};
const ArgumentMeasure kFormingTime = {"GFT after step 1 less GFT before", "ms", 0, 0.0, 10.0, -1.0};
const ArgumentMeasure kStability = {
    "stability with the new target posture over that before", "", 2, 1.0, 0.05, 1.0};
const ArgumentMeasure kSuccessChange = {
    "success of optimised grasps less that of the grasps before", "points", 1, 0.0, 2.0, 1.0};

const ArgumentQuestion kArgumentQuestions[kNumArgumentClaims] = {
    {"a", "People", "Do people bring their digits to an object at the same time?",
     "People's digits touch more simultaneously than digits that move independently would.",
     "People's digits touch no more simultaneously than digits that move independently would.",
     "It is not decided whether people's digits touch more simultaneously than independent digits "
     "would."},
    {"b", "Robots", "Does it help a robot hand when its digits touch at the same time?",
     "A late last digit lowers the success rate, so simultaneous contact helps.",
     "A delay of the last digit by 100 ms does not lower the success rate by as much as 2 points.",
     "It is not decided whether a late last digit lowers the success rate."},
    {"c", "Step 1", "Does the learned pre-grasp make the contacts simultaneous?",
     "The learned pre-grasp brings the digits to the object closer together in time.",
     "The learned pre-grasp does not bring the digits closer together in time by as much as 10 ms.",
     "It is not decided whether the learned pre-grasp brings the digits closer together in time."},
    {"d", "Step 2", "Does the thumb's target posture make a grasp more stable?",
     "An evolved target posture of the thumb makes grasps more stable.",
     "An evolved target posture of the thumb does not make grasps more stable by as much as 5 %.",
     "It is not decided whether an evolved target posture of the thumb makes grasps more stable."},
    {"e", "Success", "Do both hands succeed more often after the optimisation?",
     "Optimised grasps succeed more often than the grasps before.",
     "The optimisation does not raise success by as much as 2 points.",
     "It is not decided whether optimised grasps succeed more often than the grasps before."}};

namespace {

/** " points"; empty for a factor. */
std::string FormatUnit(const ArgumentMeasure& measure) {
  return *measure.unit ? std::string(" ") + measure.unit : "";
}

/** A smallest effect, or the line that it draws. */
std::string FormatLeast(const ArgumentMeasure& measure, double value) {
  return FormatFixed(value, measure.least < 1.0 ? 2 : 0) + FormatUnit(measure);
}

/** So many that no end of the interval is rounded onto the null value. */
int CountDecimals(const ArgumentNumber& number) {
  const double null_value = number.measure->null_value;
  int decimals = number.measure->decimals;
  const auto is_hidden = [&](double end) {
    return std::abs(end - null_value) > 1e-9 &&
           FormatFixed(end, decimals) == FormatFixed(null_value, decimals);
  };
  const int most = decimals + 3;
  while (decimals < most && (is_hidden(number.interval.low) || is_hidden(number.interval.high))) {
    ++decimals;
  }
  return decimals;
}

}  // namespace

ArgumentVerdict JudgeNumber(const ArgumentMeasure& measure, const Interval& interval) {
  const double one = measure.sign * (interval.low - measure.null_value);
  const double other = measure.sign * (interval.high - measure.null_value);
  if (std::min(one, other) > 0.0) return ArgumentVerdict::kShown;
  return std::max(one, other) < measure.least ? ArgumentVerdict::kRefuted
                                              : ArgumentVerdict::kNotDecided;
}

int CountToDecide(const ArgumentMeasure& measure, double value, const Interval& interval, int n) {
  const double half_width = 0.5 * (interval.high - interval.low);
  const double size = std::abs(value - measure.null_value);
  const double wanted = std::max(size, measure.least - size);
  const double count = std::ceil(n * std::pow(half_width / wanted, 2.0));
  return std::isfinite(count) && count > n ? static_cast<int>(std::min(count, 1e9)) : 0;
}

void Judge(ArgumentNumber& number) {
  number.verdict = ArgumentVerdict::kNotDecided;
  // Comparisons with NaN are false, so that a number without an interval stays undecided.
  if (std::isfinite(number.interval.low) && std::isfinite(number.interval.high)) {
    number.verdict = JudgeNumber(*number.measure, number.interval);
  }
  const ArgumentMeasure& measure = *number.measure;
  const double best = measure.sign > 0.0 ? number.interval.high : -number.interval.low;
  const bool is_opposite = best < measure.sign * measure.null_value - measure.least;
  if (number.verdict == ArgumentVerdict::kRefuted && number.room < measure.least && !is_opposite) {
    number.verdict = ArgumentVerdict::kNotDecided;
    number.why = "ceiling: at most " + FormatFixed(number.room, measure.decimals) +
                 FormatUnit(measure) + " are possible, fewer than the smallest effect of " +
                 FormatLeast(measure, measure.least);
    number.would_decide = "harder objects or draws, on which more can be gained";
  }
  if (number.verdict != ArgumentVerdict::kNotDecided || !number.would_decide.empty()) return;
  const int wanted = CountToDecide(*number.measure, number.value, number.interval, number.n);
  number.would_decide =
      wanted > 0 ? FormatWanted(wanted, number.n, number.of) : "more " + number.of + "s";
}

std::string DescribeRule(const ArgumentMeasure& measure) {
  if (*measure.rule) return measure.rule;
  const bool is_more = measure.sign > 0.0;
  const char* const claimed = is_more ? "right" : "left";
  const char* const other = is_more ? "left" : "right";
  const double line = measure.null_value + measure.sign * measure.least;
  return std::string("Shown: the whole interval lies ") + claimed + " of " +
         FormatFixed(measure.null_value, 0) + ". Refuted: the whole interval lies " + other +
         " of " + FormatLeast(measure, line) + " (marked), so that an effect of " +
         FormatLeast(measure, measure.least) +
         " is excluded. An interval that meets both is shown.";
}

std::string FormatWanted(int wanted, int n, const std::string& of) {
  std::string text = "about " + FormatCount(wanted, of) + " instead of " + std::to_string(n);
  const int num_known = static_cast<int>(ListObjects().size());
  if ((of == "object" || of == "scene") && wanted > num_known) {
    text += ", if the others vary alike; the catalogue has " + FormatCount(num_known, "object");
  }
  return text;
}

std::string FormatVerdict(const ArgumentNumber& number) {
  return NameOf(number.verdict) + (number.why.empty() ? "" : " (" + number.why + ")");
}

std::string FormatNumber(const ArgumentNumber& number) {
  const int decimals = CountDecimals(number);
  std::string text = std::isfinite(number.value)
                         ? FormatFixed(number.value, decimals) + FormatUnit(*number.measure)
                         : std::string("n/a");
  if (std::isfinite(number.interval.low)) {
    text += " (" + FormatRange(number.interval.low, number.interval.high, decimals) + ")";
  } else {
    text += " (no interval)";
  }
  text += ", " + FormatCount(number.n, number.of);
  return number.left_out.empty() ? text : text + "; left out: " + number.left_out;
}

namespace {

std::string FormatClaimLine(const ArgumentClaim& claim) {
  const ArgumentNumber* const number = claim.headline();
  std::string line =
      std::string("(") + claim.question->id + ") " + FormatVerdict(claim) + ": " + claim.sentence();
  if (number == nullptr) {
    if (!claim.not_run.empty()) line += " Command: " + claim.not_run.front().command;
    return line + "\n";
  }
  line += " " + Capitalise(number->measure->text) + ", " + number->subject + ": " +
          FormatNumber(*number) + ".";
  if (claim.verdict == ArgumentVerdict::kNotDecided) {
    line += " Would decide: " + claim.would_decide() + ".";
  }
  return line + "\n";
}

}  // namespace

std::string FormatVerdict(const ArgumentClaim& claim) {
  return claim.was_run() ? NameOf(claim.verdict) : "not run";
}

bool ArgumentClaim::was_run() const { return headline() != nullptr; }

const ArgumentNumber* ArgumentClaim::headline() const {
  const ArgumentNumber* first = nullptr;
  for (const ArgumentNumber& number : numbers) {
    if (!number.decides) continue;
    if (number.verdict == verdict) return &number;
    if (first == nullptr) first = &number;
  }
  return first;
}

std::string ArgumentClaim::sentence() const {
  std::string text = verdict == ArgumentVerdict::kShown     ? question->shown
                     : verdict == ArgumentVerdict::kRefuted ? question->refuted
                                                            : question->open;
  const bool is_more = std::any_of(numbers.begin(), numbers.end(), [&](const ArgumentNumber& one) {
    return one.decides && (one.verdict != verdict || !one.why.empty());
  });
  if (!is_more) return text;
  for (const auto& row : kArgumentVerdicts) {
    std::string subjects;
    for (const ArgumentNumber& number : numbers) {
      if (!number.decides || number.verdict != row.value) continue;
      subjects += (subjects.empty() ? "" : ", ") + number.subject +
                  (number.why.empty() ? "" : " (" + number.why + ")");
    }
    if (!subjects.empty()) text += " " + Capitalise(row.name) + ": " + subjects + ".";
  }
  return text;
}

std::string ArgumentClaim::would_decide() const {
  if (verdict != ArgumentVerdict::kNotDecided) return "";
  const auto num_deciding =
      std::count_if(numbers.begin(), numbers.end(), [](const auto& n) { return n.decides; });
  std::string text;
  for (const ArgumentNumber& number : numbers) {
    if (!number.decides || number.would_decide.empty()) continue;
    text += (text.empty() ? "" : "; ") + (num_deciding > 1 ? number.subject + ": " : "") +
            number.would_decide;
  }
  return text.empty() && !not_run.empty() ? not_run.front().command : text;
}

ArgumentVerdict JudgeClaim(const std::vector<ArgumentNumber>& numbers) {
  bool is_any = false, all_shown = true;
  for (const ArgumentNumber& number : numbers) {
    if (!number.decides) continue;
    if (number.verdict == ArgumentVerdict::kRefuted) return ArgumentVerdict::kRefuted;
    is_any = true;
    all_shown = all_shown && number.verdict == ArgumentVerdict::kShown;
  }
  return is_any && all_shown ? ArgumentVerdict::kShown : ArgumentVerdict::kNotDecided;
}

std::vector<CsvColumn<ArgumentNumber>> ListArgumentColumns() {
  using Row = ArgumentNumber;
  using C = CsvColumn<Row>;
  return {
      C("subject", "", "hand or study, and the experiment", &Row::subject).Shown("of"),
      C("measure", "", "what the number is",
        [](const Row& row) { return std::string(row.measure->text); }),
      C("unit", "", "of the number",
        [](const Row& row) {
          return std::string(*row.measure->unit ? row.measure->unit : "factor");
        }),
      C("value", "", "estimate", &Row::value),
      C("low", "", "lower end of the 95 % interval",
        [](const Row& row) { return row.interval.low; }),
      C("high", "", "upper end of the 95 % interval",
        [](const Row& row) { return row.interval.high; }),
      C("n", "", "how many", &Row::n),
      C("of", "", "what n counts", &Row::of),
      C("left_out", "", "number left out and reason", &Row::left_out),
      C::ForPeople("value, 95 % interval, n", "n is followed by the number left out", FormatNumber),
      C("decides", "", "1 if it decides the claim", &Row::decides)
          .Shown("decides", [](const Row& row) { return row.decides ? "yes" : "no"; }),
      C("verdict", "", "verdict by the rule of this number",
        [](const Row& row) {
          return std::string(NameOf(row.verdict));
        }).Shown("verdict"),
      C("why", "", "why it is not decided although the interval would", &Row::why),
      C("would_decide", "", "what would decide an undecided number", &Row::would_decide),
      C("detail", "", "related figures", &Row::detail),
      C("source", "", "folders", &Row::source),
      C("command", "", "that made it", &Row::command)};
}

Json ToJson(const std::vector<ArgumentClaim>& claims) {
  Json list = Json::array();
  for (const ArgumentClaim& claim : claims) {
    Json not_run = Json::array();
    for (const NotRun& one : claim.not_run) {
      not_run.push_back({{"what", one.what}, {"command", one.command}});
    }
    const ArgumentNumber* const number = claim.headline();
    const auto columns = ListArgumentColumns();
    list.push_back({{"id", claim.question->id},
                    {"question", claim.question->question},
                    {"verdict", NameOf(claim.verdict)},
                    {"was_run", claim.was_run()},
                    {"sentence", claim.sentence()},
                    {"would_decide", claim.would_decide()},
                    {"number", number ? MakeJsonRows(columns, {*number}).at(0) : Json()},
                    {"numbers", MakeJsonRows(columns, claim.numbers)},
                    {"not_run", not_run}});
  }
  return {{"claims", list}};
}

std::string FormatArgument(const std::vector<ArgumentClaim>& claims) {
  std::string text;
  for (const ArgumentClaim& claim : claims) text += FormatClaimLine(claim);
  return text;
}

}  // namespace graspbench
