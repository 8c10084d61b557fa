#include "core/base/config.h"
#include "core/base/text/text.h"
#include "core/base/units.h"
#include "core/base/version.h"
#include "reports/kind_pages.h"
#include "reports/page/layout.h"
#include "reports/scenes/scene_3d.h"

namespace graspbench {
namespace {

struct DrawnGrasp {
  const GraspPageData& data;
  Html course;
};

/** Converts a free-space run to a traced trial: its stages become the closure and a push the
hold. */
TracedTrial MakeTraced(const TracedFreeSpace& traced) {
  TracedTrial shown;
  shown.result.outcome = traced.result.passed         ? Outcome::kSuccess
                         : traced.result.is_numerical ? Outcome::kNumericalFailure
                                                      : Outcome::kDroppedWhileHolding;
  shown.result.reason = traced.result.reason;
  shown.trace = traced.trace;
  shown.closure_start = 0.0;
  for (size_t i = 1; i < shown.trace.size(); ++i) {
    if (shown.trace[i].phase == shown.trace[i - 1].phase) continue;
    shown.result.phases.push_back({NameOf(shown.trace[i].phase), shown.trace[i - 1].time});
  }
  return shown;
}

Html DrawVerdict(const DrawnGrasp& drawn) {
  const FreeSpaceResult& result = drawn.data.traced.result;
  return Element("p", {{"class", "verdict"}},
                 "Under " + drawn.data.profile.name + " the grasp " +
                     (result.passed ? "passes."
                                    : "fails at: " + result.failed_stage + ". " +
                                          Capitalise(result.reason) + ".")) +
         MakeParagraph(Capitalise(drawn.data.profile.about) + ".");
}

Html DrawCourse(const DrawnGrasp& drawn) {
  return MakeParagraph(std::string("Closure: the stages of the grasp and further closing. ") +
                       (drawn.data.profile.test == "lift"
                            ? "Lift-off: the lift."
                            : "Hold: the decisive push, or the push that moved the object most.")) +
         drawn.course;
}

Html DrawMeasures(const DrawnGrasp& drawn) {
  const FreeSpaceResult& result = drawn.data.traced.result;
  Table table("What was found.", {"Measure", "Value"});
  const auto add = [&table](const char* name, const std::string& value) {
    table.AddRow({name, value.empty() ? "-" : value});
  };
  add("Initial penetration of the object [mm]", FormatFixed(MmFromM(result.start_penetration), 2));
  add("Self-penetration of the hand at the second stage [mm]",
      FormatFixed(MmFromM(result.self_penetration), 2));
  add("Joints commanded beyond their limits", std::to_string(result.num_beyond_limits));
  add("Touching after the last stage", result.touching);
  add("Total grip after the last stage [N]", FormatFixed(result.grip_force, 2));
  add("Epsilon then, ferrari-canny", FormatFixed(result.epsilon, 4));
  add("Object moved by closing [mm]", FormatFixed(MmFromM(result.closing_shift), 1));
  add("Object turned by closing [deg]", FormatFixed(result.closing_turn_deg, 1));
  add("Pushes or lifts resisted", std::to_string(result.num_stood));
  add("Largest displacement of the object [mm]", FormatFixed(MmFromM(result.worst_shift), 1));
  add("Largest rotation of the object [deg]", FormatFixed(result.worst_turn_deg, 1));
  if (drawn.data.profile.finds_breaking_load) {
    add("Largest push resisted along all axes [N]", FormatFixed(result.breaking_load, 2));
    add("Weakest axis", result.breaks_along);
  }
  return table.ToHtml();
}

Html DrawProfile(const DrawnGrasp& drawn) {
  return MakeConfigTable("Values of " + drawn.data.profile.name + ".",
                         ConfigToJson(drawn.data.profile));
}

Html DrawAssumptions(const DrawnGrasp& drawn) {
  return drawn.data.assumptions.empty() ? MakeParagraph("The file states everything needed.")
                                        : MakeList(drawn.data.assumptions);
}

Html DrawMethods(const DrawnGrasp& drawn) {
  return MakeMethodsText({"A grasp of " + drawn.data.object_name + " was judged with graspbench " +
                          std::string(program_version()) + " on the " + drawn.data.hand->name +
                          " under the profile " + drawn.data.profile.name +
                          ". The hand started around the object at the first stage and passed "
                          "through the other stages. Then the object was pushed or lifted "
                          "according to the profile. The verdict holds for this profile only."});
}

}  // namespace

std::string MakeGraspPage(const GraspPageData& data) {
  TrialViews views;
  DrawnGrasp drawn = {data, {}};
  const std::string scene = data.hand->name + ", " + data.object_name;
  drawn.course = views.Add({data.hand, data.object, MakeTraced(data.traced), "view", scene});
  drawn.course += views.MakeModels();
  static const std::vector<PageSection<DrawnGrasp>> sections = {
      {"verdict", "Verdict", &DrawVerdict},
      {"course", "Course", &DrawCourse},
      {"measures", "Measures", &DrawMeasures},
      {"profile", "Profile", &DrawProfile},
      {"assumed", "Taken for granted", &DrawAssumptions},
      {"methods", "Methods", &DrawMethods}};
  PageFrame frame = {"Grasp " + data.name, scene};
  frame.commands = data.commands;
  return AddScript(MakeSectionedPage(frame, sections, drawn), views.MakeScript());
}

}  // namespace graspbench
