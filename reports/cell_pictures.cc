#include "reports/cell_pictures.h"

#include <algorithm>
#include <memory>

#include "core/base/error.h"
#include "core/render/hand_scene.h"
#include "core/render/scene.h"
#include "reports/shown_trials.h"

namespace graspbench {
namespace {

// An object that rolled away must not shrink the hand to a dot; what is nearer than this to the
// hand's base stays in the picture [m].
constexpr double kReach = 0.35;

constexpr size_t kMaxOtherStrips = 60;  // of a page, beside each cell's first: some 1.5 MB

bool IsDrawable(const SceneSnapshot& snapshot, const Hand& hand) {
  return snapshot.q.size() == hand.num_joints() && snapshot.q.allFinite() &&
         snapshot.X_WH.matrix().allFinite() && snapshot.X_WO.matrix().allFinite();
}

Camera PlaceCamera(const std::vector<SceneSnapshot>& snapshots,
                   const std::shared_ptr<const Hand>& hand,
                   const std::shared_ptr<const GraspObject>& object, double aspect) {
  std::vector<Scene> framed;
  for (const SceneSnapshot& snapshot : snapshots) {
    Scene scene;
    AddHand(hand, snapshot.q, snapshot.X_WH, &scene);
    const double distance = (snapshot.X_WH.translation() - snapshot.X_WO.translation()).norm();
    if (distance < kReach) AddObject(object, snapshot.X_WO, &scene);
    framed.push_back(scene);
  }
  const Eigen::Vector3d to_eye_W = FindGraspView(*hand, snapshots[0].q, snapshots[0].X_WH);
  return FrameScenes(framed, to_eye_W, aspect);
}

}  // namespace

std::vector<const TrialRecord*> ChooseTrialPerOutcome(const CellSummary& cell, const Hand& hand,
                                                      const Session& session) {
  const auto find_rank = [](const TrialRecord* record) {
    const Outcome outcome = record->result.outcome;
    return outcome == Outcome::kNotPhysical ? 0 : outcome == Outcome::kSuccess ? 1 : 2;
  };
  std::vector<const TrialRecord*> candidates = cell.records;
  std::stable_sort(candidates.begin(), candidates.end(),
                   [&](const auto* a, const auto* b) { return find_rank(a) < find_rank(b); });
  std::vector<const TrialRecord*> chosen;
  for (const TrialRecord* candidate : candidates) {
    const auto is_same = [candidate](const TrialRecord* other) {
      return other->result.outcome == candidate->result.outcome;
    };
    if (std::any_of(chosen.begin(), chosen.end(), is_same)) continue;
    const std::vector<SceneSnapshot> snapshots = LoadWhole(session, *candidate).result.snapshots;
    const bool are_drawable =
        std::all_of(snapshots.begin(), snapshots.end(),
                    [&](const SceneSnapshot& snapshot) { return IsDrawable(snapshot, hand); });
    if (!snapshots.empty() && are_drawable) chosen.push_back(candidate);
  }
  return chosen;
}

const TrialRecord* ChooseTrial(const CellSummary& cell, const Hand& hand, const Session& session) {
  const std::vector<const TrialRecord*> chosen = ChooseTrialPerOutcome(cell, hand, session);
  return chosen.empty() ? nullptr : chosen.front();
}

std::vector<Picture> RenderSnapshots(const std::vector<SceneSnapshot>& snapshots,
                                     const std::shared_ptr<const Hand>& hand,
                                     const std::shared_ptr<const GraspObject>& object,
                                     Renderer& renderer) {
  std::vector<Picture> pictures;
  const Camera camera =
      PlaceCamera(snapshots, hand, object, static_cast<double>(kPictureWidth) / kPictureHeight);
  for (const SceneSnapshot& snapshot : snapshots) {
    const Scene scene = MakeGraspScene(hand, snapshot.q, snapshot.X_WH, object, snapshot.X_WO);
    pictures.push_back(
        {snapshot.moment, snapshot.time, EncodeWebp(renderer.Render(scene, camera))});
  }
  return pictures;
}

std::string RenderSnapshotAsPng(const std::vector<SceneSnapshot>& snapshots, size_t shown,
                                const std::shared_ptr<const Hand>& hand,
                                const std::shared_ptr<const GraspObject>& object, int width,
                                int height) {
  const Camera camera = PlaceCamera(snapshots, hand, object, static_cast<double>(width) / height);
  const SceneSnapshot& snapshot = snapshots[shown];
  const Scene scene = MakeGraspScene(hand, snapshot.q, snapshot.X_WH, object, snapshot.X_WO);
  return EncodePng(Renderer(width, height).Render(scene, camera));
}

CellPictures RenderCellPictures(const Session& session, const SessionSummary& summary,
                                const SessionModels& models) {
  CellPictures pictures;
  std::unique_ptr<Renderer> renderer;
  size_t num_others_left = kMaxOtherStrips;
  for (const CellSummary& cell : summary.cells) {
    const auto hand = models.FindHand(cell.hand);
    const auto object = models.FindObject(cell.object);
    if (cell.records.empty() || !hand || !object || !IsDrawnInFull(cell, summary)) continue;
    std::vector<const TrialRecord*> records = ChooseTrialPerOutcome(cell, *hand, session);
    if (records.empty()) {
      pictures.problems.push_back("no trial of " + NameOfCell(cell, models) +
                                  " has snapshots that fit the hand as it is now");
      continue;
    }
    records.resize(std::min(records.size(), num_others_left + 1));
    num_others_left -= records.size() - 1;
    try {
      if (!renderer) renderer = std::make_unique<Renderer>(kPictureWidth, kPictureHeight);
      for (const TrialRecord* record : records) {
        pictures.by_cell[cell.key].push_back(
            {record, RenderSnapshots(LoadWhole(session, *record).result.snapshots, hand, object,
                                     *renderer)});
      }
    } catch (const Error& e) {
      pictures.problems.push_back(std::string("no pictures could be drawn: ") + e.what());
      return pictures;
    }
  }
  return pictures;
}

}  // namespace graspbench
