#include "reports/scenes/cell_pictures.h"

#include <algorithm>
#include <atomic>
#include <memory>
#include <thread>
#include <utility>

#include "core/base/error.h"
#include "core/base/text/text.h"
#include "core/render/hand_scene.h"
#include "core/render/scene.h"
#include "reports/scenes/instant_scene.h"

namespace graspbench {

namespace {

/** Names the moment; a failed trial may end long before the hold, so its last picture is "End". */
std::string NameMoment(Moment moment, const TrialResult& result) {
  const bool is_end = moment == Moment::kLifted && !IsSuccess(result.outcome);
  return is_end ? "End" : Capitalise(NameOf(moment));
}

const std::vector<Filmstrip>* FindStrips(const CellPictures& pictures, const std::string& cell) {
  const auto found = pictures.by_cell.find(cell);
  return found == pictures.by_cell.end() || found->second.empty() ? nullptr : &found->second;
}

}  // namespace

Html DrawFilmstrip(const std::vector<Picture>& pictures, const TrialResult& result,
                   const std::string& of) {
  Html frames;
  for (const Picture& picture : pictures) {
    const std::string name = NameMoment(picture.moment, result);
    frames +=
        Element("figure", {},
                Element("img", {{"src", MakeDataUri("image/webp", picture.webp)},
                                {"width", std::to_string(kPictureWidth)},
                                {"height", std::to_string(kPictureHeight)},
                                {"alt", of + ": " + name}}) +
                    Element("figcaption", {}, name + ", " + FormatFixed(picture.time, 2) + " s"));
  }
  return Element("div", {{"class", "film"}}, frames);
}

Html DrawThumbnail(const std::vector<Picture>& pictures) {
  const Picture* shown = nullptr;
  for (const Picture& picture : pictures) {
    if (shown == nullptr || shown->moment != Moment::kClosed) shown = &picture;
  }
  if (shown == nullptr || shown->thumbnail.empty()) return {};
  return Element("img", {{"class", "thumb"},
                         {"src", MakeDataUri("image/webp", shown->thumbnail)},
                         {"width", std::to_string(kPictureWidth / kThumbnailShrink)},
                         {"height", std::to_string(kPictureHeight / kThumbnailShrink)},
                         {"alt", ""}});
}

Html DrawFirstThumbnail(const CellPictures& pictures, const std::string& cell) {
  const std::vector<Filmstrip>* strips = FindStrips(pictures, cell);
  return strips ? DrawThumbnail(strips->front().pictures) : Html();
}

Html DrawLastThumbnail(const CellPictures& pictures, const std::string& cell) {
  const std::vector<Filmstrip>* strips = FindStrips(pictures, cell);
  return strips ? DrawThumbnail(strips->back().pictures) : Html();
}

namespace {

constexpr size_t kMaxCells = 250;
constexpr size_t kMaxTrials = 3000;      // on the page
constexpr size_t kMinTrialsOfCell = 10;  // in each condition, even if the page grows beyond its
                                         // limit

}  // namespace

bool IsDrawnInFull(const CellSummary& cell, const SessionSummary& summary) {
  const size_t num_full = std::min(kMaxCells, summary.cells.size());
  return &cell < summary.cells.data() + num_full;
}

std::vector<const TrialRecord*> ChooseShownTrials(const CellSummary& cell,
                                                  const SessionSummary& summary) {
  const size_t num = cell.records.size();
  const size_t num_of_cell = std::max(kMaxTrials / summary.cells.size(), kMinTrialsOfCell);
  if (static_cast<size_t>(summary.total.finished) <= kMaxTrials || num <= num_of_cell) {
    return cell.records;
  }
  std::vector<const TrialRecord*> shown;
  for (size_t i = 0; i < num_of_cell; ++i) shown.push_back(cell.records[i * num / num_of_cell]);
  return shown;
}

std::string MakeTrialAnchor(const PlannedTrial& planned) { return "trial-" + planned.id; }

std::string MakeViewAnchor(const PlannedTrial& planned) { return "view-" + planned.id; }

std::string DescribeShownTrials(size_t num_shown, const CellSummary& cell) {
  if (num_shown == cell.records.size()) return {};
  return std::to_string(num_shown) + " of " + std::to_string(cell.records.size()) +
         " trials, evenly spaced; export/trials.csv has all of them.";
}

namespace {

// Anything within this distance of the hand's base stays in the picture [m]. An object that rolled
// away must not shrink the hand to a dot.
constexpr double kReach = 0.35;

constexpr size_t kMaxThreads = 4;
constexpr size_t kStripsPerThread = 16;  // with fewer strips, another renderer costs more than it
                                         // saves
constexpr size_t kMaxOtherStrips = 60;   // on a page beyond the first of each cell: some 1.5 MB

bool IsDrawable(const SceneSnapshot& snapshot, const Hand& hand) {
  return snapshot.q.size() == hand.num_joints() && snapshot.q.allFinite() &&
         snapshot.X_WH.matrix().allFinite() && snapshot.X_WO.matrix().allFinite();
}

/** How far hand and object have risen together since the first snapshot [m]. The camera rises with
them and can therefore be closer. It stays where it is while the object stays on the table. */
Eigen::Vector3d FindRise(const SceneSnapshot& snapshot, const SceneSnapshot& first) {
  const double hand = snapshot.X_WH.translation().z() - first.X_WH.translation().z();
  const double object = snapshot.X_WO.translation().z() - first.X_WO.translation().z();
  return Eigen::Vector3d(0.0, 0.0, std::max(0.0, std::min(hand, object)));
}

Pose Lower(Pose X, const Eigen::Vector3d& rise) {
  X.translation() -= rise;
  return X;
}

Camera Raise(Camera camera, const Eigen::Vector3d& rise) {
  camera.p_WEye += rise;
  camera.p_WTarget += rise;
  return camera;
}

/** Places the camera for the first snapshot; FindRise gives its motion for the others. */
Camera PlaceCamera(const std::vector<SceneSnapshot>& snapshots,
                   const std::shared_ptr<const Hand>& hand,
                   const std::shared_ptr<const GraspObject>& object, double aspect) {
  std::vector<Scene> framed;
  for (const SceneSnapshot& snapshot : snapshots) {
    Scene scene;
    const Eigen::Vector3d rise = FindRise(snapshot, snapshots[0]);
    AddHand(hand, snapshot.q, Lower(snapshot.X_WH, rise), &scene);
    const double distance = (snapshot.X_WH.translation() - snapshot.X_WO.translation()).norm();
    if (distance < kReach) AddObject(object, Lower(snapshot.X_WO, rise), &scene);
    framed.push_back(scene);
  }
  const Eigen::Vector3d to_eye_W = FindGraspView(*hand, snapshots[0].q, snapshots[0].X_WH);
  return FrameScenes(framed, to_eye_W, aspect);
}

/** Averages squares of `factor` pixels. @pre factor divides both sides */
Image Shrink(const Image& image, int factor) {
  Image small;
  small.width = image.width / factor;
  small.height = image.height / factor;
  for (int y = 0; y < small.height; ++y) {
    for (int x = 0; x < small.width; ++x) {
      for (int channel = 0; channel < 3; ++channel) {
        int sum = 0;
        for (int i = 0; i < factor * factor; ++i) {
          const int row = y * factor + i / factor, column = x * factor + i % factor;
          sum += image.rgb[static_cast<size_t>(3 * (row * image.width + column) + channel)];
        }
        small.rgb.push_back(static_cast<uint8_t>(sum / (factor * factor)));
      }
    }
  }
  return small;
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
    const Image image = renderer.Render(scene, Raise(camera, FindRise(snapshot, snapshots[0])));
    pictures.push_back({snapshot.moment, snapshot.time, EncodeWebp(image),
                        EncodeWebp(Shrink(image, kThumbnailShrink))});
  }
  return pictures;
}

std::vector<std::string> RenderInstants(const std::vector<const TraceInstant*>& instants,
                                        double arrow_scale, const std::shared_ptr<const Hand>& hand,
                                        const std::shared_ptr<const GraspObject>& object,
                                        Renderer& renderer) {
  std::vector<SceneSnapshot> postures;
  for (const TraceInstant* instant : instants) {
    postures.push_back({Moment::kClosed, instant->time, instant->X_WH, instant->X_WO, instant->q});
  }
  const Camera camera =
      PlaceCamera(postures, hand, object, static_cast<double>(kPictureWidth) / kPictureHeight);
  std::vector<std::string> pictures;
  for (size_t i = 0; i < instants.size(); ++i) {
    const SceneSnapshot& posture = postures[i];
    Scene scene = MakeGraspScene(hand, posture.q, posture.X_WH, object, posture.X_WO);
    AddContactMarks(MakeContactMarks(*instants[i]), arrow_scale, &scene);
    pictures.push_back(
        EncodeWebp(renderer.Render(scene, Raise(camera, FindRise(posture, postures[0])))));
  }
  return pictures;
}

namespace {

struct StripJob {
  const CellSummary* cell = nullptr;
  const TrialRecord* record = nullptr;
  std::vector<Picture> pictures;
  std::string problem;  ///< why there are none
};

/** Lists the strips that the page shows, cell by cell, before they are drawn. */
std::vector<StripJob> ListStrips(const Session& session, const SessionSummary& summary,
                                 const SessionModels& models, CellPictures* pictures) {
  std::vector<StripJob> jobs;
  size_t num_others_left = kMaxOtherStrips;
  for (const CellSummary& cell : summary.cells) {
    const auto hand = models.FindHand(cell.hand);
    if (cell.records.empty() || !hand || !models.FindObject(cell.object) ||
        !IsDrawnInFull(cell, summary)) {
      continue;
    }
    std::vector<const TrialRecord*> records = ChooseTrialPerOutcome(cell, *hand, session);
    if (records.empty()) {
      pictures->problems.push_back("no trial of " + NameOfCell(cell, models) +
                                   " has snapshots that fit the present hand");
      continue;
    }
    records.resize(std::min(records.size(), num_others_left + 1));
    num_others_left -= records.size() - 1;
    for (const TrialRecord* record : records) jobs.push_back({&cell, record, {}, {}});
  }
  return jobs;
}

/** Draws jobs that no other thread has taken; the first failure ends the work of all threads. */
void DrawStrips(const Session& session, const SessionModels& models, std::vector<StripJob>& jobs,
                std::atomic<size_t>& next) {
  std::unique_ptr<Renderer> renderer;
  for (size_t i = next++; i < jobs.size(); i = next++) {
    StripJob& job = jobs[i];
    try {
      if (!renderer) renderer = std::make_unique<Renderer>(kPictureWidth, kPictureHeight);
      job.pictures = RenderSnapshots(LoadWhole(session, *job.record).result.snapshots,
                                     models.FindHand(job.cell->hand),
                                     models.FindObject(job.cell->object), *renderer);
    } catch (const Error& e) {
      job.problem = std::string("no pictures could be drawn: ") + e.what();
      next = jobs.size();
    }
  }
}

}  // namespace

CellPictures RenderCellPictures(const Session& session, const SessionSummary& summary,
                                const SessionModels& models) {
  CellPictures pictures;
  std::vector<StripJob> jobs = ListStrips(session, summary, models, &pictures);
  // Each thread has its own renderer; the result does not depend on which one draws a strip.
  std::atomic<size_t> next = 0;
  const auto draw = [&] { DrawStrips(session, models, jobs, next); };
  const size_t num_threads = std::min<size_t>(
      {kMaxThreads, std::thread::hardware_concurrency(), 1 + jobs.size() / kStripsPerThread});
  std::vector<std::thread> threads;
  for (size_t i = 1; i < num_threads; ++i) threads.emplace_back(draw);
  draw();
  for (std::thread& thread : threads) thread.join();
  for (StripJob& job : jobs) {
    if (!job.problem.empty()) {
      pictures.problems.push_back(job.problem);
      return pictures;
    }
    if (job.pictures.empty()) continue;  // another job had failed before this one was drawn
    pictures.by_cell[job.cell->key].push_back({job.record, std::move(job.pictures)});
  }
  return pictures;
}

}  // namespace graspbench
