#include "workbench/text/file_formats.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>

#include "core/arm/load_arm.h"
#include "core/base/config.h"
#include "core/grasp/grasp_yaml.h"
#include "core/hand/hand_yaml.h"
#include "core/hand/tactile.h"
#include "datasets/analysis/campaign/campaign_summary.h"
#include "datasets/analysis/conditions/basin_summary.h"
#include "datasets/analysis/conditions/numerics_summary.h"
#include "datasets/analysis/conditions/sweep_summary.h"
#include "datasets/analysis/conditions/threshold_summary.h"
#include "datasets/analysis/map/map_result.h"
#include "datasets/benchmark/benchmark_file.h"
#include "datasets/judged_grasps/grasp_store.h"
#include "datasets/judged_grasps/profile_file.h"
#include "datasets/mjcf/mjcf_export.h"
#include "datasets/pipeline/pipeline_file.h"
#include "datasets/plan/conditions.h"
#include "datasets/plan/session_config.h"
#include "datasets/records/trace_table.h"
#include "datasets/records/trial_table.h"
#include "datasets/scene/development_store.h"
#include "datasets/scene/rehearsal_store.h"
#include "datasets/scene/scene_store.h"
#include "datasets/trajectory/trajectory_form.h"
#include "human_study/recording/importers/table_mapping.h"
#include "human_study/statistics/tidy_export.h"
#include "human_study/study/design/study_config.h"
#include "human_study/study/output/study_tables.h"
#include "human_study/study/synthetic/synthetic_study.h"
#include "objects/object_file.h"
#include "reports/study/trial_figures.h"
#include "workbench/experiments/policies/policy_server.h"
#include "workbench/tables/grasp_tables.h"

namespace graspbench {
namespace {

/** What a store freezes of a campaign; its session has the keys of session.yaml. */
FileKeys ListCampaignKeys() {
  FileKeys keys = {{"session", "", KeyType::kMap,
                    "hands, objects and the benchmark's trials, as in "
                    "session.yaml"}};
  for (FileKey& key : DescribeConfig(CampaignConfig())) {
    if (key.key.rfind("session.", 0) != 0) keys.push_back(std::move(key));
  }
  return keys;
}

/** A key with what lies below it, as the rows' dots nest them. */
struct KeyNode {
  const FileKey* row = nullptr;
  std::map<std::string, KeyNode> children;
};

KeyNode MakeTree(const FileKeys& keys) {
  KeyNode root;
  for (const FileKey& key : keys) {
    KeyNode* node = &root;
    for (size_t start = 0, end = 0; end != key.key.npos; start = end + 1) {
      end = key.key.find('.', start);
      node = &node->children[key.key.substr(start, end == key.key.npos ? end : end - start)];
    }
    node->row = &key;
  }
  return root;
}

/** "ID" and "DIGIT" stand for any name. */
bool IsPlaceholder(const std::string& name) {
  return std::all_of(name.begin(), name.end(), [](unsigned char c) { return std::isupper(c); });
}

/** A number in range, or several, in lists or by name (the postures of a grasp). */
Json MakeNumbers(const FileKey& row) {
  Json number = {{"type", "number"}};
  if (row.low == kAboveZero) {
    number["exclusiveMinimum"] = 0;
  } else if (std::isfinite(row.low)) {
    number["minimum"] = row.low;
  }
  if (std::isfinite(row.high)) number["maximum"] = row.high;
  const Json list = {{"type", "array"}, {"items", number}};
  return {{"anyOf", {number, list, {{"type", "object"}}}}};
}

Json MakeLeaf(const FileKey& row) {
  if (row.type == KeyType::kBoolean) return {{"type", "boolean"}};
  const bool has_range = std::isfinite(row.low) || std::isfinite(row.high);
  return has_range || row.type == KeyType::kNumber ? MakeNumbers(row) : Json::object();
}

Json MakeNode(const KeyNode& node);

Json MakeMap(const KeyNode& node) {
  Json properties = Json::object();
  Json required = Json::array();
  Json others = false;
  for (const auto& [name, child] : node.children) {
    if (IsPlaceholder(name)) {
      others = MakeNode(child);
      continue;
    }
    properties[name] = MakeNode(child);
    if (child.row && child.row->fallback == kRequired &&
        child.row->type != KeyType::kNumberOfSome) {
      required.push_back(name);
    }
  }
  Json schema = {{"type", "object"}, {"properties", properties}, {"additionalProperties", others}};
  if (!required.empty()) schema["required"] = required;
  return schema;
}

Json MakeNode(const KeyNode& node) {
  Json schema = node.children.empty() ? MakeLeaf(*node.row) : MakeMap(node);
  if (node.row && node.row->type == KeyType::kList) {
    schema = {{"type", "array"}, {"items", schema}};
  } else if (node.row && node.row->type == KeyType::kMap) {
    schema = {{"type", "object"}, {"additionalProperties", schema}};
  }
  if (node.row) schema["description"] = node.row->meaning;
  return schema;
}

/** A table by its data dictionary. */
struct TableSource {
  std::string name;
  std::string about;  ///< where it is written, ": ", what a row is
  Json schema;
};

/** A hand whose digit and joint stand for those of any. */
Hand MakeAnyHand() {
  Hand hand;
  hand.digits.emplace_back().id = "DIGIT";
  hand.joints.emplace_back().name = "JOINT";
  return hand;
}

/** A study with one factor, group and digit, which stand for any. */
StudyResult MakeAnyStudy() {
  StudyResult result;
  result.digits = {"DIGIT"};
  result.study.factors = {{"FACTOR", {"LEVEL"}, {1.0}, ""}};
  result.study.groups = {{"GROUP", {"LEVEL"}, {}, ""}};
  result.study.config.session = "SESSION";
  return result;
}

/** Of sessions and of what is run on them. */
std::vector<TableSource> ListSessionTables() {
  std::vector<TableSource> tables = {
      {"trials.csv",
       "export/ of a session: one row per trial; with conditions also the column condition and a "
       "column per factor",
       MakeTableSchema(ListTrialColumns({}), "")},
      {"events.csv", "export/ of a session: one row per contact event",
       MakeTableSchema(ListEventColumns(), "")},
      {"basin.csv", "basin: one row per tested offset", MakeBasinSchema()},
      {"numerics.csv", "check-numerics: one row per trial and variant", MakeNumericsSchema()},
      {kGraspTable, "grasps judge: one row per grasp, profile and disturbance",
       MakeGraspTableSchema()},
      {kCandidateTable, "rehearse: one row per tested candidate", MakeCandidateTableSchema()},
      {"individuals.csv", "optimise: one row per individual of step 2", MakeIndividualSchema()},
      {"summary.csv", "campaign: one row per hand, object and variant of the grasp",
       MakeVariantSchema()},
      {"comparison.csv", "campaign --compare: one row per search", MakeComparisonSchema()}};
  SweepSummary sweep;
  sweep.factors = {{"FACTOR", {}}};
  const std::pair<const char*, std::vector<ExportTable>> exports[] = {
      {"export/ of a sweep", MakeSweepTables(sweep)},
      {"export/ of a session with grip thresholds", MakeThresholdTables({{}})},
      {"export/ of a map", MakeMapTables({})}};
  for (const auto& [about, list] : exports) {
    for (const ExportTable& table : list) {
      tables.push_back({table.name + ".csv", about, table.schema});
    }
  }
  return tables;
}

/** Of one trial, and of a hand. */
std::vector<TableSource> ListTrialTables() {
  const Hand hand = MakeAnyHand();
  return {
      {"TRIAL.csv", "trial --trace, replay --trajectory csv: one row per instant of a trial",
       MakeTableSchema(ListTraceColumns(hand), "")},
      {"TRIAL.contacts.csv", "replay --trajectory csv: one row per contact of the hand and instant",
       MakeTrajectoryContactSchema(hand)},
      {"TRIAL.events.csv", "replay --trajectory csv: one row per event of a trial",
       MakeTrajectoryEventSchema()},
      {"TRIAL.elements.csv",
       "replay --trajectory csv: one row per tactile element; the force on its cell at each "
       "instant is column element_<number>_n of TRIAL.taxels.csv [N]",
       MakeTrajectoryTaxelSchema()},
      {"motion.csv", "export --mjcf: one row per step with the commands of the hand",
       MakeMotionSchema(hand)},
      {"GRASPS.csv", "hand show --grasps --csv: one row per number of a grasp",
       MakeGraspNumberSchema()}};
}

/** A table that the user writes beside study.yaml. */
TableSource MakeInputTable(const char* name, const char* about,
                           const std::vector<InputColumn>& columns) {
  Json fields = Json::array();
  for (const InputColumn& column : columns) {
    fields.push_back({{"name", column.name},
                      {"type", column.type},
                      {"unit", column.unit},
                      {"description", column.meaning}});
  }
  return {name, about, {{"fields", fields}}};
}

/** Of studies of people. */
std::vector<TableSource> ListStudyTables() {
  const StudyResult study = MakeAnyStudy();
  MeasureTable measure;
  measure.measure = "MEASURE";
  measure.factors = study.study.factors;
  measure.groups = study.study.groups;
  measure.sessions = {"SESSION"};
  std::vector<TableSource> tables = {
      MakeInputTable("trials.csv",
                     "input of a study, beside study.yaml: one row per trial; a column per factor, "
                     "group and session comes beside these",
                     ListTrialInputColumns()),
      MakeInputTable("objects.csv", "input of a study (key objects): one row per object",
                     ListObjectInputColumns()),
      MakeInputTable("hypotheses.csv", "input of a study (key hypotheses): one row per measure",
                     ListHypothesisInputColumns()),
      {"wide.csv", "study: one row per participant, one column per measure and condition",
       MakeWideSchema(study)},
      {"tidy.csv", "tidy/ of a study: one row per included trial and measure",
       Json::parse(FormatTidyExport({measure}).dictionary)},
      {"reviews.csv", "study review: one row per contact, to be completed by a reviewer",
       MakeReviewSchema()},
      {"truth.csv", "study demo: one row per synthetic trial, its known events",
       MakeTruthSchema()}};
  const std::map<std::string, const char*> abouts = {
      {"trials.csv", "study: one row per trial of the plan"},
      {"measures.csv", "study: one row per included trial"},
      {"events.csv", "study: one row per event of every analysed trial, by each detector"},
      {"statistics.csv", "study: one row per test or estimate"},
      {"openings.csv", "tidy/ of a study: one row per included trial and measure of opening"}};
  for (const auto& [name, schema] : MakeStudySchemas(study)) {
    tables.push_back({name, abouts.at(name), schema});
  }
  return tables;
}

}  // namespace

const std::vector<FileFormat>& ListFileFormats() {
  static const std::vector<FileFormat> formats = [] {
    FileKeys hand = ListHandKeys();
    hand.insert(hand.end(), ListHandGraspKeys().begin(), ListHandGraspKeys().end());
    return std::vector<FileFormat>{
        {"object.yaml", "an object to grasp, beside its mesh", ListObjectKeys()},
        {"hand.yaml", "a hand: properties that hand.urdf beside it cannot state", hand},
        {"tactile.yaml", "the tactile elements of a hand, beside its hand.yaml; optional",
         ListTactileKeys()},
        {"arm.yaml", "an arm that carries hands, for graspbench run --arm FOLDER", ListArmKeys()},
        {"session.yaml",
         "what graspbench run simulates; session.json of a result has the same keys and is also "
         "accepted",
         ListSessionKeys()},
        {"sweep.yaml", "a session under many conditions, for graspbench sweep", ListSweepKeys()},
        {"study.yaml", "a study of human grasps, for graspbench study run", ListStudyKeys()},
        {"columns.yaml",
         "the meaning of a plain table's columns, for recording.mapping of study.yaml and "
         "--mapping of graspbench mocap; graspbench new mapping FILE proposes one",
         ListMappingKeys()},
        {"grasp.yaml", "a grasp in its own file, for graspbench run --grasp FILE",
         ListGraspFileKeys()},
        {"profile.yaml",
         "a protocol for judging grasps, for graspbench grasps judge --profile FILE",
         ListProfileKeys()},
        {"pipeline.yaml", "the stages of a pipeline, for graspbench pipeline run",
         ListPipelineKeys()},
        {"benchmark.yaml",
         "the fixed part of a benchmark, for graspbench run, entry, board --benchmark FILE",
         ListBenchmarkKeys()},
        {"policy.yaml", "the messages to a policy server, for graspbench run --policy FILE",
         ListPolicyServerKeys()},
        {"scene.json", "settings of graspbench optimise, written into its folder",
         DescribeConfig(SceneConfig()), true},
        {"campaign.json", "settings of graspbench campaign, written into its folder",
         ListCampaignKeys(), true},
        {"development.json", "settings of graspbench hand develop, written into its folder",
         DescribeConfig(DevelopmentConfig()), true},
    };
  }();
  return formats;
}

Json MakeFileSchema(const FileFormat& format) {
  Json schema = MakeMap(MakeTree(format.keys));
  schema["$schema"] = "https://json-schema.org/draft/2020-12/schema";
  schema["title"] = format.name;
  schema["description"] = format.about;
  return schema;
}

const std::vector<TableFormat>& ListTableFormats() {
  static const std::vector<TableFormat> formats = [] {
    std::vector<TableFormat> tables;
    for (const auto& list : {ListSessionTables(), ListTrialTables(), ListStudyTables()}) {
      for (const TableSource& source : list) {
        tables.push_back({source.name, source.about, {}});
        for (const Json& field : source.schema.at("fields")) {
          const auto get = [&field](const char* key) { return field.value(key, std::string()); };
          tables.back().columns.push_back(
              {get("name"), get("type"), get("unit"), get("description")});
        }
      }
    }
    return tables;
  }();
  return formats;
}

bool IsNameOf(const TableColumn& column, const std::string& name) {
  if (column.name == name) return true;
  // What stands before and behind the word in capitals.
  const auto is_capital = [](unsigned char c) { return std::isupper(c) != 0; };
  const std::string& pattern = column.name;
  const auto begin = std::find_if(pattern.begin(), pattern.end(), is_capital);
  const auto end = std::find_if_not(begin, pattern.end(), is_capital);
  const auto before = static_cast<size_t>(begin - pattern.begin());
  const auto behind = static_cast<size_t>(pattern.end() - end);
  return end - begin > 2 && before > 0 && name.size() > before + behind &&
         name.compare(0, before, pattern, 0, before) == 0 &&
         name.compare(name.size() - behind, behind, pattern, pattern.size() - behind) == 0;
}

}  // namespace graspbench
