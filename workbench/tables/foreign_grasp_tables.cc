#include "workbench/tables/foreign_grasp_tables.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/base/error.h"
#include "core/base/text/csv.h"
#include "core/base/text/text.h"
#include "datasets/grasps/map_to_hand.h"
#include "datasets/grasps/pose_numbers.h"
#include "workbench/tables/text_table.h"

namespace graspbench {

namespace {

std::vector<CsvColumn<ProfileSummary>> ListProfileColumns() {
  using Row = ProfileSummary;
  using C = CsvColumn<Row>;
  const auto bound = [](double Interval::*end) {
    return
        [end](const Row& row) { return CalcWilsonInterval(row.num_passed, row.num_judged).*end; };
  };
  return {C("profile", "", "", &Row::profile).Shown("profile"),
          C("judged", "", "", &Row::num_judged).Shown("grasps"),
          C("passed", "", "", &Row::num_passed).Shown("passed"),
          {"numerical_failures", "", "", &Row::num_numerical},
          C("interval_low", "", "", bound(&Interval::low))
              .Shown("95 % interval",
                     [](const Row& row) {
                       return FormatRateInterval(row.num_passed, row.num_judged) + " %";
                     }),
          {"interval_high", "", "", bound(&Interval::high)},
          {"labelled", "", "", [](const Row& row) { return row.labels.num_pairs(); }},
          C("kappa", "", "", [](const Row& row) { return CalcKappa(row.labels); })
              .Shown("agreement with labels",
                     [](const Row& row) {
                       const double kappa = CalcKappa(row.labels);
                       return std::isfinite(kappa) ? "kappa " + FormatFixed(kappa, 2) : "-";
                     }),
          C("jitter_share", "", "", &Row::jitter_share)
              .Shown("still passes when moved by 1 mm, 1 deg",
                     [](const Row& row) {
                       return std::isfinite(row.jitter_share) ? FormatPercent(row.jitter_share)
                                                              : "";
                     }),
          C::ForPeople("most failed at", "", [](const Row& row) {
            return row.stages.empty() ? "-" : row.stages.front().first;
          })};
}

}  // namespace

std::string FormatJudged(const JudgedSummary& summary) {
  return FormatTable(ShowTable(ListProfileColumns(), summary.profiles));
}

Json MakeJson(const JudgedSummary& summary) {
  return MakeJsonRows(ListProfileColumns(), summary.profiles);
}

namespace {

std::string DescribeStages(const ForeignGrasp& grasp) {
  std::string text;
  for (const GraspStage& stage : grasp.stages) text += (text.empty() ? "" : " ") + stage.name;
  return text;
}

std::string DescribeLabels(const std::vector<const ForeignGrasp*>& grasps) {
  int64_t passed = 0, failed = 0;
  for (const ForeignGrasp* grasp : grasps) {
    if (grasp->label) ++(*grasp->label ? passed : failed);
  }
  return passed + failed == 0
             ? "none"
             : std::to_string(passed) + " pass, " + std::to_string(failed) + " fail";
}

}  // namespace

std::vector<UnmappedGrasp> FindUnmapped(const std::vector<ForeignGrasp>& grasps, const Hand& hand) {
  std::vector<UnmappedGrasp> unmapped;
  for (const ForeignGrasp& grasp : grasps) {
    try {
      MapToHand(grasp, hand);
    } catch (const Error& error) {
      unmapped.push_back({grasp.source + ", grasp " + std::to_string(grasp.index), error.what()});
    }
  }
  return unmapped;
}

std::string FormatGraspCollection(const GraspCollection& collection) {
  std::map<std::vector<std::string>, std::vector<const ForeignGrasp*>> groups;
  std::map<std::string, int64_t> assumptions;
  for (const ForeignGrasp& grasp : collection.grasps) {
    groups[{grasp.format, grasp.hand, grasp.object, DescribeStages(grasp)}].push_back(&grasp);
    for (const std::string& assumption : grasp.assumptions) ++assumptions[assumption];
  }
  TextTable table({"format", "hand", "object", "grasps", "scale", "stages", "labels"});
  for (const auto& [key, grasps] : groups) {
    std::vector<double> scales;
    for (const ForeignGrasp* grasp : grasps) scales.push_back(grasp->scale);
    const auto [low, high] = std::minmax_element(scales.begin(), scales.end());
    table.AddRow({key[0], key[1].empty() ? "not stated" : key[1],
                  key[2].empty() ? "not stated" : key[2], std::to_string(grasps.size()),
                  *low == *high ? FormatSignificant(*low, 4)
                                : FormatSignificant(*low, 4) + " to " + FormatSignificant(*high, 4),
                  key[3], DescribeLabels(grasps)});
  }
  std::string text = collection.grasps.empty() ? "" : table.Format() + "\n";
  for (const auto& [assumption, count] : assumptions) {
    text += "assumed for " + FormatCount(count, "grasp") + ": " + assumption + "\n";
  }
  const auto num_unread = static_cast<int64_t>(collection.unread.size());
  text += std::to_string(collection.num_files - num_unread) + " of " +
          FormatCount(collection.num_files, "file") + " read, " +
          FormatCount(static_cast<int64_t>(collection.grasps.size()), "grasp") + "\n";
  for (const UnreadFile& file : collection.unread) text += "not read: " + file.reason + "\n";
  return text;
}

Json MakeJson(const GraspCollection& collection) {
  Json grasps = Json::array(), unread = Json::array();
  for (const ForeignGrasp& grasp : collection.grasps) {
    Json stages = Json::array();
    for (const GraspStage& stage : grasp.stages) {
      stages.push_back({{"name", stage.name},
                        {"X_OR_m_wxyz", NumbersFromPose(stage.X_OR)},
                        {"joints", stage.joints}});
    }
    grasps.push_back({{"source", grasp.source},
                      {"index", grasp.index},
                      {"format", grasp.format},
                      {"hand", grasp.hand},
                      {"root_link", grasp.root_link},
                      {"object", grasp.object},
                      {"scale", grasp.scale},
                      {"label", grasp.label ? Json(*grasp.label) : Json(nullptr)},
                      {"joint_names", grasp.joint_names},
                      {"stages", stages},
                      {"assumptions", grasp.assumptions}});
  }
  for (const UnreadFile& file : collection.unread) {
    unread.push_back({{"file", file.name}, {"reason", file.reason}});
  }
  return {{"num_files", collection.num_files}, {"grasps", grasps}, {"unread", unread}};
}

}  // namespace graspbench
