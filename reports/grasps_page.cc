#include <algorithm>
#include <cmath>

#include "core/base/hash.h"
#include "core/base/text/text.h"
#include "core/base/units.h"
#include "core/base/version.h"
#include "reports/kind_pages.h"
#include "reports/page/layout.h"

namespace graspbench {
namespace {

constexpr size_t kMostFailures = 1000;  // rows on the page; grasps.csv has all of them

struct GraspsView {
  const Json& config;
  const std::vector<JudgedGrasp>& judged;
  const JudgedSummary& summary;
};

std::string FormatNumber(double value, int decimals) {
  return std::isfinite(value) ? FormatFixed(value, decimals) : "-";
}

std::string NameOf(const JudgedGrasp& judged) {
  return judged.source + ", grasp " + std::to_string(judged.index);
}

Html DrawSuccess(const GraspsView& view) {
  Table table(
      "Success under each profile.",
      {"Profile",
       "Grasps",
       "Passed",
       "Share",
       {"95 % interval [%]", "Wilson"},
       {"Gave up", "numerical failures, counted as failures"},
       {"Passes when moved",
        "for passing grasps: share of repetitions, with the root moved by 1 mm and turned by 1 "
        "degree, that also pass"}});
  for (const ProfileSummary& profile : view.summary.profiles) {
    table.AddRow({profile.profile, profile.num_judged, profile.num_passed,
                  FormatPercent(CalcShare(profile.num_passed, profile.num_judged)),
                  FormatRateInterval(profile.num_passed, profile.num_judged), profile.num_numerical,
                  std::isfinite(profile.jitter_share) ? FormatPercent(profile.jitter_share) : "-"});
  }
  return table.ToHtml();
}

Html DrawAgreement(const GraspsView& view) {
  Table table("Verdicts compared with the labels in the files.",
              {"Profile",
               "Labelled",
               "Both pass",
               "Label only",
               "Verdict only",
               "Both fail",
               {"Kappa", "1: full agreement; 0: chance level"}});
  bool has_any = false;
  for (const ProfileSummary& profile : view.summary.profiles) {
    const PairedCounts& counts = profile.labels;
    if (counts.num_pairs() == 0) continue;
    has_any = true;
    table.AddRow({profile.profile, counts.num_pairs(), counts.both, counts.first_only,
                  counts.second_only, counts.neither, FormatNumber(CalcKappa(counts), 2)});
  }
  return has_any ? table.ToHtml() : MakeParagraph("The files contain no labels.");
}

Html DrawTransitions(const GraspsView& view) {
  if (view.summary.transitions.empty()) return MakeParagraph("Only one profile was used.");
  Table table("Verdicts on the same grasps under pairs of profiles.",
              {"From", "To", "Pass both", "Lost", "Won", "Fail both"});
  for (const ProfileTransition& transition : view.summary.transitions) {
    const PairedCounts& counts = transition.counts;
    table.AddRow({transition.from, transition.to, counts.both, counts.first_only,
                  counts.second_only, counts.neither});
  }
  return table.ToHtml();
}

Html DrawGraspTable(const std::string& caption, const std::vector<const JudgedGrasp*>& grasps) {
  Table table(caption,
              {{"Grasp", "file and index in it"},
               "Profile",
               "Verdict",
               "Failed at",
               {"Moved [mm]", "maximum over all checks"},
               "Turned [deg]",
               "Initial penetration [mm]",
               {"Grip [N]", "after the last stage"},
               {"Breaking load [N]",
                "largest push resisted along all six axes; -: not sought, or no push was resisted"},
               "Touching",
               "Why"});
  for (const JudgedGrasp* judged : grasps) {
    const FreeSpaceResult& result = judged->result;
    table.AddRow(
        {NameOf(*judged), judged->profile, result.passed ? "pass" : "fail",
         result.failed_stage.empty() ? "-" : result.failed_stage,
         FormatNumber(MmFromM(result.worst_shift), 1), FormatNumber(result.worst_turn_deg, 1),
         FormatNumber(MmFromM(result.start_penetration), 1), FormatNumber(result.grip_force, 1),
         result.breaking_load > 0.0 ? FormatNumber(result.breaking_load, 2) : "-",
         result.touching.empty() ? "-" : result.touching, result.reason});
  }
  return table.ToHtml();
}

Html DrawFailures(const GraspsView& view) {
  Html stages;
  for (const ProfileSummary& profile : view.summary.profiles) {
    std::string text = profile.profile + ": ";
    for (size_t i = 0; i < profile.stages.size(); ++i) {
      text += (i > 0 ? ", " : "") + profile.stages[i].first + " " +
              std::to_string(profile.stages[i].second);
    }
    if (!profile.stages.empty()) stages += MakeParagraph(text + ".");
  }
  std::vector<const JudgedGrasp*> failures;
  for (const JudgedGrasp& judged : view.judged) {
    if (judged.jitter == 0 && !judged.result.passed && failures.size() < kMostFailures) {
      failures.push_back(&judged);
    }
  }
  if (failures.empty()) return MakeParagraph("None.");
  return stages + DrawGraspTable("Grasps that failed, at most " + std::to_string(kMostFailures) +
                                     "; grasps.csv lists all.",
                                 failures);
}

Html DrawNearest(const GraspsView& view) {
  if (view.summary.nearest.empty()) return MakeParagraph("No grasp was tested.");
  return MakeParagraph(
             "Grasps whose displacement or rotation is closest to the limit of the profile; "
             "another time step or friction may change their verdict.") +
         DrawGraspTable("Grasps nearest the limit between pass and fail.", view.summary.nearest);
}

Html DrawUnread(const GraspsView& view) {
  std::vector<std::string> items;
  for (const Json& file : view.config.value("unread", Json::array())) {
    items.push_back(file.value("name", "") + ": " + file.value("reason", ""));
  }
  return items.empty() ? MakeParagraph("All files were read and mapped.") : MakeList(items);
}

Html DrawProfiles(const GraspsView& view) {
  Html content;
  for (const Json& profile : view.config.value("profiles", Json::array())) {
    const std::string name = profile.value("name", "");
    content += MakeDetails(name + ": " + profile.at("values").value("about", ""),
                           MakeConfigTable("Values of " + name + ".", profile.at("values")));
  }
  return content;
}

Html DrawGraspsMethods(const GraspsView& view) {
  return MakeMethodsText(
      {"Grasps were judged with graspbench " + std::string(program_version()) + " on the hand " +
       view.config.value("hand", "") +
       ". The hand started around the object at the first stage of each grasp and passed through "
       "the other stages. Then the object was pushed along six directions or out of the palm, or "
       "lifted, according to the profile. A verdict holds for its profile only. Agreement is "
       "Cohen's kappa; intervals are Wilson's at 95 %."});
}

}  // namespace

std::string MakeGraspsPage(const Json& config, const std::vector<JudgedGrasp>& judged,
                           const JudgedSummary& summary) {
  static const std::vector<PageSection<GraspsView>> sections = {
      {"success", "Success", &DrawSuccess},
      {"agreement", "Agreement with the files", &DrawAgreement},
      {"transitions", "Comparison of profiles", &DrawTransitions},
      {"failed", "Failures", &DrawFailures},
      {"nearest", "Nearest the border", &DrawNearest},
      {"unread", "Not judged", &DrawUnread},
      {"profiles", "Profiles", &DrawProfiles},
      {"methods", "Methods", &DrawGraspsMethods}};
  std::string subtitle = FormatCount(summary.num_grasps, "grasp") + " under " +
                         FormatCount(static_cast<int>(summary.profiles.size()), "profile");
  const size_t num_unread = config.value("unread", Json::array()).size();
  if (num_unread > 0) subtitle += ", " + std::to_string(num_unread) + " not judged";
  PageFrame frame = {"External grasps", subtitle};
  frame.commands = {"graspbench grasps judge FILES --objects DIR --out ANOTHER"};
  frame.facts = {{"Hand", config.value("hand", "")},
                 {"Hash of the configuration", CalcHashHex(FormatJson(config))}};
  return MakeSectionedPage(frame, sections, GraspsView{config, judged, summary});
}

}  // namespace graspbench
