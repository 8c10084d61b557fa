#include "workbench/tables/progress_tables.h"

#include "core/base/text/text.h"
#include "workbench/tables/text_table.h"

namespace graspbench {
namespace {

Json MakeShardsJson(const std::vector<ShardProgress>& shards, const char* unit) {
  Json json = Json::array();
  for (const ShardProgress& one : shards) {
    json.push_back({{"shard", FormatShard(one.shard)},
                    {unit, one.num_trials},
                    {"finished", one.num_finished},
                    {"state", NameOf(one.state)},
                    {"age_s", one.age ? Json(*one.age) : Json(nullptr)}});
  }
  return json;
}

}  // namespace

Json MakeStatusJson(const SessionProgress& progress) {
  Json judge = nullptr;
  if (progress.judge) {
    judge = {{"held_grasps", progress.judge->num_held},
             {"finished", progress.judge->num_judged},
             {"shards", MakeShardsJson(progress.judge->shards, "held_grasps")}};
  }
  return {{"trials", progress.num_trials},
          {"finished", progress.num_finished},
          {"damaged_lines", progress.num_bad_lines},
          {"without_sentinels", progress.unchecked},
          {"shards", MakeShardsJson(progress.shards, "trials")},
          {"judge", judge}};
}

Json MakeStatusJson(const CampaignProgress& progress) {
  return {{"scenes", progress.num_scenes},
          {"finished", progress.num_finished},
          {"without_sentinels", progress.unchecked},
          {"shards", MakeShardsJson(progress.shards, "scenes")},
          {"benchmark", progress.benchmark ? MakeStatusJson(*progress.benchmark) : Json(nullptr)},
          {"searches_begun", progress.num_searches}};
}

std::string FormatShards(const std::vector<ShardProgress>& shards, const char* unit) {
  TextTable table({"shard", unit, "finished", "state", "last line [s] ago"});
  for (const ShardProgress& one : shards) {
    table.AddRow({FormatShard(one.shard), std::to_string(one.num_trials),
                  std::to_string(one.num_finished), NameOf(one.state),
                  one.age ? FormatFixed(*one.age, 0) : "n/a"});
  }
  return shards.empty() ? "" : "\n" + table.Format();
}

}  // namespace graspbench
