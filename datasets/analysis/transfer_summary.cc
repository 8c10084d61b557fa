#include "datasets/analysis/transfer_summary.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <tuple>

#include "core/base/files/files.h"
#include "core/base/text/text.h"
#include "core/base/units.h"
#include "core/statistics/summary.h"
#include "datasets/analysis/conditions/threshold_summary.h"

namespace graspbench {
namespace {

constexpr double kNearPad = 0.002;  // [m]
constexpr const char* kRehearsedId = "rehearsed";

enum class TransferSide { kTransferred, kPlayed, kRehearsed, kStandard };

/** The grasp without its course; empty: it is not a played one. */
std::string FindStill(const std::string& grasp) {
  const std::string suffix = kPlayedSuffix;
  if (grasp.size() <= suffix.size()) return "";
  const size_t end = grasp.size() - suffix.size();
  return grasp.compare(end, suffix.size(), suffix) == 0 ? grasp.substr(0, end) : "";
}

/** Which of them a planned grasp is. */
class TransferSides {
 public:
  explicit TransferSides(const TransferFile& file) {
    for (const TransferRow& row : file.rows) ids_.insert(row.grasp);
  }
  TransferSide Find(const PlannedTrial& planned) const {
    if (ids_.count(planned.grasp) > 0) return TransferSide::kTransferred;
    if (ids_.count(FindStill(planned.grasp)) > 0) return TransferSide::kPlayed;
    return planned.grasp.rfind(kRehearsedId, 0) == 0 ? TransferSide::kRehearsed
                                                     : TransferSide::kStandard;
  }

 private:
  std::set<std::string> ids_;
};

double MedianOf(std::vector<double> values) { return values.empty() ? kUnset : CalcMedian(values); }

/** Successes of the transferred grasps of each draw, in the mean, less those of another side. */
ChangeEstimate EstimateTransfer(const std::vector<const TrialRecord*>& records,
                                const TransferSides& sides, TransferSide other) {
  struct Draw {
    double own = 0.0, others = 0.0;
    int num_own = 0, num_others = 0;
  };
  std::map<std::tuple<std::string, int>, Draw> draws;  // by object and trial
  std::set<const TrialRecord*> compared;
  for (const TrialRecord* record : records) {
    const TransferSide side = sides.Find(record->plan);
    if (side != TransferSide::kTransferred && side != other) continue;
    compared.insert(record);
    Draw& draw = draws[{record->plan.object, record->plan.trial}];
    const double success = IsSuccess(record->result.outcome) ? 1.0 : 0.0;
    (side == other ? draw.others : draw.own) += success;
    ++(side == other ? draw.num_others : draw.num_own);
  }
  ObjectChanges changes;
  for (const auto& [key, draw] : draws) {
    if (draw.num_own == 0 || draw.num_others == 0) continue;
    changes[std::get<0>(key)].push_back(draw.own / draw.num_own - draw.others / draw.num_others);
  }
  return EstimateSuccessChange(changes, std::nullopt, ExplainUndecided(CountOutcomes(compared)));
}

/** Successes of played grasps less those of the same grasps without the course, by draw. */
ChangeEstimate EstimatePlaying(const std::vector<const TrialRecord*>& records,
                               const TransferSides& sides) {
  std::map<std::tuple<std::string, std::string, int>, double> still;
  std::set<const TrialRecord*> compared;
  const auto success = [](const TrialRecord& record) {
    return IsSuccess(record.result.outcome) ? 1.0 : 0.0;
  };
  for (const TrialRecord* record : records) {
    const PlannedTrial& plan = record->plan;
    if (sides.Find(plan) != TransferSide::kTransferred) continue;
    still[{plan.object, plan.grasp, plan.trial}] = success(*record);
    compared.insert(record);
  }
  ObjectChanges changes;
  for (const TrialRecord* record : records) {
    const PlannedTrial& plan = record->plan;
    if (sides.Find(plan) != TransferSide::kPlayed) continue;
    const auto same = still.find({plan.object, FindStill(plan.grasp), plan.trial});
    if (same == still.end()) continue;
    changes[plan.object].push_back(success(*record) - same->second);
    compared.insert(record);
  }
  return EstimateSuccessChange(changes, std::nullopt, ExplainUndecided(CountOutcomes(compared)));
}

/** What the trials of one side have of both [-], [N]. */
struct LoadValues {
  std::vector<double> thresholds, forces;

  TransferLoads Take() const { return {MedianOf(thresholds), MedianOf(forces)}; }
};

/** @param thresholds  of the session's records; empty: none were looked for. */
TransferSummary SummariseOne(const std::string& hand, const std::string& object,
                             const std::string& type, const TransferFile& file,
                             const Session& session, const TransferSides& sides,
                             const std::vector<double>& thresholds) {
  TransferSummary summary;
  summary.hand = hand;
  summary.object = object;
  summary.type = type;
  std::vector<double> distances, angles;
  std::set<std::pair<std::string, std::string>> own;  // object and grasp
  for (const TransferRow& row : file.rows) {
    if (row.hand != hand || (!object.empty() && row.object != object)) continue;
    if (!type.empty() && row.type != type) continue;
    own.insert({row.object, row.grasp});
    ++summary.num_grasps;
    if (!row.not_transferable.empty()) continue;
    ++summary.num_transferred;
    for (const TransferPad& pad : row.pads) {
      if (!pad.is_reached) continue;
      distances.push_back(pad.distance);
      angles.push_back(pad.angle);
    }
  }
  const auto num_near = std::count_if(distances.begin(), distances.end(),
                                      [](double distance) { return distance <= kNearPad; });
  summary.near_share = CalcShare(num_near, static_cast<int64_t>(distances.size()));
  summary.median_distance = MedianOf(distances);
  summary.median_angle = MedianOf(angles);
  std::vector<const TrialRecord*> records;
  std::map<TransferSide, LoadValues> loads;
  for (size_t i = 0; i < session.records.size(); ++i) {
    const TrialRecord& record = session.records[i];
    if (record.plan.hand != hand || (!object.empty() && record.plan.object != object)) continue;
    const TransferSide side = sides.Find(record.plan);
    const bool is_played = side == TransferSide::kPlayed;
    const std::string grasp = is_played ? FindStill(record.plan.grasp) : record.plan.grasp;
    const bool is_own = own.count({record.plan.object, grasp}) > 0;
    if ((is_played || side == TransferSide::kTransferred) && !is_own) continue;
    records.push_back(&record);
    if (!thresholds.empty() && !std::isnan(thresholds[i])) {
      loads[side].thresholds.push_back(thresholds[i]);
    }
    if (record.judgement && !std::isnan(record.judgement->breaking_force)) {
      loads[side].forces.push_back(record.judgement->breaking_force);
    }
    (side == TransferSide::kTransferred ? summary.transferred
     : is_played                        ? summary.played
     : side == TransferSide::kRehearsed ? summary.rehearsed
                                        : summary.standard)
        .Count(record.result.outcome);
  }
  summary.loads = loads[TransferSide::kTransferred].Take();
  summary.loads_played = loads[TransferSide::kPlayed].Take();
  summary.loads_rehearsed = loads[TransferSide::kRehearsed].Take();
  summary.loads_standard = loads[TransferSide::kStandard].Take();
  summary.over_rehearsed = EstimateTransfer(records, sides, TransferSide::kRehearsed);
  summary.of_playing = EstimatePlaying(records, sides);
  summary.over_standard = EstimateTransfer(records, sides, TransferSide::kStandard);
  return summary;
}

template <class Value>
std::vector<std::string> ListOnce(const std::vector<TransferRow>& rows, const Value& value) {
  std::vector<std::string> once;
  for (const TransferRow& row : rows) {
    if (!std::count(once.begin(), once.end(), value(row))) once.push_back(value(row));
  }
  return once;
}

std::string FormatSuccess(const Tally& tally) {
  if (tally.finished == 0) return "no trial";
  const Interval interval = tally.rate_interval();
  return FormatWithRange(100.0 * tally.rate(), 100.0 * interval.low, 100.0 * interval.high, 0);
}

std::string FormatPoints(const ChangeEstimate& change) {
  if (change.num_draws == 0) return "n/a";
  const Interval range = change.interval ? *change.interval : Interval{kUnset, kUnset};
  return FormatWithRange(100.0 * change.estimate, 100.0 * range.low, 100.0 * range.high, 1);
}

}  // namespace

TransferFile LoadTransferFile(const std::filesystem::path& folder) {
  TransferFile file;
  try {
    ReadRecord(Json::parse(ReadFile(folder / kTransferPath)), file);
  } catch (const Json::exception& error) {
    throw Error(ErrorKind::kFormat, (folder / kTransferPath).string() +
                                        " is no list of transferred grasps: " + error.what());
  }
  return file;
}

std::vector<TransferSummary> SummariseTransfers(const TransferFile& file, const Session& session) {
  const TransferSides sides(file);
  std::vector<TransferSummary> summaries;
  std::vector<double> thresholds;  // margins
  for (const ThresholdSummary& found : LoadThresholds(session)) {
    if (thresholds.empty()) thresholds = ListThresholdsOf(session, found);
  }
  const auto hands = ListOnce(file.rows, [](const TransferRow& row) { return row.hand; });
  const auto objects = ListOnce(file.rows, [](const TransferRow& row) { return row.object; });
  for (const std::string& hand : hands) {
    summaries.push_back(SummariseOne(hand, "", "", file, session, sides, thresholds));
  }
  for (const std::string& hand : hands) {
    for (const std::string& object : objects) {
      summaries.push_back(SummariseOne(hand, object, "", file, session, sides, thresholds));
    }
  }
  const auto types = ListOnce(file.rows, [](const TransferRow& row) { return row.type; });
  for (const std::string& hand : hands) {
    for (const std::string& type : types) {
      if (type.empty()) continue;
      const TransferSummary summary =
          SummariseOne(hand, "", type, file, session, sides, thresholds);
      if (summary.num_grasps > 0) summaries.push_back(summary);
    }
  }
  return summaries;
}

std::vector<CsvColumn<TransferSummary>> ListTransferColumns() {
  using Row = TransferSummary;
  using C = CsvColumn<Row>;
  const auto success = [](Tally Row::*side) {
    return [side](const Row& row) { return FormatSuccess(row.*side); };
  };
  return {
      C("hand", "", "", &Row::hand).Shown("hand"),
      C("object", "", "empty: all objects", &Row::object)
          .Shown("object", [](const Row& row) { return row.object.empty() ? "all" : row.object; }),
      C("type", "", "of the standard grasp that they go towards; empty: all", &Row::type)
          .Shown("type", [](const Row& row) { return row.type.empty() ? "all" : row.type; }),
      C("grasps", "", "people's grasps that were tried", &Row::num_grasps).Shown("grasps"),
      C("transferable", "", "of these, those that the hand can do", &Row::num_transferred)
          .Shown("transferable"),
      C("pad_distance_m", "m", "median distance of a pad from the person's contact",
        &Row::median_distance)
          .Shown("pad [mm]",
                 [](const Row& row) { return FormatFixed(MmFromM(row.median_distance), 2); }),
      C("pad_angle_rad", "rad", "median angle between the pad's direction and the surface's normal",
        &Row::median_angle)
          .Shown("angle [deg]",
                 [](const Row& row) { return FormatFixed(DegFromRad(row.median_angle), 0); }),
      C("pads_within_2mm", "", "share of pads", &Row::near_share),
      C("success", "", "success rate of transferred grasps",
        [](const Row& row) {
          return row.transferred.rate();
        }).Shown("success [%]", success(&Row::transferred)),
      C("success_rehearsed", "", "the same of rehearsed grasps",
        [](const Row& row) {
          return row.rehearsed.rate();
        }).Shown("rehearsed [%]", success(&Row::rehearsed)),
      C("success_standard", "", "the same of standard grasps",
        [](const Row& row) {
          return row.standard.rate();
        }).Shown("standard [%]", success(&Row::standard)),
      C("over_rehearsed", "", "success of transferred less rehearsed grasps, same draws",
        [](const Row& row) { return row.over_rehearsed.estimate; })
          .Shown("over rehearsed [points]",
                 [](const Row& row) { return FormatPoints(row.over_rehearsed); }),
      C("over_standard", "", "success of transferred less standard grasps, same draws",
        [](const Row& row) {
          return row.over_standard.estimate;
        }).Shown("over standard [points]", [](const Row& row) {
        return FormatPoints(row.over_standard);
      })};
}

std::vector<CsvColumn<TransferSummary>> ListTransferLoadColumns() {
  using Row = TransferSummary;
  using C = CsvColumn<Row>;
  const auto shown = [](double value) {
    return std::isnan(value) ? "n/a" : std::isinf(value) ? "none held" : FormatFixed(value, 2);
  };
  std::vector<C> columns = {C("hand", "", "", &Row::hand).Shown("hand")};
  const std::pair<const char*, TransferLoads Row::*> sides[] = {
      {"transferred", &Row::loads},
      {"played", &Row::loads_played},
      {"rehearsed", &Row::loads_rehearsed},
      {"standard", &Row::loads_standard}};
  for (const auto& [name, side] : sides) {
    const auto threshold = [s = side](const Row& row) { return (row.*s).threshold; };
    columns.push_back(
        C(std::string("threshold_") + name, "", "median grip threshold, margin", threshold)
            .Shown(std::string("threshold, ") + name,
                   [=](const Row& row) { return shown(threshold(row)); }));
  }
  for (const auto& [name, side] : sides) {
    const auto force = [s = side](const Row& row) { return (row.*s).breaking_force; };
    columns.push_back(C(std::string("breaking_force_") + name + "_n", "N",
                        "median smallest breaking force", force)
                          .Shown(std::string("breaking force, ") + name + " [N]",
                                 [=](const Row& row) { return shown(force(row)); }));
  }
  return columns;
}

std::vector<CsvColumn<TransferSummary>> ListPlayedColumns() {
  using Row = TransferSummary;
  using C = CsvColumn<Row>;
  return {
      C("hand", "", "", &Row::hand).Shown("hand"),
      C("trials_played", "", "of grasps along the person's course",
        [](const Row& row) {
          return row.played.finished;
        }).Shown("trials played"),
      C("success_played", "", "success rate of these trials",
        [](const Row& row) {
          return row.played.rate();
        }).Shown("success played [%]", [](const Row& row) { return FormatSuccess(row.played); }),
      C("of_playing", "", "their success less that of the same grasps without the course",
        [](const Row& row) {
          return row.of_playing.estimate;
        }).Shown("change by playing [points]", [](const Row& row) {
        return FormatPoints(row.of_playing);
      })};
}

std::vector<TransferLags> ListTransferLags(const TransferFile& file, const Session& session) {
  std::vector<TransferLags> lags;
  const auto find = [&](const std::string& hand, const std::string& digit) -> TransferLags& {
    const auto same = std::find_if(lags.begin(), lags.end(), [&](const TransferLags& one) {
      return one.hand == hand && one.digit == digit;
    });
    if (same != lags.end()) return *same;
    lags.push_back({hand, digit, {}, {}, {}, {}});
    return lags.back();
  };
  for (const TransferRow& row : file.rows) {
    if (!row.not_transferable.empty()) continue;
    for (const TransferPad& pad : row.pads) {
      const std::string people = "+" + pad.person + "+";
      double sum = 0.0, count = 0.0;
      for (const TransferPerson& person : row.person) {
        if (people.find("+" + person.digit + "+") == std::string::npos) continue;
        sum += person.lag;
        ++count;
      }
      TransferLags& own = find(row.hand, pad.digit);
      if (count > 0.0 && std::isfinite(sum)) own.person.push_back(sum / count);
    }
  }
  const TransferSides sides(file);
  for (const TrialRecord& record : session.records) {
    const TransferSide side = sides.Find(record.plan);
    if (!IsSuccess(record.result.outcome) || side == TransferSide::kRehearsed) continue;
    double first = std::numeric_limits<double>::infinity();
    for (const DigitContact& contact : record.result.contacts) {
      if (std::isfinite(contact.time)) first = std::min(first, contact.time);
    }
    for (const DigitContact& contact : record.result.contacts) {
      if (!std::isfinite(contact.time)) continue;
      TransferLags& own = find(record.plan.hand, contact.digit);
      (side == TransferSide::kStandard ? own.standard
       : side == TransferSide::kPlayed ? own.played
                                       : own.transferred)
          .push_back(contact.time - first);
    }
  }
  return lags;
}

std::vector<std::pair<std::string, int>> CountTransferReasons(const TransferFile& file,
                                                              const std::string& hand,
                                                              std::string TransferRow::*reason_of) {
  std::map<std::string, std::pair<std::string, int>> counts;  // by reason without its numbers
  for (const TransferRow& row : file.rows) {
    if (row.hand != hand || (row.*reason_of).empty()) continue;
    std::string reason = row.*reason_of;
    for (char& c : reason) {
      if (std::isdigit(static_cast<unsigned char>(c))) c = '#';
    }
    for (size_t at; (at = reason.find("##")) != std::string::npos;) reason.erase(at, 1);
    const auto [found, is_new] = counts.try_emplace(reason, row.*reason_of, 0);
    ++found->second.second;
  }
  std::vector<std::pair<std::string, int>> sorted;
  for (const auto& [reason, count] : counts) sorted.push_back(count);
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const auto& a, const auto& b) { return a.second > b.second; });
  return sorted;
}

std::vector<TransferDigit> ListTransferDigits(const TransferFile& file) {
  std::vector<TransferDigit> digits;
  std::vector<std::pair<std::vector<double>, std::vector<double>>> values;
  for (const TransferRow& row : file.rows) {
    if (!row.not_transferable.empty()) continue;
    for (const TransferPad& pad : row.pads) {
      if (!pad.is_reached) continue;
      const auto same = std::find_if(digits.begin(), digits.end(), [&](const TransferDigit& one) {
        return one.hand == row.hand && one.digit == pad.digit;
      });
      const auto place = static_cast<size_t>(same - digits.begin());
      if (same == digits.end()) {
        digits.push_back({row.hand, pad.digit, 0, kUnset, kUnset, kUnset});
        values.emplace_back();
      }
      values[place].first.push_back(pad.distance);
      values[place].second.push_back(pad.angle);
    }
  }
  for (size_t d = 0; d < digits.size(); ++d) {
    const std::vector<double>& distances = values[d].first;
    digits[d].num_pads = static_cast<int>(distances.size());
    digits[d].largest_distance = *std::max_element(distances.begin(), distances.end());
    digits[d].median_distance = MedianOf(distances);
    digits[d].median_angle = MedianOf(values[d].second);
  }
  return digits;
}

std::vector<CsvColumn<TransferDigit>> ListTransferDigitColumns() {
  using Row = TransferDigit;
  using C = CsvColumn<Row>;
  const auto mm = [](double Row::*length) {
    return [length](const Row& row) { return FormatFixed(MmFromM(row.*length), 2); };
  };
  return {C("hand", "", "", &Row::hand).Shown("hand"),
          C("digit", "", "", &Row::digit).Shown("digit"),
          C("pads", "", "of transferred grasps", &Row::num_pads).Shown("pads"),
          C("median_distance_m", "m", "from the person's contact", &Row::median_distance)
              .Shown("median [mm]", mm(&Row::median_distance)),
          C("largest_distance_m", "m", "from the person's contact", &Row::largest_distance)
              .Shown("largest [mm]", mm(&Row::largest_distance)),
          C("median_angle_rad", "rad", "to the surface's normal", &Row::median_angle)
              .Shown("angle [deg]",
                     [](const Row& row) { return FormatFixed(DegFromRad(row.median_angle), 0); })};
}

}  // namespace graspbench
