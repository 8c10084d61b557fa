#include "reports/campaign/campaign_report.h"

#include <algorithm>

#include "core/base/config.h"
#include "core/base/hash.h"
#include "core/base/text/text.h"
#include "reports/page/layout.h"

namespace graspbench {

std::vector<CampaignSection> ListCampaignSections() {
  return {
#define GRASPBENCH_CAMPAIGN_SECTION(name) name##_campaign_section(),
#include "reports/campaign/sections/section_list.inc"
#undef GRASPBENCH_CAMPAIGN_SECTION
  };
}

namespace {

/** Appends every setting that differs from its default, in the order of the configuration. */
void AddSettings(const Json& config, const Json& defaults, const std::string& above,
                 std::string& line) {
  for (const auto& [key, value] : config.items()) {
    if (value.is_object()) {
      AddSettings(value, defaults.at(key), above + key + ".", line);
    } else if (value != defaults.at(key)) {
      line += " --set '" + above + key + "=" + FormatJson(value) + "'";
    }
  }
}

std::string MakeCommand(const CampaignConfig& config) {
  std::string line = "graspbench campaign";
  AddSettings(ConfigToJson(config), ConfigToJson(CampaignConfig()), "", line);
  return line + " --out ANOTHER";
}

}  // namespace

std::string MakeCampaignReport(const CampaignData& data) {
  const CampaignConfig& config = data.campaign.config;
  const std::string subtitle =
      std::to_string(CountComplete(data.scenes)) + " of " +
      FormatCount(static_cast<int>(data.scenes.size()), "scene") + " finished, " +
      FormatCount(config.optimise.evaluations, "evaluation") + " each, " +
      FormatCount(config.session.trials, "benchmark trial") + " per variant, seed " +
      std::to_string(config.optimise.seed) + DescribeDamage(data.campaign.damage) +
      (data.campaign.benchmark.records.empty()
           ? ""
           : DescribePhysics(data.campaign.benchmark.physics_version));
  PageFrame frame = {"Optimised grasps", subtitle};
  frame.commands = {MakeCommand(config), "graspbench report DIR"};
  frame.facts = {{"Seed of the search", std::to_string(config.optimise.seed)},
                 {"Seed of the benchmark", std::to_string(config.session.seed)},
                 {"Hash of the configuration", CalcHashHex(FormatJson(ConfigToJson(config)))}};
  frame.references = {"roethling2007", "sherman2011", "ferrari1992", "efron1987"};
  return MakeSectionedPage(frame, ListCampaignSections(), data);
}

std::filesystem::path WriteCampaignReport(const std::filesystem::path& folder,
                                          const Campaign& campaign) {
  const SessionSummary benchmark = SummariseSession(campaign.benchmark);
  const SessionModels models = LoadSessionModels(campaign.benchmark);
  const std::vector<SceneVariants> scenes = ListScenes(campaign, benchmark);
  const VariantPictures pictures = RenderVariantPictures(campaign.benchmark, scenes, models);
  return WriteReportPage(folder,
                         MakeCampaignReport({campaign, benchmark, scenes, models, pictures}));
}

}  // namespace graspbench
