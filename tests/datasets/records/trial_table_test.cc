#include "datasets/records/trial_table.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "tests/datasets/session/fake_session.h"

namespace graspbench {
namespace {

/** A reader of RFC 4180, written for this test: rows of cells. */
std::vector<std::vector<std::string>> ParseCsv(const std::string& text) {
  std::vector<std::vector<std::string>> rows(1, {""});
  bool is_quoted = false;
  for (size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (is_quoted && c == '"' && i + 1 < text.size() && text[i + 1] == '"') {
      rows.back().back() += '"';
      ++i;
    } else if (c == '"') {
      is_quoted = !is_quoted;
    } else if (!is_quoted && c == ',') {
      rows.back().emplace_back();
    } else if (!is_quoted && c == '\n') {
      rows.push_back({""});
    } else {
      rows.back().back() += c;
    }
  }
  rows.pop_back();
  return rows;
}

std::vector<TrialRecord> MakeFakeRecords(int count) {
  std::vector<TrialRecord> records;
  for (int i = 0; i < count; ++i) {
    records.push_back(MakeFakeRecord({"id" + std::to_string(i), "a, \"b\"", "mug", "g1", i}));
  }
  return records;
}

TEST(TrialTable, HasTheColumnsThatProgramsRelyOn) {
  std::string names;
  for (const TrialColumn& column : ListTrialColumns({})) names += column.name + " ";
  EXPECT_EQ(
      names,
      "trial_id hand object grasp trial outcome success gct_s gft_s got_s gft_ratio got_ratio "
      "contact_before_start contact_order lift_height_m hold_slip_m hold_creep_m "
      "end_speed_m_per_s grip_force_n closure_rise_m closure_displacement_m closure_slide_m "
      "object_height_m weight_n worst_penetration_m steady_penetration_m sigma "
      "sigma_stabilisation sigma_lift sigma_proposed epsilon epsilon_hold normal_force_n "
      "slip_speed_m_per_s opposition energy_residual_j num_steps num_unconverged "
      "simulated_time_s breaking_force_n breaking_direction breaking_moment_nm volume "
      "epsilon_ferrari_canny epsilon_graspit epsilon_simox epsilon_dexgraspbench "
      "epsilon_dex_net epsilon_frogger verdict_lift_off score_lift_off verdict_dexgraspbench "
      "score_dexgraspbench verdict_graspa score_graspa verdict_multigrippergrasp "
      "score_multigrippergrasp verdict_nist_pull score_nist_pull t_TH_s closing_TH gap_TH_m "
      "t_FF_s closing_FF gap_FF_m t_MF_s closing_MF gap_MF_m t_RF_s closing_RF gap_RF_m "
      "t_LF_s closing_LF gap_LF_m palm_touches opposition_type hold_force_n grip_asked_n "
      "grip_held_n grip_faults grip_excess seat caged draw_x_m draw_y_m draw_yaw_rad reason "
      "mechanism mechanism_part mechanism_phase mechanism_time_s loss_turn_rad normal_work_j "
      "friction_work_j gravity_work_j diagnosis ");
}

TEST(TrialTable, JudgedTrialsHaveTheJudgesColumns) {
  auto records = MakeFakeRecords(2);
  Judgement judgement;
  judgement.loads = {{"force +x", 3.0, true}, {"force -y", 2.0, true}, {"moment +x", 0.1, true}};
  judgement.breaking_force = 2.0;
  judgement.epsilons = {{"dex-net", 0.25}};
  judgement.verdicts = {{"graspa", true, 4.0}};
  records[1].judgement = judgement;
  std::map<std::string, Json> bare, judged;
  for (const TrialColumn& column : ListTrialColumns(records)) {
    bare[column.name] = column.value(records[0]);
    judged[column.name] = column.value(records[1]);
  }
  EXPECT_TRUE(bare["breaking_force_n"].is_null() && judged["epsilon_simox"].is_null());
  EXPECT_EQ(judged["breaking_force_n"], 2.0);
  EXPECT_EQ(judged["breaking_direction"], "force -y");
  EXPECT_EQ(judged["epsilon_dex_net"], 0.25);
  EXPECT_EQ(judged["verdict_graspa"], 1);
  EXPECT_EQ(judged["verdict_lift_off"], 0);
}

TEST(TrialTable, CsvReadsBackAsTheRecords) {
  const auto records = MakeFakeRecords(40);
  const auto columns = ListTrialColumns(records);
  const auto rows = ParseCsv(FormatCsv(columns, records));
  ASSERT_EQ(rows.size(), 41u);
  const auto cell = [&](size_t row, const std::string& name) {
    for (size_t i = 0; i < columns.size(); ++i) {
      if (columns[i].name == name) return rows[row + 1].at(i);
    }
    return std::string("no such column");
  };
  std::set<Outcome> seen;
  for (size_t i = 0; i < records.size(); ++i) {
    ASSERT_EQ(rows[i + 1].size(), columns.size());
    const TrialResult& result = records[i].result;
    seen.insert(result.outcome);
    EXPECT_EQ(cell(i, "hand"), "a, \"b\"");
    EXPECT_EQ(cell(i, "trial"), std::to_string(i));
    EXPECT_EQ(cell(i, "outcome"), NameOf(result.outcome));
    EXPECT_EQ(cell(i, "success"), result.outcome == Outcome::kSuccess ? "1" : "0");
    EXPECT_EQ(cell(i, "reason"), result.reason);
    EXPECT_EQ(cell(i, "contact_before_start"), result.timing.contact_before_start ? "1" : "0");
    EXPECT_EQ(std::stod(cell(i, "grip_force_n")), result.grip_force);
    EXPECT_EQ(std::stod(cell(i, "t_TH_s")), result.contacts[2].time);
    EXPECT_EQ(cell(i, "t_RF_s"), "");
    EXPECT_EQ(std::stod(cell(i, "closing_TH")), result.touches[2].closing);
    EXPECT_EQ(cell(i, "gap_TH_m"), "0.0");
    EXPECT_EQ(cell(i, "gap_LF_m"), "");
    EXPECT_EQ(std::stod(cell(i, "sigma")), result.stability.sigma);
    EXPECT_EQ(std::stod(cell(i, "epsilon")), result.stability.stabilisation.quality);
    EXPECT_EQ(cell(i, "sigma_lift"), "");
    if (result.outcome == Outcome::kNoContact) {
      EXPECT_EQ(cell(i, "gct_s"), "");
      EXPECT_EQ(cell(i, "t_MF_s"), "");
      EXPECT_EQ(cell(i, "closing_MF"), "");
      EXPECT_EQ(std::stod(cell(i, "gap_MF_m")), result.touches[1].smallest_gap);
    } else {
      EXPECT_EQ(std::stod(cell(i, "gct_s")), result.timing.gct);
    }
    EXPECT_EQ(cell(i, "hold_slip_m").empty(), result.outcome != Outcome::kSuccess);
  }
  EXPECT_GE(seen.size(), 6u);
}

TEST(TrialTable, DrawsAreThoseThatTheTrialWasRunWith) {
  const SessionInputs inputs = MakeFakeInputs();
  SessionConfig config;
  config.seed = 5;
  config.variation.offset = 0.02;
  for (const PlannedTrial& planned : MakePlan(config, inputs)) {
    const TrialDraw draw = MakeTrialSetup(config, inputs, planned).draw;
    const TrialRecord record = MakeFakeRecord(planned);
    std::map<std::string, Json> row;
    for (const TrialColumn& column : ListTrialColumns({record}, config)) {
      row[column.name] = column.value(record);
    }
    EXPECT_EQ(row["draw_x_m"], draw.offset_x);
    EXPECT_EQ(row["draw_y_m"], draw.offset_y);
    EXPECT_EQ(row["draw_yaw_rad"], draw.offset_yaw);
  }
}

// Only where a camera chooses, under a condition perhaps, so that other sessions' tables stay.
TEST(TrialTable, WhatTheCameraChoseHasAColumn) {
  std::vector<TrialRecord> records = MakeFakeRecords(2);
  records[0].result.sight_grasp = "g3";
  const auto find = [&](const SessionConfig& config) {
    std::vector<Json> values;
    for (const TrialColumn& column : ListTrialColumns(records, config)) {
      if (column.name != "sight_grasp") continue;
      for (const TrialRecord& record : records) values.push_back(column.value(record));
    }
    return values;
  };
  SessionConfig config;
  EXPECT_TRUE(find(config).empty());
  config.grasps = {"g1", "by-sight"};
  EXPECT_EQ(find(config), (std::vector<Json>{"g3", Json()}));
  config.grasps = {"best"};
  config.conditions = {{"seen", {"grasp=by-sight"}}};
  EXPECT_EQ(find(config), (std::vector<Json>{"g3", Json()}));
}

TEST(TrialTable, EventsAreATableOfTheirOwn) {
  const auto records = MakeFakeRecords(3);
  std::vector<EventRow> events;
  for (const TrialRecord& record : records) {
    for (const EventRow& event : ListEvents(record)) events.push_back(event);
  }
  const auto rows = ParseCsv(FormatCsv(ListEventColumns(), events));
  ASSERT_EQ(rows.size(), 7u);
  EXPECT_EQ(rows[0],
            (std::vector<std::string>{"trial_id", "hand", "object", "grasp", "trial", "time_s",
                                      "digit", "link", "event", "impulse_ns", "contact_rank"}));
  EXPECT_EQ(rows[3][4], "1");
  EXPECT_EQ(rows[3][8], "touch");
  EXPECT_EQ(rows[3][9], "");
  EXPECT_EQ(rows[4][8], "lost");
  EXPECT_EQ(std::stod(rows[4][9]), records[1].result.contact_events[1].impulse);
}

TEST(TrialTable, TheOrderOfContactTiesWhatTouchedInTheSameStep) {
  auto records = MakeFakeRecords(1);
  TrialResult& result = records[0].result;
  result.contacts = {{"FF", false, 0.504}, {"MF", false, 0.500}, {"TH", true, 0.500}};
  result.touches.resize(3);
  result.simulated_time = 2.0;
  result.num_steps = 500;  // of 4 ms
  const auto touch = ContactEventKind::kTouch;
  result.contact_events = {{0.500, touch, "TH", "distal", kUnset},
                           {0.500, touch, "palm", "palm", kUnset},
                           {0.504, touch, "FF", "distal", kUnset},
                           {0.508, touch, "FF", "middle", kUnset}};
  for (const TrialColumn& column : ListTrialColumns(records)) {
    if (column.name == "contact_order") {
      EXPECT_EQ(column.value(records[0]), "MF=TH<FF");
    }
  }
  const auto rows = ParseCsv(FormatCsv(ListEventColumns(), ListEvents(records[0])));
  ASSERT_EQ(rows.size(), 5u);
  EXPECT_EQ(rows[1].back(), "1");
  EXPECT_EQ(rows[2].back(), "");  // the palm is no digit
  EXPECT_EQ(rows[3].back(), "2");
  EXPECT_EQ(rows[4].back(), "");  // the digit had touched before
}

TEST(TrialTable, OtherDigitsGetColumnsByName) {
  auto records = MakeFakeRecords(1);
  records[0].result.contacts.push_back({"Z", false, 0.25});
  records[0].result.contacts.push_back({"A", false, 0.5});
  records[0].result.touches.resize(5);
  const auto columns = ListTrialColumns(records);
  std::vector<std::string> tail;
  for (size_t i = columns.size() - 31; i < columns.size(); ++i) tail.push_back(columns[i].name);
  EXPECT_EQ(tail, (std::vector<std::string>{"t_LF_s",
                                            "closing_LF",
                                            "gap_LF_m",
                                            "t_A_s",
                                            "closing_A",
                                            "gap_A_m",
                                            "t_Z_s",
                                            "closing_Z",
                                            "gap_Z_m",
                                            "palm_touches",
                                            "opposition_type",
                                            "hold_force_n",
                                            "grip_asked_n",
                                            "grip_held_n",
                                            "grip_faults",
                                            "grip_excess",
                                            "seat",
                                            "caged",
                                            "draw_x_m",
                                            "draw_y_m",
                                            "draw_yaw_rad",
                                            "reason",
                                            "mechanism",
                                            "mechanism_part",
                                            "mechanism_phase",
                                            "mechanism_time_s",
                                            "loss_turn_rad",
                                            "normal_work_j",
                                            "friction_work_j",
                                            "gravity_work_j",
                                            "diagnosis"}));
  EXPECT_EQ(columns[columns.size() - 25].value(records[0]), 0.25);
}

TEST(TrialTable, SchemaDescribesEveryColumn) {
  const auto columns = ListTrialColumns({});
  const Json fields = MakeTableSchema(columns, "trial_id").at("fields");
  ASSERT_EQ(fields.size(), columns.size());
  const std::set<std::string> types = {"string", "integer", "number", "boolean"};
  const std::pair<const char*, const char*> suffixes[] = {
      {"_m_per_s", "m/s"}, {"_s", "s"}, {"_m", "m"}, {"_n", "N"}, {"_j", "J"}};
  for (size_t i = 0; i < fields.size(); ++i) {
    const std::string& name = fields[i].at("name").str();
    EXPECT_EQ(name, columns[i].name);
    EXPECT_EQ(types.count(fields[i].at("type").str()), 1u) << name;
    EXPECT_FALSE(fields[i].at("description").get<std::string>().empty()) << name;
    for (const auto& [suffix, unit] : suffixes) {
      const std::string end = suffix;
      if (name.size() > end.size() && name.substr(name.size() - end.size()) == end) {
        EXPECT_EQ(fields[i].value("unit", ""), unit) << name;
        break;
      }
    }
  }
}

}  // namespace
}  // namespace graspbench
