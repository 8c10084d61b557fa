#include "datasets/analysis/schedules/schedule_comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "core/base/text/text.h"
#include "core/base/units.h"
#include "core/statistics/summary.h"
#include "datasets/plan/grasp_choice.h"

namespace graspbench {

namespace fs = std::filesystem;

namespace {

/** No hand closes faster or slower: such times are in another unit [s]. */
constexpr double kLeastClosing = 0.01, kMostClosing = 30.0;

/** Type 7 with infinite values in their place. */
double CalcQuantile(std::vector<double> values, double probability) {
  std::sort(values.begin(), values.end());
  const double place = probability * static_cast<double>(values.size() - 1);
  const double low = values[static_cast<size_t>(std::floor(place))];
  const double high = values[static_cast<size_t>(std::ceil(place))];
  return low == high ? low : low + (place - std::floor(place)) * (high - low);
}

/** The trial's contacts of the digits, in their order; empty: one is not known. */
std::vector<double> FindTimes(const TrialTouches& trial, const std::vector<std::string>& digits) {
  std::vector<double> times;
  for (const std::string& digit : digits) {
    const auto contact = std::find_if(trial.contacts.begin(), trial.contacts.end(),
                                      [&](const DigitContact& c) { return c.digit == digit; });
    if (contact == trial.contacts.end()) return {};
    times.push_back(std::isnan(contact->time) ? HUGE_VAL : contact->time);
  }
  return times;
}

/** NaN: no digit touched. */
double FindLastTouch(const std::vector<double>& times) {
  double last = kUnset;
  for (const double time : times) {
    if (!std::isinf(time) && !(time <= last)) last = time;
  }
  return last;
}

/** The digits of which no trial says anything. */
std::string ListUnknown(const std::vector<TrialTouches>& trials,
                        const std::vector<std::string>& digits) {
  std::string unknown;
  for (const std::string& digit : digits) {
    const bool is_known = std::any_of(trials.begin(), trials.end(), [&](const auto& trial) {
      return !FindTimes(trial, {digit}).empty();
    });
    if (!is_known) unknown += (unknown.empty() ? "" : ", ") + digit;
  }
  return unknown;
}

Json JsonShare(double share) { return std::isinf(share) ? Json(nullptr) : Json(share); }
double ShareFromJson(const Json& json) { return json.is_null() ? HUGE_VAL : json.get<double>(); }

}  // namespace

const DigitShare& TouchLags::Of(const std::string& digit) const {
  const auto share = std::find_if(shares.begin(), shares.end(),
                                  [&](const DigitShare& known) { return known.digit == digit; });
  GRASPBENCH_DEMAND(share != shares.end(), digit);
  return *share;
}

Answer<TouchLags> SummariseTouches(const std::vector<TrialTouches>& trials,
                                   const std::vector<std::string>& digits) {
  if (trials.empty()) return NoAnswer{"there is no trial"};
  const std::string unknown = ListUnknown(trials, digits);
  if (!unknown.empty()) return NoAnswer{"no contact is known of " + unknown};
  TouchLags lags;
  std::vector<double> closing, gft;
  std::vector<std::vector<double>> shares(digits.size());
  for (const TrialTouches& trial : trials) {
    const std::vector<double> times = FindTimes(trial, digits);
    const double first = times.empty() ? 0.0 : *std::min_element(times.begin(), times.end());
    const double length = FindLastTouch(times) - trial.start;
    if (times.empty() || std::isnan(trial.start) || first < trial.start || length <= 0.0) {
      ++lags.num_left_out;
      continue;
    }
    ++lags.num_trials;
    const bool is_touched = !std::isinf(first);
    if (is_touched) closing.push_back(length);
    const double last = *std::max_element(times.begin(), times.end());
    gft.push_back(is_touched ? last - first : HUGE_VAL);
    for (size_t i = 0; i < digits.size(); ++i) {
      shares[i].push_back(is_touched ? (times[i] - first) / length : HUGE_VAL);
    }
  }
  if (lags.num_trials == 0) {
    return NoAnswer{"none of " + FormatCount(lags.num_left_out, "trial") +
                    " has a known start of closure and known contacts after it"};
  }
  if (closing.empty()) return NoAnswer{"no digit touched in any trial"};
  lags.closing_time = CalcMedian(closing);
  if (lags.closing_time < kLeastClosing || lags.closing_time > kMostClosing) {
    return NoAnswer{"closing takes " + FormatJson(lags.closing_time) +
                    " s in the median; expected 0.01 to 30 s: are its times in seconds?"};
  }
  lags.gft = CalcMedian(gft);
  for (size_t i = 0; i < digits.size(); ++i) {
    const auto is_never = [](double share) { return std::isinf(share); };
    lags.shares.push_back(
        {digits[i], CalcQuantile(shares[i], 0.25), CalcQuantile(shares[i], 0.5),
         CalcQuantile(shares[i], 0.75),
         static_cast<int>(std::count_if(shares[i].begin(), shares[i].end(), is_never))});
  }
  return lags;
}

Json ToJson(const TouchLags& lags) {
  Json shares = Json::array();
  for (const DigitShare& share : lags.shares) {
    shares.push_back({{"digit", share.digit},
                      {"low", JsonShare(share.low)},
                      {"median", JsonShare(share.median)},
                      {"high", JsonShare(share.high)},
                      {"never", share.num_never}});
  }
  return {{"trials", lags.num_trials},
          {"left_out", lags.num_left_out},
          {"closing_time_s", lags.closing_time},
          {"gft_s", JsonShare(lags.gft)},
          {"shares", shares}};
}

TouchLags TouchLagsFromJson(const Json& json) {
  TouchLags lags;
  lags.num_trials = json.at("trials").get<int>();
  lags.num_left_out = json.at("left_out").get<int>();
  lags.closing_time = json.at("closing_time_s").get<double>();
  lags.gft = ShareFromJson(json.at("gft_s"));
  for (const Json& share : json.at("shares")) {
    lags.shares.push_back({share.at("digit").get<std::string>(), ShareFromJson(share.at("low")),
                           ShareFromJson(share.at("median")), ShareFromJson(share.at("high")),
                           share.at("never").get<int>()});
  }
  return lags;
}

namespace {

constexpr char kPeoplePath[] = "inputs/grasps/people.json";

using Place = std::tuple<std::string, std::string, std::string>;  // hand, object, natural grasp

TrialTouches FindTouches(const TrialRecord& record) {
  return {record.plan.object, 0.0, record.result.contacts};
}

/** Of the first trial in which hand and object were. */
std::vector<std::string> ListDigits(const CellSummary& cell) {
  std::vector<std::string> digits;
  for (const TrialRecord* record : cell.records) {
    for (const DigitContact& contact : record->result.contacts) {
      digits.push_back(std::string(contact.digit));
    }
    if (!digits.empty()) break;
  }
  return digits;
}

struct Threshold {
  double value = 0.0;
  bool is_at_most = false;  ///< the least grip holds
};

/** NaN: not known. */
double CalcRatio(const Threshold& own, const Threshold& natural) {
  const bool never_held = std::isinf(own.value) && std::isinf(natural.value);
  if (never_held || (own.is_at_most && natural.is_at_most)) return kUnset;
  return std::isinf(natural.value) ? 0.0 : own.value / natural.value;
}

/** A draw's threshold by cell and number. */
using DrawThresholds = std::map<std::pair<std::string, int>, Threshold>;

DrawThresholds ListByDraw(const ThresholdSummary& summary) {
  DrawThresholds values;
  for (const DrawThreshold& draw : summary.draws) {
    if (std::isnan(draw.value)) continue;
    values[{draw.draw.hand + "\n" + draw.draw.object + "\n" + draw.draw.grasp, draw.draw.trial}] = {
        draw.value, draw.found.is_below_range};
  }
  return values;
}

std::string MakeKey(const CellSummary& cell) {
  return cell.hand + "\n" + cell.object + "\n" + cell.grasp;
}

void AddThreshold(const CellSummary& cell, const CellSummary* natural,
                  const ThresholdSummary& summary, const DrawThresholds& values, ScheduleRow& row) {
  for (const CellThreshold& known : summary.cells) {
    const bool is_this = known.condition.empty() && known.hand == cell.hand &&
                         known.object == cell.object && known.grasp == cell.grasp;
    if (!is_this || known.num_draws == 0) continue;
    row.threshold = known.median;
    row.threshold_text = FormatMedian(*summary.scale, known);
  }
  if (natural == nullptr || !row.missed.empty()) return;
  std::vector<double> ratios;
  for (const TrialRecord* record : cell.records) {
    const auto own = values.find({MakeKey(cell), record->plan.trial});
    const auto other = values.find({MakeKey(*natural), record->plan.trial});
    if (own == values.end() || other == values.end()) continue;
    ++row.num_pairs;
    const double ratio = CalcRatio(own->second, other->second);
    if (std::isnan(ratio)) {
      ++row.num_not_known;
    } else {
      ratios.push_back(ratio);
    }
  }
  if (2 * ratios.size() <= static_cast<size_t>(row.num_pairs)) return;
  row.ratio = CalcMedian(ratios);
  row.interval = CalcMedianInterval(ratios);
}

ScheduleRow MakeRow(const std::string& schedule, const CellSummary& cell,
                    const std::vector<std::string>& digits) {
  std::vector<TrialTouches> trials;
  for (const TrialRecord* record : cell.records) {
    if (record->result.outcome != Outcome::kNumericalFailure) {
      trials.push_back(FindTouches(*record));
    }
  }
  return {schedule, SummariseTouches(trials, digits), cell.tally};
}

/** "GFT is 28 % of the closing time, where its label allows 10 %"; empty: it is as its label says.
Without people nobody knows when theirs touch. */
std::string FindMiss(const ScheduleRow& row, const Answer<TouchLags>& people) {
  if (row.schedule == kNatural || !row.lags) return "";
  const auto percent = [](double share) {
    return std::isinf(share) ? std::string("never") : FormatFixed(100.0 * share, 0) + " %";
  };
  const std::string most = FormatFixed(100.0 * kMostLabelError, 0);
  if (row.schedule == kSimultaneous) {
    const double share = row.lags->gft / row.lags->closing_time;
    if (share <= kMostLabelError) return "";
    if (std::isinf(share)) return "a digit does not touch in at least half of the trials";
    return "GFT is " + FormatFixed(MsFromS(row.lags->gft), 0) + " ms, " + percent(share) +
           " of the closing time, at most " + most + " % allowed";
  }
  if (!people) return "it cannot be checked without participants: " + people.reason();
  const DigitShare* worst = nullptr;
  double error = kMostLabelError;
  for (const DigitShare& share : row.lags->shares) {
    const double own = std::abs(share.median - people->Of(share.digit).median);
    if (own <= error) continue;
    worst = &share;
    error = own;
  }
  return worst == nullptr
             ? ""
             : worst->digit + " touches at " + percent(worst->median) +
                   " of the closing time, people's at " + percent(people->Of(worst->digit).median) +
                   ", at most " + most + " points apart allowed";
}

Json ToJson(const PeopleOnObject& cell) {
  return {{"hand", cell.hand},
          {"object", cell.object},
          {"grasp", cell.grasp},
          {"digits", cell.digits},
          {"people", cell.people ? ToJson(*cell.people) : Json()},
          {"not_compared", cell.people ? "" : cell.people.reason()},
          {"missing", cell.missing}};
}

}  // namespace

ScheduledGrasp SplitSchedule(const std::string& id) {
  for (const std::string schedule : kSchedules) {
    const std::string ending = "-" + schedule;
    if (id.size() <= ending.size()) continue;
    const size_t place = id.size() - ending.size();
    if (id.compare(place, ending.size(), ending) == 0) return {id.substr(0, place), schedule};
  }
  return {id, kNatural};
}

const PeopleOnObject* PeopleFile::Find(const std::string& hand, const std::string& object,
                                       const std::string& grasp) const {
  for (const PeopleOnObject& cell : cells) {
    if (cell.hand == hand && cell.object == object && cell.grasp == grasp) return &cell;
  }
  return nullptr;
}

Json ToJson(const PeopleFile& people) {
  Json cells = Json::array();
  for (const PeopleOnObject& cell : people.cells) cells.push_back(ToJson(cell));
  return {{"study", people.study}, {"cells", cells}};
}

PeopleFile PeopleFileFromJson(const Json& json, const std::string& file) {
  try {
    PeopleFile people;
    people.study = json.at("study").get<std::string>();
    for (const Json& cell : json.at("cells")) {
      PeopleOnObject made = {cell.at("hand").get<std::string>(),
                             cell.at("object").get<std::string>(),
                             cell.at("grasp").get<std::string>(),
                             cell.at("digits").get<std::vector<std::string>>(),
                             NoAnswer{cell.at("not_compared").get<std::string>()},
                             cell.at("missing").get<std::map<std::string, std::string>>()};
      if (!cell.at("people").is_null()) made.people = TouchLagsFromJson(cell.at("people"));
      people.cells.push_back(std::move(made));
    }
    return people;
  } catch (const Json::exception& e) {
    throw Error(ErrorKind::kFormat,
                "\"" + file + "\" does not provide human contact times: " + e.what() +
                    "; remove its session's folder and run graspbench simultaneity --schedules "
                    "again");
  }
}

Answer<TouchLags> SummarisePeople(const std::vector<TrialTouches>& people,
                                  const std::string& object,
                                  const std::vector<std::string>& digits) {
  std::vector<TrialTouches> trials;
  std::set<std::string> known;
  for (const TrialTouches& trial : people) {
    known.insert(trial.object);
    if (trial.object == object) trials.push_back(trial);
  }
  if (trials.empty()) {
    return NoAnswer{"people grasped no " + object + " in an included trial, but " +
                    fmt::format("{}", fmt::join(known, ", "))};
  }
  return SummariseTouches(trials, digits);
}

ScheduleComparison CompareSchedules(const Session& session, const PeopleFile& people,
                                    const std::vector<ThresholdSummary>& thresholds) {
  ScheduleComparison comparison;
  comparison.study = people.study;
  const ThresholdSummary* known = thresholds.empty() ? nullptr : &thresholds.front();
  if (known) comparison.scale = known->scale;
  const DrawThresholds values = known ? ListByDraw(*known) : DrawThresholds();
  const SessionSummary summary = SummariseSession(session);
  std::map<Place, size_t> places;
  std::map<Place, const CellSummary*> natural;
  for (const CellSummary& cell : summary.cells) {
    const ScheduledGrasp grasp = SplitSchedule(cell.grasp);
    if (grasp.schedule == kNatural) natural[{cell.hand, cell.object, grasp.grasp}] = &cell;
  }
  for (const CellSummary& cell : summary.cells) {
    if (cell.grasp == kBySight) continue;
    const ScheduledGrasp grasp = SplitSchedule(cell.grasp);
    const Place place = {cell.hand, cell.object, grasp.grasp};
    const auto [found, is_new] = places.emplace(place, comparison.cells.size());
    if (is_new) {
      const PeopleOnObject* on = people.Find(cell.hand, cell.object, grasp.grasp);
      PeopleOnObject none = {cell.hand, cell.object, grasp.grasp, ListDigits(cell), {}, {}};
      comparison.cells.push_back({on ? *on : none, {}});
    }
    ScheduleCell& made = comparison.cells[found->second];
    ScheduleRow row = MakeRow(grasp.schedule, cell, made.of.digits);
    const auto other = natural.find(place);
    row.missed = FindMiss(row, made.of.people);
    if (known) {
      AddThreshold(cell, other == natural.end() ? nullptr : other->second, *known, values, row);
    }
    made.rows.push_back(std::move(row));
  }
  return comparison;
}

std::vector<std::string> DescribeUnknown(const ScheduleCell& cell) {
  std::vector<std::string> texts;
  for (const ScheduleRow& row : cell.rows) {
    if (row.schedule == kNatural) continue;
    if (!row.missed.empty()) {
      texts.push_back(row.schedule +
                      ": does not match its label and is not compared: " + row.missed);
    }
    if (row.num_not_known > 0) {
      texts.push_back(
          fmt::format("{}: {} of {} draws have no ratio, because the smallest grip succeeds under "
                      "both schedules or no grip does",
                      row.schedule, row.num_not_known, row.num_pairs));
    }
  }
  return texts;
}

PeopleFile LoadPeopleFile(const fs::path& folder) {
  const fs::path file = folder / kPeoplePath;
  return PeopleFileFromJson(Json::try_parse(ReadFile(file)), file.string());
}

std::vector<ScheduleComparison> LoadSchedules(const Session& session) {
  std::vector<ScheduleComparison> all;
  if (session.folder.empty()) return all;
  for (const std::string& name : ListMatches(session.folder, {"schedules/*"})) {
    const fs::path folder = session.folder / name;
    if (!HasSession(folder)) continue;
    const Session scheduled = LoadSession(folder, OnDamage::kAccept, RecordParts::kBrief);
    all.push_back(CompareSchedules(scheduled, LoadPeopleFile(folder), LoadThresholds(scheduled)));
    all.back().folder = name;
  }
  return all;
}

Json ToJson(const ScheduleComparison& comparison) {
  Json cells = Json::array();
  for (const ScheduleCell& cell : comparison.cells) {
    Json json = ToJson(cell.of);
    json["schedules"] = Json::array();
    for (const ScheduleRow& row : cell.rows) {
      json["schedules"].push_back(
          {{"schedule", row.schedule},
           {"lags", row.lags ? ToJson(*row.lags) : Json()},
           {"not_compared", row.lags ? row.missed : row.lags.reason()},
           {"trials", row.tally.finished},
           {"successes", row.tally.successes()},
           {"threshold", JsonNumber(row.threshold)},
           {"pairs", row.num_pairs},
           {"pairs_not_known", row.num_not_known},
           {"threshold_ratio", JsonNumber(row.ratio)},
           {"ratio_low", row.interval ? JsonNumber(row.interval->low) : Json()},
           {"ratio_high", row.interval ? JsonNumber(row.interval->high) : Json()}});
    }
    cells.push_back(std::move(json));
  }
  return {{"folder", comparison.folder},
          {"study", comparison.study},
          {"scale", comparison.scale ? Json(comparison.scale->name) : Json()},
          {"cells", cells}};
}

}  // namespace graspbench
