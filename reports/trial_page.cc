#include "reports/trial_page.h"

#include <algorithm>

#include "core/arm/mounted_arm.h"
#include "core/base/error.h"
#include "core/base/text/text.h"
#include "core/base/units.h"
#include "core/base/version.h"
#include "core/hand/tactile.h"
#include "core/render/hand_scene.h"
#include "core/trial/measures/diagnosis_text.h"
#include "core/trial/taxel_forces.h"
#include "objects/catalogue.h"
#include "reports/page/layout.h"
#include "reports/page/models.h"
#include "reports/plots/trial_plots.h"
#include "reports/scenes/cell_pictures.h"
#include "reports/scenes/scene_3d.h"
#include "reports/scenes/sight_picture.h"

namespace graspbench {
namespace {

struct DrawnTrial : TrialPageData {
  Html course;
};

/** Of the grasp that was done. */
std::string NameOfDone(const TrialRecord& record) {
  const std::optional<std::string>& seen = record.result.sight_grasp;
  if (!seen || *seen == kNotSeenGrasp) return NameOfGrasp(record.plan.grasp);
  return NameOfGrasp(*seen) + " by sight";
}

std::string NameOfScene(const TrialPageData& data) {
  const std::string carrier = data.setup.arm ? " on the " + data.setup.arm->arm->name : "";
  return data.setup.hand->name + carrier + ", " + data.setup.object->name + ", " +
         NameOfDone(data.record);
}

Html DrawController(const DrawnTrial& data) {
  if (!data.record.result.policy) return Html();
  const PolicyRecord& policy = *data.record.result.policy;
  const std::string hand =
      policy.num_hand_cut ? ", " + FormatCount(*policy.num_hand_cut, "pose") + " of the hand" : "";
  return MakeParagraph("A controller moved " + data.setup.policy.moves +
                       "; object pose given: " + policy.object_pose +
                       ". Number of questions: " + FormatCount(policy.num_questions, "time") +
                       "; clipped to limits: " + FormatCount(policy.num_cut, "target") + hand +
                       ".");
}

/** What presses on the tactile elements before the lift, else at the end. */
Html DrawTaxels(const DrawnTrial& data) {
  const Hand& hand = *data.setup.hand;
  if (!data.traced || data.traced->trace.empty() || !hand.skin || hand.skin->elements.empty()) {
    return Html();
  }
  const std::vector<const TraceInstant*> ends = ListPhaseEnds(data.traced->trace);
  const auto closed = std::find_if(ends.begin(), ends.end(), [](const TraceInstant* instant) {
    return instant->phase == Phase::kStabilisation;
  });
  const TraceInstant& instant = closed == ends.end() ? *ends.back() : **closed;
  const std::vector<double> forces =
      CalcTaxelForces(hand, data.setup.sensors, instant.X_WH, instant.q, instant.contacts);
  const std::string most = FormatFixed(*std::max_element(forces.begin(), forces.end()), 2);
  PlotText text;
  text.title = closed == ends.end() ? "Force on each tactile element at the end"
                                    : "Force on each tactile element before the lift";
  text.description = "At most " + most + " N.";
  return MakeFigure(text.title + ".",
                    "the darkest element has " + most +
                        " N, an empty one nothing; seen from the palm's side, the hand stretched.",
                    MakeScroll(text.title, DrawHandMap(hand, forces, text)));
}

/** What would have held, and each remedy that was tried. */
Html DrawRemedies(const DrawnTrial& data) {
  if (!data.explanation) return Html();
  Table table("Remedies, each tested by repeating the trial.",
              {"Remedy", "This draw", "Fresh draws", "Mended", "Broken"});
  for (const RemedyResult& remedy : data.explanation->remedies) {
    const bool is_tried = remedy.num_draws > 0;
    table.AddRow({NameRemedy(remedy.id), remedy.holds ? "holds" : "fails",
                  is_tried ? std::to_string(remedy.num_draws) : "only explains",
                  is_tried ? std::to_string(remedy.num_mended) : "-",
                  is_tried ? std::to_string(remedy.num_broken) : "-"});
  }
  return MakeParagraph(DescribeExplanation(*data.explanation)) + table.ToHtml();
}

Html DrawResult(const DrawnTrial& data) {
  const TrialResult& result = data.record.result;
  const std::string reason = result.reason.empty() ? "." : ": " + result.reason + ".";
  const Html diagnosis =
      result.diagnosis ? Element("p", {{"class", "verdict"}}, DescribeDiagnosis(result)) : Html();
  const Seat seat = FindSeat(result);
  return MakeParagraph("Outcome: " + WordsOf(result.outcome) + reason +
                       (seat == Seat::kUnknown ? "" : " Seat: " + WordsOf(seat) + ".") +
                       (IsCaged(result) ? " The object is caged." : "") +
                       (result.opposition ? std::string(" Opposition: ") +
                                                RowOf(kOppositions, *result.opposition).name + "."
                                          : "")) +
         diagnosis + DrawRemedies(data) + DrawController(data);
}

Html DrawMeasures(const DrawnTrial& data) {
  const TrialResult& result = data.record.result;
  Table table("Measures of the trial.", {"Measure", "Value"});
  const auto add = [&table](const char* name, double value, int decimals) {
    table.AddRow({name, FormatFixed(value, decimals)});
  };
  const std::string remark =
      result.timing.contact_before_start ? std::string(", ") + kNotComparable : "";
  const auto add_time = [&](const std::string& name, double value) {
    table.AddRow({name + remark, FormatFixed(value, 1)});
  };
  add_time("GCT [ms]", MsFromS(result.timing.gct));
  add_time("GFT [ms]", MsFromS(result.timing.gft));
  add_time("GOT [ms]", MsFromS(result.timing.got));
  add_time("GFT% [%]", 100.0 * result.timing.gft_ratio);
  add_time("GOT% [%]", 100.0 * result.timing.got_ratio);
  add("Stability sigma [N]", result.stability.sigma, 2);
  add("Grip before lift-off [N]", result.grip_force, 2);
  add("In-grasp rise before lift-off [mm]", MmFromM(result.closure_rise), 1);
  add("Lift [mm]", MmFromM(result.lift_height), 1);
  add("Slip while held [mm]", MmFromM(result.hold_slip), 2);
  add("Deepest penetration [mm]", MmFromM(result.worst_penetration), 2);
  if (!result.arm) return table.ToHtml();
  const ArmRecord& arm = *result.arm;
  table.AddRow(
      {"Arm: joint nearest its limit, or limiting the path", arm.joint.empty() ? "-" : arm.joint});
  add("Arm: its margin to the limit [deg]", DegFromRad(arm.margin), 1);
  add("Arm: largest joint speed over its limit [%]", 100.0 * arm.speed_share, 0);
  add("Arm: time to the pre-grasp pose [s]", arm.reach_time, 2);
  add("Arm: path of the hand to it [mm]", MmFromM(arm.reach_path), 0);
  add("Arm: largest deflection of the hand [mm]", MmFromM(arm.deflection), 2);
  add("Arm: largest turn of the hand by it [deg]", DegFromRad(arm.deflection_angle), 2);
  add("Arm: largest joint torque over its limit [%]", 100.0 * arm.torque_share, 0);
  table.AddRow({"Arm: joint with that torque", arm.torque_joint.empty() ? "-" : arm.torque_joint});
  return table.ToHtml();
}

Html DrawPictures(const DrawnTrial& data) {
  if (data.record.result.snapshots.empty()) {
    return Element("p", {{"class", "missing"}}, "The trial ended before its first picture.");
  }
  try {
    Renderer renderer(kPictureWidth, kPictureHeight);
    return DrawFilmstrip(
        RenderSnapshots(data.record.result.snapshots, data.setup.hand, data.setup.object, renderer),
        data.record.result, NameOfScene(data));
  } catch (const Error& fault) {
    return MakeNote("warning", "No pictures", MakeParagraph(fault.what()));
  }
}

Html DrawContacts(const DrawnTrial& data) {
  SessionModels models;
  models.hands[data.setup.hand->id] = data.setup.hand;
  models.objects[data.setup.object->id] = data.setup.object;
  const Html strip = DrawContactStrip(data.record, NameOfScene(data), models);
  return (strip.empty() ? Element("p", {{"class", "missing"}}, "Nothing touched the object.")
                        : strip) +
         DrawTaxels(data);
}

/** Arm, hand and object whole, from the side: at the start and before the lift; nothing without. */
Html DrawWholeArm(const DrawnTrial& data) {
  if (!data.traced || !data.traced->arm || data.traced->trace.empty()) return Html();
  const MountedArm& arm = *data.traced->arm;
  const std::vector<const TraceInstant*> ends = ListPhaseEnds(data.traced->trace);
  const auto closed = std::find_if(ends.begin(), ends.end(), [](const TraceInstant* end) {
    return end->phase == Phase::kStabilisation;
  });
  const TraceInstant* shown[] = {&data.traced->trace.front(),
                                 closed == ends.end() ? ends.back() : *closed};
  std::vector<Scene> scenes;
  for (const TraceInstant* instant : shown) {
    scenes.push_back(MakeGraspScene(data.setup.hand, instant->q, instant->X_WH, data.setup.object,
                                    instant->X_WO));
    AddArm(&arm, instant->q_arm, true, &scenes.back());
  }
  Html pictures;
  try {
    Renderer renderer(kPictureWidth, kPictureHeight);
    const Camera camera = FrameScenes(scenes, FindArmView(arm, shown[1]->X_WH),
                                      static_cast<double>(kPictureWidth) / kPictureHeight);
    for (size_t i = 0; i < scenes.size(); ++i) {
      const std::string caption =
          Capitalise(NameOf(shown[i]->phase)) + ", " + FormatFixed(shown[i]->time, 3) + " s";
      const std::string webp = EncodeWebp(renderer.Render(scenes[i], camera));
      pictures += Element("figure", {},
                          Element("img", {{"src", MakeDataUri("image/webp", webp)},
                                          {"width", std::to_string(kPictureWidth)},
                                          {"height", std::to_string(kPictureHeight)},
                                          {"alt", NameOfScene(data) + ": arm, " + caption}}) +
                              Element("figcaption", {}, caption));
    }
  } catch (const Error& fault) {
    if (fault.kind() != ErrorKind::kEnvironment) throw;
    return Html();  // the page's other pictures say why
  }
  return MakeFigure(
      "The arm " + DescribeArmPlace(arm) + ", when the trial starts and before the lift.",
      "links that stand clear of table and object.", Element("div", {{"class", "film"}}, pictures));
}

Html DrawCourse(const DrawnTrial& data) {
  if (!data.course.empty()) return data.course + DrawWholeArm(data);
  return DrawPictures(data) +
         MakeParagraph("No 3-D scene: the trial was changed while it ran and cannot be repeated.");
}

Html DrawCards(const DrawnTrial& data) {
  Html html;
  for (const auto& [heading, text] : data.cards) {
    html += Element("h3", {}, heading) + MakeScroll(heading, Element("pre", {}, text));
  }
  return html;
}

Html DrawScript(const DrawnTrial& data) {
  std::string text;
  for (const std::string& line : data.script) text += line + "\n";
  return MakeParagraph("Enter these lines in graspbench shell.") +
         MakeScroll("Script", Element("pre", {}, text));
}

Html DrawFindings(const DrawnTrial& data) {
  const TrialResult& result = data.record.result;
  std::vector<std::string> findings = data.warnings;
  if (result.num_unconverged > 0) {
    findings.push_back("In " + std::to_string(result.num_unconverged) + " of " +
                       FormatCount(result.num_steps, "step") + " the solver missed its tolerance.");
  }
  if (result.outcome == Outcome::kNumericalFailure || result.outcome == Outcome::kNotPhysical) {
    findings.push_back("The simulation failed; no value of this trial is valid.");
  }
  const bool is_early = std::any_of(result.contacts.begin(), result.contacts.end(),
                                    [](const DigitContact& contact) { return contact.time < 0.0; });
  if (is_early) {
    findings.push_back(
        "A digit touched before closure began (early contact); the times are not comparable.");
  }
  return findings.empty() ? MakeParagraph("No errors and no warnings.") : MakeList(findings);
}

std::string DescribeMethod(const TrialSetup& setup, const TrialRecord& record) {
  const TrialDraw& draw = setup.draw;
  return "The " + setup.hand->name + " grasped one object (" + setup.object->name + ", " +
         FormatFixed(GFromKg(setup.object->mass_properties.mass), 1) + " g, " +
         (setup.object->compressible ? "compressed to " + DescribeCompression(*setup.object) + ", "
                                     : "") +
         "friction " + FormatFixed(setup.object->surface.friction_static, 2) + " static and " +
         FormatFixed(setup.object->surface.friction_dynamic, 2) + " dynamic) by the grasp " +
         NameOfDone(record) + " in a physical simulation. The object was " +
         FormatFixed(MmFromM(draw.offset_x), 1) + " mm and " +
         FormatFixed(MmFromM(draw.offset_y), 1) +
         " mm off its nominal position along the two horizontal axes and turned by " +
         FormatFixed(DegFromRad(draw.offset_yaw), 1) +
         " degrees about the vertical; every drive had a random error within its joint accuracy. "
         "The trial ran the strategy pre-grasp, placing, closure, stabilisation and lift-off, "
         "closing from the pre-grasp to the target posture in " +
         FormatFixed(setup.strategy.closure_time, 2) + " s" +
         (setup.grasp.course.is_set() ? " after a recorded course of hand and digits of " +
                                            FormatFixed(setup.grasp.course.duration(), 2) + " s"
                                      : "") +
         ", and then a hold of " + FormatFixed(setup.strategy.hold_time, 2) + " s, in steps of " +
         FormatFixed(MsFromS(setup.sim.step), 2) + " ms (graspbench " +
         std::string(program_version()) + ")." +
         (setup.arm ? " The arm " + DescribeArmPlace(*setup.arm) +
                          " carried the hand; it started in its ready posture, and the hand "
                          "yielded as the arm's joints do."
                    : "") +
         " A trial succeeds if the object leaves the table with the hand and stays in it until "
         "the end of the hold.";
}

Html DrawMethods(const DrawnTrial& data) {
  return MakeMethodsText({DescribeMethod(data.setup, data.record)});
}

PageFrame MakeFrame(const TrialPageData& data) {
  const std::string& id = data.record.plan.id;
  PageFrame frame = {data.name.empty() ? "One trial" : "Trial " + data.name, NameOfScene(data)};
  if (!id.empty()) frame.facts = {{"Trial id", id}};
  frame.commands = data.commands;
  frame.references = {"roethling2007", "sherman2011", "ferrari1992"};
  return frame;
}

}  // namespace

std::string MakeTrialPage(const TrialPageData& data) {
  TrialViews views;
  DrawnTrial drawn = {data, {}};
  if (data.traced) {
    drawn.course =
        views.Add({data.setup.hand, data.setup.object, *data.traced, "view", NameOfScene(data)});
    drawn.course += views.MakeModels();
  }
  static const std::vector<PageSection<DrawnTrial>> sections = {
      {"result", "Result", &DrawResult},
      {"course", "Timeline", &DrawCourse},
      {"measures", "Measures", &DrawMeasures},
      {"contacts", "Contacts", &DrawContacts},
      {"state", "Summary", &DrawCards},
      {"script", "Reproduce in the shell", &DrawScript},
      {"findings", "Errors and warnings", &DrawFindings},
      {"methods", "Methods", &DrawMethods}};
  return AddScript(MakeSectionedPage(MakeFrame(data), sections, drawn), views.MakeScript());
}

}  // namespace graspbench
