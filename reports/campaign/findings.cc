#include "reports/campaign/findings.h"

#include "core/base/text/text.h"
#include "datasets/session/judgement_store.h"

namespace graspbench {

std::vector<std::string> ListCampaignFindings(const CampaignData& data) {
  std::vector<std::string> findings;
  for (const SceneVariants& scene : data.scenes) {
    if (scene.scene->result.is_null()) {
      findings.push_back(data.NameOfScene(scene) + ": not finished");
    } else if (!scene.IsComplete()) {
      findings.push_back(data.NameOfScene(scene) + ": not all variants were tried");
    }
    for (const Diagnostic& finding : scene.scene->findings.entries()) {
      findings.push_back(data.NameOfScene(scene) + ": " + finding.text);
    }
  }
  findings.insert(findings.end(), data.models.problems.begin(), data.models.problems.end());
  findings.insert(findings.end(), data.pictures.problems.begin(), data.pictures.problems.end());
  const int numerical = data.benchmark.total.CountOf(Outcome::kNumericalFailure);
  if (numerical > 0) {
    findings.push_back(FormatCount(numerical, "benchmark trial") + " failed numerically");
  }
  const size_t num_unjudged = FindUnjudged(data.campaign.benchmark).size();
  if (num_unjudged > 0) {
    findings.push_back(FormatCount(static_cast<int>(num_unjudged), "held grasp") +
                       " not judged yet: breaking forces are incomplete and too low");
  }
  return findings;
}

}  // namespace graspbench
