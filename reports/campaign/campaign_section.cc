#include "reports/campaign/campaign_section.h"

#include <memory>

#include "core/base/error.h"
#include "core/base/text/text.h"
#include "core/render/scene.h"
#include "datasets/session/judgement_store.h"

namespace graspbench {

std::vector<std::string> ListCampaignFindings(const CampaignData& data) {
  std::vector<std::string> findings;
  for (const SceneVariants& scene : data.scenes) {
    if (scene.scene->result.is_null()) {
      findings.push_back(data.NameOfScene(scene) + ": not finished");
    } else if (!scene.IsComplete()) {
      findings.push_back(data.NameOfScene(scene) + ": not all variants were tested");
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

namespace {

const SceneSnapshot* FindClosed(const TrialRecord* record) {
  if (record == nullptr) return nullptr;
  for (const SceneSnapshot& snapshot : record->result.snapshots) {
    if (snapshot.moment == Moment::kClosed) return &snapshot;
  }
  return nullptr;
}

}  // namespace

VariantPictures RenderVariantPictures(const Session& benchmark,
                                      const std::vector<SceneVariants>& scenes,
                                      const SessionModels& models) {
  VariantPictures pictures;
  std::unique_ptr<Renderer> renderer;
  for (const SceneVariants& scene : scenes) {
    const auto hand = models.FindHand(scene.hand);
    const auto object = models.FindObject(scene.object);
    if (!hand || !object) continue;
    std::vector<SceneSnapshot> snapshots;
    std::vector<int> variants;
    for (int variant = 0; variant < kNumVariants; ++variant) {
      const CellSummary* cell = scene.cells[variant];
      const SceneSnapshot* closed =
          cell ? FindClosed(ChooseTrial(*cell, *hand, benchmark)) : nullptr;
      if (closed == nullptr) continue;
      snapshots.push_back(*closed);
      variants.push_back(variant);
    }
    if (snapshots.empty()) continue;
    try {
      if (!renderer) renderer = std::make_unique<Renderer>(kPictureWidth, kPictureHeight);
      const std::vector<Picture> drawn = RenderSnapshots(snapshots, hand, object, *renderer);
      for (size_t i = 0; i < drawn.size(); ++i) {
        pictures.by_scene[scene.key][variants[i]] = drawn[i];
      }
    } catch (const Error& e) {
      pictures.problems.push_back(std::string("no pictures could be drawn: ") + e.what());
      return pictures;
    }
  }
  return pictures;
}

}  // namespace graspbench
