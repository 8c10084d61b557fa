#include "workbench/trial_picture.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/render/contact_marks.h"
#include "core/render/hand_scene.h"
#include "core/trial/moment.h"
#include "workbench/scene_film.h"
#include "workbench/shell/shell_words.h"

namespace graspbench {
namespace {

constexpr double kLatestInstant = 3600.0;    // [s]
constexpr double kTraceFilmInterval = 0.05;  // [s]
constexpr double kLongestArrow = 0.045;      // [m]

std::vector<std::string> ListInstantNames() {
  std::vector<std::string> names;
  for (const PhaseRow& row : kPhases) {
    if (row.value != Phase::kDone) names.emplace_back(row.name);
  }
  for (const MomentRow& row : kMoments) names.emplace_back(row.name);
  return names;
}

/** The last instant of a phase; null when the trial did not get there. The pre-grasp is shown at the
object, as in the report. */
const TraceInstant* FindEndOf(Phase phase, const std::vector<TraceInstant>& trace) {
  if (phase == Phase::kPreGrasp) phase = Phase::kPlacing;
  const TraceInstant* last = nullptr;
  for (const TraceInstant& instant : trace) {
    if (instant.phase == phase) last = &instant;
  }
  return last;
}

/** The largest force is as long as the longest arrow, in all pictures of the trial [m/N]. */
double FindArrowScale(const TracedTrial& traced) {
  double largest = 0.0;
  for (const TraceInstant& instant : traced.trace) {
    for (const HandContact& contact : instant.contacts) {
      largest = std::max(largest, std::hypot(contact.normal_force, contact.friction_W.norm()));
    }
  }
  return largest > 0.0 ? kLongestArrow / largest : 0.0;
}

std::vector<ContactMark> MakeMarks(const TraceInstant& instant) {
  std::vector<ContactMark> marks;
  for (const HandContact& contact : instant.contacts) {
    marks.push_back({contact.p_WC, contact.nhat_W,
                     contact.normal_force * contact.nhat_W + contact.friction_W, contact.mu,
                     contact.is_sliding});
  }
  return marks;
}

std::string FindDefaultInstant(const TracedTrial& traced) {
  const bool was_closed =
      std::any_of(traced.trace.begin(), traced.trace.end(),
                  [](const TraceInstant& instant) { return instant.phase == Phase::kLiftOff; });
  return NameOf(was_closed ? Phase::kStabilisation : traced.trace.back().phase);
}

void DemandCourse(const TracedTrial& traced) {
  if (!traced.trace.empty()) return;
  throw Error(ErrorKind::kUnsupported,
              "nothing can be drawn: the trial could not begin; " + traced.result.reason);
}

}  // namespace

const TraceInstant& FindNamedInstant(const TracedTrial& traced, const std::string& name) {
  DemandCourse(traced);
  const std::string wanted = name.empty() ? FindDefaultInstant(traced) : ToLower(name);
  if (!wanted.empty() &&
      (std::isdigit(static_cast<unsigned char>(wanted[0])) || wanted[0] == '.')) {
    const double time = ParseNumber(wanted, "the time", "s", 0.0, kLatestInstant);
    const double end = traced.trace.back().time;
    if (time > end) {
      throw Error(ErrorKind::kUsage,
                  "the trial ended at " + FormatFixed(end, 3) + " s, before " + name);
    }
    return FindInstant(traced.trace, time);
  }
  const auto demand = [&](Phase phase) -> const TraceInstant& {
    if (const TraceInstant* found = FindEndOf(phase, traced.trace)) return *found;
    throw Error(ErrorKind::kUsage, "the trial ended before its " + std::string(NameOf(phase)) +
                                       ": " + NameOf(traced.result.outcome) + ", " +
                                       traced.result.reason);
  };
  for (const PhaseRow& row : kPhases) {
    if (wanted == row.name && row.value != Phase::kDone) return demand(row.value);
  }
  for (const MomentRow& row : kMoments) {
    if (wanted == row.name) return demand(row.phase);
  }
  throw Error(ErrorKind::kUsage, "\"" + name + "\" is no instant of a trial; expected a time as " +
                                     "1.25s, or the end of a phase" +
                                     SuggestNames(wanted, ListInstantNames()));
}

PictureSize ParsePictureSize(const std::string& text) {
  constexpr int kMaxSide = 4096;
  PictureSize size;
  int end = 0;
  const bool is_one =
      std::sscanf(text.c_str(), "%4dx%4d%n", &size.width, &size.height, &end) == 2 &&
      static_cast<size_t>(end) == text.size();
  const bool fits =
      size.width > 0 && size.height > 0 && size.width <= kMaxSide && size.height <= kMaxSide;
  if (is_one && fits) return size;
  throw Error(ErrorKind::kUsage, "--size: \"" + text + "\"; expected WIDTHxHEIGHT of 1 to " +
                                     std::to_string(kMaxSide) + " pixels, as 960x720");
}

Image DrawTrial(const TrialSetup& setup, const TracedTrial& traced, const TraceInstant& instant,
                const SceneView& view, const PictureSize& size) {
  Scene scene = MakeGraspScene(setup.hand, instant.q, instant.X_WH, setup.object, instant.X_WO);
  const Camera camera = PlaceCamera(view, {scene}, *setup.hand, instant.q, instant.X_WH,
                                    static_cast<double>(size.width) / size.height);
  AddContactMarks(MakeMarks(instant), FindArrowScale(traced), &scene);
  return Renderer(size.width, size.height).Render(scene, camera);
}

std::string FilmTrial(const TrialSetup& setup, const TracedTrial& traced, const SceneView& view,
                      const PictureSize& size) {
  DemandCourse(traced);
  const double scale = FindArrowScale(traced);
  SceneFilm film(setup.hand, setup.object);
  double next = 0.0;
  for (const TraceInstant& instant : traced.trace) {
    if (instant.time < next - 1e-9 && &instant != &traced.trace.back()) continue;
    next = instant.time + kTraceFilmInterval;
    film.Add(instant.time, instant.q, instant.X_WH, instant.X_WO);
    film.Mark(MakeMarks(instant), scale);
  }
  return film.Encode(view, size.width, size.height, [](size_t) { return true; });
}

}  // namespace graspbench
