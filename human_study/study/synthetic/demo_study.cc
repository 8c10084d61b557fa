#include "human_study/study/synthetic/demo_study.h"

#include <algorithm>
#include <cmath>

#include "core/base/files/files.h"
#include "core/base/text/csv.h"

namespace graspbench {
namespace {

constexpr char kStudyYaml[] =
    "name: Synthetic reaches to cylinders\n"
    "objects: objects.csv\n"
    "hypotheses: hypotheses.csv\n"
    "factors: [diameter_m]\n"
    "markers:\n"
    "  thumb: thumb_tip\n"
    "  index: index_tip\n"
    "  middle: middle_tip\n"
    "  ring: ring_tip\n"
    "  little: little_tip\n"
    "  wrist: wrist\n"
    "  object: [object_1, object_2, object_3]\n";

/** The slope of Smeets and Brenner's review (Motor Control 3 (1999)); 10 ms are less than a filter
of 10 Hz can tell. */
constexpr char kHypotheses[] =
    "measure,slope,equal_within\n"
    "peak_opening_m,0.82,\n"
    "grasp_forming_time_s,,0.01\n";

std::string NameOfObject(const SyntheticTrial& trial) {
  return "cylinder_" + std::to_string(static_cast<int>(std::lround(1e3 * trial.diameter))) + "mm";
}

std::string FormatTrials(const std::vector<SyntheticTrial>& trials) {
  const std::vector<CsvColumn<SyntheticTrial>> columns = {
      {"participant", "", "", &SyntheticTrial::person},
      {"trial", "", "", &SyntheticTrial::trial},
      {"file", "", "",
       [](const auto& trial) {
         return "recordings/" + SyntheticFileName(trial, SyntheticFormat::kC3d);
       }},
      {"object", "", "", NameOfObject},
      {"diameter_m", "m", "", &SyntheticTrial::diameter},
  };
  return FormatCsv(columns, trials);
}

std::string FormatObjects(const std::vector<SyntheticTrial>& trials) {
  std::vector<SyntheticTrial> firsts;  // one of each size, without its recording
  for (const SyntheticTrial& trial : trials) {
    const bool is_known = std::any_of(firsts.begin(), firsts.end(), [&](const auto& first) {
      return first.diameter == trial.diameter;
    });
    if (is_known) continue;
    firsts.emplace_back();
    firsts.back().diameter = trial.diameter;
  }
  std::sort(firsts.begin(), firsts.end(),
            [](const auto& a, const auto& b) { return a.diameter < b.diameter; });
  // From the middle of the markers to the centre of the solid.
  const auto centre = [](const SyntheticTrial& trial, int axis) {
    double sum = 0.0;
    const std::vector<Eigen::Vector3d> places = SyntheticMarkerPlaces(trial.diameter);
    for (const Eigen::Vector3d& p_OM : places) sum += p_OM[axis];
    return std::round(-1e6 * sum / static_cast<double>(places.size())) / 1e6;
  };
  std::vector<CsvColumn<SyntheticTrial>> columns = {
      {"object", "", "", NameOfObject},
      {"shape", "", "", [](const auto&) { return "cylinder"; }},
      {"length_m", "m", "", &SyntheticTrial::diameter},
      {"height_m", "m", "", [](const auto&) { return kSyntheticObjectHeight; }},
  };
  const char* const names[] = {"centre_x_m", "centre_y_m", "centre_z_m"};
  for (int axis = 0; axis < 3; ++axis) {
    columns.push_back(
        {names[axis], "m", "", [=](const auto& trial) { return centre(trial, axis); }});
  }
  return FormatCsv(columns, firsts);
}

}  // namespace

SyntheticOptions MakeDemoOptions() {
  SyntheticOptions options;
  options.seed = "demo";
  options.num_people = 6;
  options.trials_per_size = 5;
  options.dropouts_per_second = 0.2;
  return options;
}

void WriteDemoStudy(const std::vector<SyntheticTrial>& trials,
                    const std::filesystem::path& folder) {
  MakeFolder(folder / "recordings");
  SaveSyntheticStudy(trials, SyntheticFormat::kC3d, folder / "recordings");
  WriteFileAtomically(folder / "study.yaml", kStudyYaml);
  WriteFileAtomically(folder / "trials.csv", FormatTrials(trials));
  WriteFileAtomically(folder / "objects.csv", FormatObjects(trials));
  WriteFileAtomically(folder / "hypotheses.csv", kHypotheses);
}

TruthComparison CompareWithTruth(const StudyResult& result,
                                 const std::vector<SyntheticTrial>& trials) {
  GRASPBENCH_DEMAND(result.trials.size() == trials.size(), std::to_string(trials.size()));
  TruthComparison comparison;
  std::vector<double> onset, contact, gft, closure_start;
  for (size_t i = 0; i < trials.size(); ++i) {
    ++comparison.num_trials;
    const StudyTrial& found = result.trials[i];
    if (!found.IsKept()) continue;
    ++comparison.num_kept;
    const SyntheticTruth& truth = trials[i].truth;
    onset.push_back(found.analysis->movement.onset.time - truth.onset);
    closure_start.push_back(found.analysis->closure_start.time - truth.peak_opening);
    for (size_t digit = 0; digit < truth.contacts.size(); ++digit) {
      contact.push_back(found.analysis->contacts[digit].contact.time - truth.contacts[digit]);
    }
    const auto [first, last] = std::minmax_element(truth.contacts.begin(), truth.contacts.end());
    gft.push_back(found.analysis->timing.gft - (*last - *first));
  }
  comparison.onset = CalcSummary(onset);
  comparison.contact = CalcSummary(contact);
  comparison.gft = CalcSummary(gft);
  comparison.closure_start = CalcSummary(closure_start);
  return comparison;
}

}  // namespace graspbench
