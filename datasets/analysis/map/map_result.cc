#include "datasets/analysis/map/map_result.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/base/text/text.h"
#include "datasets/analysis/conditions/sweep_summary.h"
#include "datasets/analysis/map/simultaneity_map.h"
#include "datasets/plan/conditions.h"
#include "datasets/plan/map_design.h"
#include "datasets/plan/scene_names.h"
#include "datasets/session/find_trial.h"

namespace graspbench {

namespace {

/** What a condition says of its trials. */
struct Region {
  std::vector<size_t> levels;
  SessionConfig config;
  LateDigit late = LateDigit::kNone;
  double delay = 0.0;
};

/** By the condition's name; empty: the base. */
std::map<std::string, Region> ListRegions(const SessionConfig& config) {
  std::map<std::string, Region> regions;
  std::vector<Condition> conditions = config.conditions;
  conditions.push_back({});
  const auto levels = ListMapLevels(conditions, config);
  for (size_t i = 0; i < conditions.size(); ++i) {
    const ConditionInputs made = ApplyCondition(conditions[i], config);
    regions[conditions[i].name] = {levels[i], made.config, made.late, made.delay};
  }
  return regions;
}

/** GFT; infinite where a digit never touched, NaN where contacts came before closure. */
double FindFirstToLast(const TrialResult& result) {
  double first = INFINITY, last = -INFINITY;
  for (const DigitContact& contact : result.contacts) {
    if (std::isnan(contact.time)) return INFINITY;
    first = std::min(first, contact.time);
    last = std::max(last, contact.time);
  }
  return result.contacts.empty() || result.timing.contact_before_start ? kUnset : last - first;
}

double FindPush(const TrialResult& result) {
  if (std::isinf(FindFirstToLast(result))) return INFINITY;
  return result.closing ? result.closing->shift : kUnset;
}

}  // namespace

MapData ListMapTrials(const Session& session, const std::vector<ThresholdSummary>& thresholds) {
  MapData data;
  for (const MapFactorRow& row : ListMapFactors()) {
    MapFactor factor = {row.name, {}, row.scales_draws};
    for (const MapLevelRow& level : row.levels) factor.levels.push_back(level.name);
    data.factors.push_back(factor);
  }
  std::vector<double> margins(session.records.size(), kUnset);
  for (const ThresholdSummary& summary : thresholds) {
    if (summary.scale == &kThresholdScales[0]) margins = ListThresholdsOf(session, summary);
  }
  const SweepMeasure& threshold = FindSweepMeasure("threshold_margin");
  const bool is_judged = std::any_of(session.records.begin(), session.records.end(),
                                     [](const TrialRecord& record) { return record.judgement; });
  const std::map<std::string, Region> regions = ListRegions(session.config);
  for (size_t i = 0; i < session.records.size(); ++i) {
    const TrialRecord& record = session.records[i];
    if (IsNumericalFailure(record.result.outcome)) continue;
    const Region& region = regions.at(record.plan.condition.value_or(""));
    const TrialDraw draw = MakeObjectDraw(region.config, record.plan.object, record.plan.trial);
    MapTrial trial;
    trial.hand = record.plan.hand;
    trial.object = record.plan.object;
    trial.draw = record.plan.trial;
    trial.levels = region.levels;
    trial.late = region.late;
    trial.delay = region.delay;
    SweepTrial measured;
    measured.record = &record;
    measured.thresholds[0] = margins[i];
    const double strength = record.judgement ? record.judgement->breaking_force : kUnset;
    const bool is_success = IsSuccess(record.result.outcome);
    trial.values = {is_success ? 1.0 : 0.0, threshold.CalcEffectValue(measured),
                    FindPush(record.result), is_judged && !is_success ? 0.0 : strength};
    trial.first_to_last = FindFirstToLast(record.result);
    trial.offset = std::hypot(draw.offset_x, draw.offset_y);
    trial.turn = std::abs(draw.offset_yaw);
    trial.name = NameTrial(record.plan);
    data.trials.push_back(std::move(trial));
  }
  return data;
}

namespace {

/** The level of a factor of the cell's, or its name; null: it has no such. */
Json FindPlace(const MapRow& row, size_t place, bool is_name) {
  if (row.cell->where.size() <= place) return {};
  const MapLevel& level = row.cell->where[place];
  const MapFactor& factor = row.part->map.factors[level.factor];
  return is_name ? factor.name : factor.levels[level.level];
}

/** With what would decide it. */
std::string NameVerdict(const MapRow& row) {
  const std::string name = RowOf(kMapVerdicts, row.cell->verdict).name;
  const int num_objects = row.cell->num_objects_to_decide;
  return num_objects == 0
             ? name
             : name + ": some " + FormatCount(num_objects, "object") + " in total would decide";
}

std::vector<CsvColumn<MapRow>> ListMapColumns() {
  using Row = MapRow;
  using C = CsvColumn<Row>;
  return {
      {"part", "", "session of the map", [](const Row& row) { return row.part->id; }},
      C("measure", "",
        "success (0 or 1), threshold (binary logarithm of the margin), push (net share of pairs), "
        "breaking_force [N]",
        [](const Row& row) {
          return row.measure().name;
        }).Shown("measure", [](const Row& row) { return row.measure().label; }),
      C("hand", "", "id of the hand", [](const Row& row) { return row.cell->hand; }).Shown("hand"),
      C("late_digit", "", "delayed digit: last or first to touch without delay",
        [](const Row& row) {
          return NameLateDigit(row.cell->late);
        }).Shown("late digit"),
      C("factor", "string", "", "of the region; empty: everywhere",
        [](const Row& row) {
          return FindPlace(row, 0, true);
        }).Shown("where", [](const Row& row) { return NameWhere(row.part->map, *row.cell); }),
      {"level", "string", "", "its level", [](const Row& row) { return FindPlace(row, 0, false); }},
      {"with_factor", "string", "", "a second factor of the region",
       [](const Row& row) { return FindPlace(row, 1, true); }},
      {"with_level", "string", "", "and its level",
       [](const Row& row) { return FindPlace(row, 1, false); }},
      C("pairs", "", "pairs of a trial without delay and its delayed repetitions",
        [](const Row& row) {
          return row.cell->num_pairs;
        }).Shown("pairs"),
      C("objects", "", "in these pairs",
        [](const Row& row) {
          return row.cell->num_objects;
        }).Shown("objects"),
      {"undelayed", "", "mean of the measure without delay",
       [](const Row& row) { return row.cell->undelayed; }},
      C("effect", "", "mean over pairs per 100 ms of delay; push: not per time",
        [](const Row& row) {
          return row.cell->estimate;
        }).Shown("effect", [](const Row& row) { return FormatEffect(*row.cell); }),
      {"low", "", "lower end of the 95 % interval from resampling objects",
       [](const Row& row) { return row.cell->interval ? row.cell->interval->low : kUnset; }},
      {"high", "", "upper end of the 95 % interval",
       [](const Row& row) { return row.cell->interval ? row.cell->interval->high : kUnset; }},
      {"no_interval", "", "why there is none",
       [](const Row& row) { return row.cell->interval ? "" : row.cell->interval.reason(); }},
      {"p", "", "no effect: sign test over objects", [](const Row& row) { return row.cell->p; }},
      C("adjusted_p", "",
        "adjusted for the false discovery rate: overall effects over hands and delayed digits, "
        "regions over all regions",
        [](const Row& row) {
          return row.cell->adjusted_p;
        }).Shown("p adjusted", [](const Row& row) { return FormatFixed(row.cell->adjusted_p, 4); }),
      C("verdict", "", "costs, gains, none, ceiling, floor, undecided",
        [](const Row& row) {
          return RowOf(kMapVerdicts, row.cell->verdict).name;
        }).Shown("verdict", NameVerdict),
      C::ForPeople("name of a trial that changed", "of the first such: graspbench trial DIR NAME",
                   [](const Row& row) {
                     return row.cell->changed.empty() ? "" : row.cell->changed.front();
                   })};
}

MapMeasure FindMeasure(const MapPart& part) {
  if (part.with_judge) return MapMeasure::kBreakingForce;
  return part.with_thresholds ? MapMeasure::kThreshold : MapMeasure::kSuccess;
}

MapPartResult MakePart(const MapPart& part, const Session& session, const MapData& data) {
  return {part.id,
          part.title,
          static_cast<int>(session.records.size()),
          static_cast<int>(session.plan.size()),
          FindMeasure(part),
          MapSimultaneity(data)};
}

}  // namespace

std::vector<std::string> MapResult::findings() const {
  std::vector<std::string> sentences;
  for (const std::string& hand : parts.front().map.hands) {
    sentences.push_back(DescribeFinding(parts.front().map, natural.at(hand), hand));
    for (const MapPartResult& part : parts) {
      const std::string regions = DescribeMap(part.map, hand, part.measure);
      if (!regions.empty()) sentences.push_back(hand + ": " + regions);
    }
    const std::string by_object = DescribeObjects(objects, hand);
    if (!by_object.empty()) sentences.push_back(hand + ": " + by_object);
  }
  return sentences;
}

namespace {

std::string MakeMapCommand(const SessionConfig& config) {
  const SessionConfig plain;
  std::string command = "graspbench map simultaneity";
  // Only the whole map has a delay of 0.1 s.
  const bool is_whole =
      std::any_of(config.conditions.begin(), config.conditions.end(),
                  [](const Condition& condition) { return condition.name == "delay.last=0.1"; });
  if (!is_whole) command += " --quick";
  command += " --hand " + FormatListOption(config.hands, "FILE");
  if (config.objects != plain.objects) {
    command += " --object " + FormatListOption(config.objects, "OBJECT");
  }
  command += " --grasp " + FormatListOption(config.grasps, "FILE");
  if (config.seed != plain.seed) command += " --seed " + std::to_string(config.seed);
  return command + " --out DIR";
}

}  // namespace

MapResult LoadMap(const Session& session) {
  MapResult result;
  result.command = MakeMapCommand(session.config);
  for (const MapPart& part : ListMapParts(false)) {
    if (result.parts.empty()) {
      const MapData data = ListMapTrials(session, {});
      result.parts.push_back(MakePart(part, session, data));
      result.objects = ListObjectEffects(data);
      for (const std::string& hand : result.parts.front().map.hands) {
        result.natural[hand] = FindNaturalRelation(data, hand);
      }
      continue;
    }
    const std::filesystem::path folder = session.folder / "map" / part.id;
    if (!HasSession(folder)) continue;
    const Session rest = LoadSession(folder, OnDamage::kAccept, RecordParts::kBrief);
    result.parts.push_back(MakePart(part, rest, ListMapTrials(rest, LoadThresholds(rest))));
  }
  return result;
}

namespace {

/** Of success with the delay at this place; NaN: there is no such. */
double FindRate(const ObjectEffect& effect, size_t place) {
  return effect.rates.size() > place ? effect.rates[place].rate : kUnset;
}

std::vector<CsvColumn<ObjectEffect>> ListObjectColumns() {
  using Row = ObjectEffect;
  return {
      {"hand", "", "id of the hand", &Row::hand},
      {"object", "", "id of the object", &Row::object},
      {"late_digit", "", "delayed digit: last or first to touch without delay",
       [](const Row& row) { return NameLateDigit(row.late); }},
      {"pairs", "", "pairs of a trial without delay and its delayed repetitions", &Row::num_pairs},
      {"undelayed", "", "rate of success without delay",
       [](const Row& row) { return FindRate(row, 0); }},
      {"rate_at_shorter_delay", "", "rate of success with the shorter delay",
       [](const Row& row) { return FindRate(row, 1); }},
      {"rate_at_longer_delay", "", "rate of success with the longer delay",
       [](const Row& row) { return FindRate(row, 2); }},
      {"effect", "", "change of the rate for 100 ms of delay", &Row::estimate},
      {"low", "", "lower end of the 95 % interval from resampling pairs",
       [](const Row& row) { return row.interval ? row.interval->low : kUnset; }},
      {"high", "", "upper end of the 95 % interval",
       [](const Row& row) { return row.interval ? row.interval->high : kUnset; }},
      {"no_interval", "", "why there is none",
       [](const Row& row) { return row.interval ? "" : row.interval.reason(); }}};
}

}  // namespace

std::vector<MapRow> ListMapRows(const MapResult& result) {
  std::vector<MapRow> rows;
  for (const MapPartResult& part : result.parts) {
    for (const MapCell& cell : part.map.cells) {
      if (cell.num_pairs > 0) rows.push_back({&part, &cell});
    }
  }
  return rows;
}

ShownTable ShowRegions(const std::vector<MapRow>& rows) {
  return ShowTable(ListMapColumns(), rows);
}

std::vector<ExportTable> MakeMapTables(const MapResult& result) {
  const auto columns = ListMapColumns();
  const auto object_columns = ListObjectColumns();
  return {{"map", FormatCsv(columns, ListMapRows(result)), MakeTableSchema(columns, "")},
          {"map_objects", FormatCsv(object_columns, result.objects),
           MakeTableSchema(object_columns, "")}};
}

Json ToJson(const MapResult& result) {
  Json parts = Json::array();
  for (const MapPartResult& part : result.parts) {
    Json json = ToJson(part.map);
    json["id"] = part.id;
    json["trials"] = part.num_trials;
    json["planned"] = part.num_planned;
    parts.push_back(json);
  }
  Json objects = Json::array();
  for (const ObjectEffect& effect : result.objects) {
    Json rates = Json::array();
    for (const RateWithDelay& rate : effect.rates) {
      rates.push_back({{"delay_s", rate.delay}, {"success", JsonNumber(rate.rate)}});
    }
    objects.push_back({{"hand", effect.hand},
                       {"object", effect.object},
                       {"late_digit", NameLateDigit(effect.late)},
                       {"pairs", effect.num_pairs},
                       {"rates", rates},
                       {"effect", JsonNumber(effect.estimate)},
                       {"low", effect.interval ? JsonNumber(effect.interval->low) : Json()},
                       {"high", effect.interval ? JsonNumber(effect.interval->high) : Json()},
                       {"changed", effect.changed}});
  }
  const SimultaneityMap& map = result.parts.front().map;
  Json precision = Json::object();
  for (const std::string& hand : map.hands) {
    const MapPrecision found = FindPrecision(map, hand);
    Json wide = Json::array();
    for (const MapCell* cell : found.wide) {
      wide.push_back({{"late_digit", NameLateDigit(cell->late)},
                      {"where", NameWhere(map, *cell)},
                      {"half_width", JsonNumber(CalcHalfWidth(*cell))}});
    }
    precision[hand] = {{"regions", found.num_regions},
                       {"large", found.num_large},
                       {"narrow", found.num_narrow()},
                       {"wide", wide}};
  }
  Json natural = Json::object();
  for (const auto& [hand, relation] : result.natural) {
    if (!relation) {
      natural[hand] = {{"none", relation.reason()}};
      continue;
    }
    natural[hand] = {{"trials", relation->num_trials},
                     {"objects", relation->num_objects},
                     {"correlation", JsonNumber(relation->correlation)},
                     {"low", JsonNumber(relation->interval.low)},
                     {"high", JsonNumber(relation->interval.high)},
                     {"cause", relation->cause}};
  }
  return {{"findings", result.findings()},
          {"parts", parts},
          {"objects", objects},
          {"precision", precision},
          {"natural", natural}};
}

}  // namespace graspbench
