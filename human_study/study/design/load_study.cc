#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "core/base/config.h"
#include "core/base/files/files.h"
#include "core/base/text/delimited_text.h"
#include "core/base/text/text.h"
#include "core/base/text/yaml.h"
#include "human_study/study/design/study_config.h"
#include "objects/catalogue.h"

namespace graspbench {
namespace fs = std::filesystem;

namespace {

double NumberOf(const std::string& level) {
  return ParseFiniteNumber(level).value_or(std::nan(""));
}

/** The levels of each column in the order of numbers, else of appearance. In a column of numbers
equal ones are one level, 0.03 and 0.030, as it is written first. */
std::vector<Factor> ReadFactors(const std::vector<std::string>& names, DataTable& table) {
  std::vector<Factor> factors;
  for (const std::string& name : names) {
    Factor factor;
    factor.name = name;
    table.Require(name);
    std::vector<std::string>& levels = factor.levels;
    for (size_t row = 0; row < table.num_rows(); ++row) {
      const std::string& level = table.Text(row, name);
      if (std::find(levels.begin(), levels.end(), level) == levels.end()) levels.push_back(level);
    }
    const bool is_number = std::all_of(levels.begin(), levels.end(),
                                       [](const auto& l) { return !std::isnan(NumberOf(l)); });
    if (is_number) {
      std::stable_sort(levels.begin(), levels.end(),
                       [](const auto& a, const auto& b) { return NumberOf(a) < NumberOf(b); });
      const auto is_equal = [](const auto& a, const auto& b) { return NumberOf(a) == NumberOf(b); };
      levels.erase(std::unique(levels.begin(), levels.end(), is_equal), levels.end());
      for (const std::string& level : levels) factor.numbers.push_back(NumberOf(level));
    }
    factors.push_back(factor);
  }
  return factors;
}

/** The level that a cell means; the cell itself when it is none. */
const std::string& FindLevel(const std::vector<std::string>& levels, const std::string& cell) {
  const auto same = std::find(levels.begin(), levels.end(), cell);
  if (same != levels.end()) return *same;
  const double number = NumberOf(cell);
  const auto equal = std::find_if(levels.begin(), levels.end(),
                                  [&](const auto& level) { return NumberOf(level) == number; });
  return equal == levels.end() ? cell : *equal;
}

/** A warning for each two names of a column that differ in the case of letters alone. */
void WarnOfLookAlikes(const std::string& column, const DataTable& table, Diagnostics& problems) {
  std::map<std::string, std::vector<std::string>> spellings;
  for (size_t row = 0; row < table.num_rows(); ++row) {
    const std::string& name = table.Text(row, column);
    std::vector<std::string>& known = spellings[ToLower(name)];
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    known.push_back(name);
    if (known.size() < 2) continue;
    problems.Warn(table.file(), table.LineOfRow(row),
                  column + ": \"" + name + "\" and \"" + known.front() +
                      "\" count as two; if they are one, spell them alike");
  }
}

/** A group that changes within a person, and a factor that never does. */
void CheckDesign(const Study& study, const std::string& file, Diagnostics& problems) {
  std::map<std::string, const PlannedReach*> first;
  std::vector<bool> varies(study.config.factors.size(), false);
  for (const PlannedReach& trial : study.trials) {
    const PlannedReach& known = *first.try_emplace(trial.participant, &trial).first->second;
    for (size_t i = 0; i < trial.groups.size(); ++i) {
      if (trial.groups[i] == known.groups[i]) continue;
      const std::string& name = study.config.groups[i];
      problems.Fail(file, trial.line,
                    name + ": participant " + trial.participant + " is \"" + trial.groups[i] +
                        "\" here and \"" + known.groups[i] + "\" in line " +
                        std::to_string(known.line) +
                        "; a group is the same in all trials of a person, what changes within "
                        "persons belongs under factors");
    }
    for (size_t i = 0; i < varies.size(); ++i) {
      varies[i] = varies[i] || trial.levels[i] != known.levels[i];
    }
  }
  for (size_t i = 0; i < varies.size(); ++i) {
    if (varies[i] || first.size() < 2 || study.factors[i].levels.size() < 2) continue;
    problems.Warn(file, 1,
                  study.config.factors[i] +
                      " never changes within a participant, so it cannot be tested as a factor; "
                      "if it says what a participant is, name it under groups");
  }
}

bool IsOf(const std::vector<InputColumn>& columns, const std::string& name) {
  return std::any_of(columns.begin(), columns.end(),
                     [&](const InputColumn& column) { return column.name == name; });
}

std::string DescribeUnused(const std::string& column) {
  return "the column \"" + column + "\" is not used";
}

void WarnOfUnused(const DataTable& table, const std::vector<InputColumn>& known,
                  Diagnostics& problems) {
  for (const std::string& column : table.columns()) {
    if (!IsOf(known, column)) problems.Warn(table.file(), 1, DescribeUnused(column));
  }
}

std::vector<PlannedReach> ReadTrials(const Study& study, DataTable& table, Diagnostics& problems) {
  table.Require("participant");
  table.Require("file");
  const std::vector<std::string>& factors = study.config.factors;
  const std::vector<std::string>& groups = study.config.groups;
  std::vector<std::string> design = factors;
  design.insert(design.end(), groups.begin(), groups.end());
  if (!study.config.session.empty()) design.push_back(study.config.session);
  for (const std::string& column : table.columns()) {
    const bool is_factor = std::find(design.begin(), design.end(), column) != design.end();
    const bool is_known = IsOf(ListTrialInputColumns(), column);
    if (is_factor && is_known && column != "object" && column != "hand") {
      problems.Fail(table.file(), 1, "\"" + column + "\" cannot be a factor");
    } else if (!is_factor && !is_known) {
      problems.Warn(table.file(), 1, DescribeUnused(column));
    }
  }
  const bool needs_hand =
      FormatJson(ConfigToJson(study.config.markers)).find(kHandInLabels) != std::string::npos;
  std::vector<PlannedReach> trials;
  std::map<std::string, int> counts;
  std::map<std::pair<std::string, std::string>, int> lines;
  for (size_t row = 0; row < table.num_rows(); ++row) {
    PlannedReach trial;
    trial.line = table.LineOfRow(row);
    const auto fail = [&](const std::string& text) {
      problems.Fail(table.file(), trial.line, text);
    };
    trial.participant = table.Text(row, "participant");
    trial.file = table.Text(row, "file");
    trial.trial = table.Text(row, "trial");
    trial.table_trial = table.Text(row, "table_trial");
    trial.object = table.Text(row, "object");
    trial.remove = table.Text(row, "remove");
    const int count = ++counts[trial.participant];
    if (trial.trial.empty()) trial.trial = std::to_string(count);
    for (const Factor& factor : study.factors) {
      trial.levels.push_back(FindLevel(factor.levels, table.Text(row, factor.name)));
      if (trial.levels.back().empty()) {
        fail(factor.name + ": empty; expected the trial's condition");
      }
    }
    for (const Factor& group : study.groups) {
      trial.groups.push_back(FindLevel(group.levels, table.Text(row, group.name)));
      if (trial.groups.back().empty()) {
        fail(group.name + ": empty; expected the participant's group");
      }
    }
    if (!study.config.session.empty()) {
      trial.session = FindLevel(study.sessions, table.Text(row, study.config.session));
      if (trial.session.empty()) fail(study.config.session + ": empty; expected the session");
    }
    trial.hand = table.Text(row, "hand");
    if (trial.hand.empty() && needs_hand) {
      fail("hand: empty; the labels under markers contain {hand}, expected what stands for it");
    }
    const double start = table.Number(row, "start_s"), end = table.Number(row, "end_s");
    if (!std::isnan(start)) trial.start = start;
    if (!std::isnan(end)) trial.end = end;
    if (!(trial.start < trial.end)) fail("end_s must be later than start_s");
    if (trial.participant.empty()) fail("participant: empty");
    if (trial.file.empty()) fail("file: empty");
    const auto [first, is_new] = lines.insert({{trial.participant, trial.trial}, trial.line});
    if (!is_new) {
      fail("participant " + trial.participant + " has trial " + trial.trial + " already in line " +
           std::to_string(first->second));
    }
    trials.push_back(trial);
  }
  return trials;
}

/** Parts of one recording may follow each other; what is mostly in another is the same. */
bool IsSamePart(const PlannedReach& a, const PlannedReach& b) {
  const double both = std::min(a.end, b.end) - std::max(a.start, b.start);
  return both > 0.0 && both >= 0.5 * std::min(a.end - a.start, b.end - b.start);
}

/** Parts of one recording by their start, no two the same. Then at most two of them hold any one
instant, so that a part is the same as one of its neighbours or as none. */
class RecordedParts {
 public:
  /** Null: the part is new, and is kept. */
  const PlannedReach* FindSameOrAdd(const PlannedReach& part) {
    const auto next = parts_.upper_bound(part.start);
    if (next != parts_.end() && IsSamePart(*next->second, part)) return next->second;
    auto before = next;
    for (int i = 0; i < 2 && before != parts_.begin(); ++i) {
      --before;
      if (IsSamePart(*before->second, part)) return before->second;
    }
    parts_.emplace_hint(next, part.start, &part);
    return nullptr;
  }

 private:
  std::map<double, const PlannedReach*> parts_;
};

void CheckRecordedOnce(const Study& study, const std::string& trials_file, Diagnostics& problems) {
  std::map<std::array<std::string, 3>, RecordedParts> recordings;
  for (const PlannedReach& trial : study.trials) {
    if (!trial.remove.empty()) continue;
    const std::string file = fs::path(trial.file).lexically_normal().string();
    RecordedParts& parts = recordings[{file, trial.table_trial, trial.hand}];
    const PlannedReach* other = parts.FindSameOrAdd(trial);
    if (other == nullptr) continue;
    problems.Fail(trials_file, trial.line,
                  "\"" + trial.file + "\" is already in line " + std::to_string(other->line) +
                      ", and one recording counts once; several trials in it need start_s and "
                      "end_s, table_trial or hand, and a row too many a reason under remove");
  }
}

SurfaceDistance ReadShape(DataTable& table, size_t row, StudyObject& object,
                          Diagnostics& problems) {
  const std::string& shape = object.shape = table.Text(row, "shape");
  const auto fail = [&](const std::string& text) {
    problems.Fail(table.file(), table.LineOfRow(row), text);
  };
  const auto read_length = [&](const char* column) {
    const double length = table.Number(row, column);
    if (!(length > 0.0 && length < 10.0)) {
      fail(shape + " needs " + column + ", a length above 0 and below 10");
      return 0.1;  // for the rest of the checks
    }
    return length;
  };
  if (shape == "sphere") {
    object.size.setConstant(read_length("length_m"));
    return MakeSphereDistance(object.size.x() / 2.0);
  }
  if (shape == "cylinder") {
    const double diameter = read_length("length_m");
    object.size << diameter, diameter, read_length("height_m");
    return MakeCylinderDistance(diameter / 2.0, object.size.z());
  }
  if (shape == "box") {
    const double length = read_length("length_m"), width = read_length("width_m");
    object.size << length, width, read_length("height_m");
    return MakeBoxDistance(object.size);
  }
  if (shape == "catalogue") {
    try {
      return MakeFieldDistance(LoadObject(table.Text(row, "object"))->field);
    } catch (const Error& error) {
      fail(error.what());
      return {};
    }
  }
  if (!shape.empty()) {
    fail("shape \"" + shape + "\" is not known" +
         SuggestNames(shape, {"sphere", "cylinder", "box", "catalogue"}));
  }
  return {};
}

std::vector<StudyObject> ReadObjects(DataTable& table, bool has_markers, Diagnostics& problems) {
  table.Require("object");
  WarnOfUnused(table, ListObjectInputColumns(), problems);
  std::vector<StudyObject> objects;
  for (size_t row = 0; row < table.num_rows(); ++row) {
    StudyObject object;
    object.id = table.Text(row, "object");
    for (const StudyObject& other : objects) {
      if (other.id == object.id) {
        problems.Fail(table.file(), table.LineOfRow(row), "\"" + object.id + "\" is listed twice");
      }
    }
    object.distance = ReadShape(table, row, object, problems);
    const char* const axes[] = {"centre_x_m", "centre_y_m", "centre_z_m"};
    int num_stated = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const double value = table.Number(row, axes[axis]);
      if (std::isnan(value)) continue;
      object.p_MO_L[axis] = value;
      ++num_stated;
    }
    if (object.distance && !has_markers) {
      problems.Warn(table.file(), table.LineOfRow(row),
                    "the shape is not used: markers.object is empty, so nobody knows where the "
                    "object is. Name its markers there, or leave the shape out");
    } else if (object.distance && num_stated < 3) {
      problems.Warn(table.file(), table.LineOfRow(row),
                    "centre_x_m, centre_y_m or centre_z_m is empty and counts as 0: the centre of "
                    "the solid is taken to be the middle of its markers. Markers on its surface "
                    "are off by half its size, and contacts are then late or missing; state all "
                    "three (0 if they are)");
    }
    objects.push_back(object);
  }
  return objects;
}

std::vector<Hypothesis> ReadHypotheses(DataTable& table, Diagnostics& problems) {
  table.Require("measure");
  WarnOfUnused(table, ListHypothesisInputColumns(), problems);
  std::vector<std::string> known;
  for (const TrialMeasure& measure : TrialMeasureList()) known.emplace_back(measure.id);
  std::set<std::string> seen;
  std::vector<Hypothesis> hypotheses;
  for (size_t row = 0; row < table.num_rows(); ++row) {
    const auto fail = [&](const std::string& text) {
      problems.Fail(table.file(), table.LineOfRow(row), text);
    };
    Hypothesis hypothesis;
    hypothesis.measure = table.Text(row, "measure");
    if (std::find(known.begin(), known.end(), hypothesis.measure) == known.end()) {
      fail("measure \"" + hypothesis.measure + "\" is not known" +
           SuggestNames(hypothesis.measure, known));
    }
    if (!seen.insert(hypothesis.measure).second)
      fail("\"" + hypothesis.measure + "\" is listed twice");
    const double slope = table.Number(row, "slope");
    if (!std::isnan(slope)) hypothesis.slope = slope;
    hypothesis.equal_within = table.Number(row, "equal_within");
    if (hypothesis.equal_within <= 0.0) fail("equal_within: expected more than 0");
    hypotheses.push_back(hypothesis);
  }
  return hypotheses;
}

void CheckObjectNames(const Study& study, const std::string& trials_file, Diagnostics& problems) {
  std::vector<std::string> known;
  for (const StudyObject& object : study.objects) known.push_back(object.id);
  if (known.empty()) return;
  for (const PlannedReach& trial : study.trials) {
    if (trial.object.empty() || study.FindObject(trial.object) != nullptr) continue;
    problems.Fail(trials_file, trial.line,
                  "object \"" + trial.object + "\" is not in " + study.config.objects +
                      SuggestNames(trial.object, known));
  }
}

/** One detector for all trials: two in one study would differ by their bias. */
std::string ChooseDetector(const Study& study) {
  const bool has_shapes =
      !study.config.markers.object.empty() && !study.trials.empty() &&
      std::all_of(study.trials.begin(), study.trials.end(),
                  [&](const PlannedReach& trial) { return study.FindObject(trial.object); });
  return has_shapes ? "surface" : "breakpoint";
}

}  // namespace

const std::vector<InputColumn>& ListTrialInputColumns() {
  static const std::vector<InputColumn> columns = {
      {"participant", "string", "", "who reached; required"},
      {"file", "string", "", "recording, relative to study.yaml or to --data; required"},
      {"trial", "string", "", "name of the trial within its participant; default its number"},
      {"object", "string", "", "the object's row of objects.csv; needed for its shape"},
      {"table_trial", "string", "",
       "of a plain table that holds several trials: this trial's value in its trial column"},
      {"start_s", "number", "s", "start of the analysed part; default that of the recording"},
      {"end_s", "number", "s", "end of the analysed part; default that of the recording"},
      {"hand", "string", "", "text that replaces {hand} in the marker labels"},
      {"remove", "string", "", "why the trial is left out; empty: it is analysed"},
  };
  return columns;
}

const std::vector<InputColumn>& ListObjectInputColumns() {
  static const std::vector<InputColumn> columns = {
      {"object", "string", "", "name of the object, as in trials.csv; required"},
      {"shape", "string", "",
       "sphere, cylinder, box, or catalogue: the object of the benchmark with this name; empty: "
       "unknown. A shape stands upright at rest: its height points up (lift_off.up_x ..), the "
       "length of a box along the recording's x axis"},
      {"length_m", "number", "m", "diameter of a sphere or cylinder; length of a box"},
      {"width_m", "number", "m", "width of a box, horizontal and across its length"},
      {"height_m", "number", "m", "height of a cylinder or box"},
      {"centre_x_m", "number", "m",
       "from the middle of the object's markers to the centre of the shape, both at rest, along "
       "the recording's x axis; empty: 0"},
      {"centre_y_m", "number", "m", "the same along the recording's y axis"},
      {"centre_z_m", "number", "m", "the same along the recording's z axis"},
  };
  return columns;
}

const std::vector<InputColumn>& ListHypothesisInputColumns() {
  static const std::vector<InputColumn> columns = {
      {"measure", "string", "", "id of the measure, as a column of measures.csv; required"},
      {"slope", "number", "",
       "slope over the factor that the persons' slopes are tested against; default 0"},
      {"equal_within", "number", "",
       "two conditions are equivalent if they differ by less than this, in the measure's unit"},
  };
  return columns;
}

const StudyObject* Study::FindObject(const std::string& id) const {
  for (const StudyObject& object : objects) {
    if (object.id == id) return &object;
  }
  return nullptr;
}

Hypothesis Study::FindHypothesis(const std::string& measure) const {
  for (const Hypothesis& hypothesis : hypotheses) {
    if (hypothesis.measure == measure) return hypothesis;
  }
  return {};
}

Study LoadStudy(const fs::path& path, const fs::path& recordings,
                const std::vector<std::string>& settings) {
  Study study;
  Diagnostics problems;
  const std::string text = ReadFile(path);
  study.file = path.string();
  study.folder = path.parent_path();
  study.recordings = recordings.empty() ? study.folder : recordings;
  study.config = ParseStudyConfig(text, study.file, problems, settings);
  problems.ThrowIfErrors(ErrorKind::kFormat, "the study cannot be analysed");

  const YAML::Node root = ParseYaml(text, study.file, problems);
  int* const lines[] = {&study.marker_lines.thumb, &study.marker_lines.index,
                        &study.marker_lines.middle, &study.marker_lines.ring,
                        &study.marker_lines.little};
  for (int digit = 0; digit < PerDigit<int>::kNumDigits; ++digit) {
    *lines[digit] = FindConfigLine(root, std::string("markers.") + NameOfDigit(digit));
  }
  const auto read = [&](const char* key, const std::string& name) -> std::optional<DataTable> {
    const fs::path table = study.folder / name;
    try {
      DataTable rows(ReadFile(table), table.string(), problems);
      // What it lacks would be said once more for every column.
      if (rows.num_rows() == 0) return std::nullopt;
      return rows;
    } catch (const Error& error) {
      problems.Fail(study.file, FindConfigLine(root, key), std::string(key) + ": " + error.what());
      return std::nullopt;
    }
  };
  if (!study.config.objects.empty()) {
    if (auto table = read("objects", study.config.objects)) {
      study.objects = ReadObjects(*table, !study.config.markers.object.empty(), problems);
    }
  }
  if (!study.config.hypotheses.empty()) {
    if (auto table = read("hypotheses", study.config.hypotheses)) {
      study.hypotheses = ReadHypotheses(*table, problems);
    }
  }
  if (!study.config.reviews.empty()) {
    if (auto table = read("reviews", study.config.reviews)) {
      study.reviews = ReadReviews(*table, problems);
    }
  }
  if (auto table = read("trials", study.config.trials)) {
    study.factors = ReadFactors(study.config.factors, *table);
    study.groups = ReadFactors(study.config.groups, *table);
    if (!study.config.session.empty()) {
      study.sessions = ReadFactors({study.config.session}, *table).front().levels;
    }
    study.trials = ReadTrials(study, *table, problems);
    CheckDesign(study, table->file(), problems);
    CheckRecordedOnce(study, table->file(), problems);
    WarnOfLookAlikes("participant", *table, problems);
    for (const auto* columns : {&study.config.factors, &study.config.groups}) {
      for (const std::string& column : *columns) WarnOfLookAlikes(column, *table, problems);
    }
    CheckObjectNames(study, table->file(), problems);
  }
  problems.ThrowIfErrors(ErrorKind::kFormat, "the study cannot be analysed");
  study.warnings = problems;
  study.stated = study.config;
  const fs::path freeze = FindFreezePath(path);
  if (fs::exists(freeze)) {
    study.freeze = CompareWithFreeze(ReadFile(freeze), freeze.string(), study);
  }
  std::string& detector = study.config.analysis.contact.detector;
  if (detector == kAutomaticDetector) detector = ChooseDetector(study);
  return study;
}

}  // namespace graspbench
