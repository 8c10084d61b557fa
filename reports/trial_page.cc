#include "reports/trial_page.h"

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/base/units.h"
#include "reports/cell_pictures.h"
#include "reports/contact_strip.h"
#include "reports/filmstrip.h"
#include "reports/layout.h"
#include "reports/models.h"
#include "reports/scene_3d.h"
#include "reports/sectioned_page.h"

namespace graspbench {
namespace {

struct DrawnTrial : TrialPageData {
  Html course;
};

std::string NameOfScene(const TrialPageData& data) {
  return data.hand->name + ", " + data.object->name + ", " + NameOfGrasp(data.record.plan.grasp);
}

Html DrawResult(const DrawnTrial& data) {
  const TrialResult& result = data.record.result;
  const std::string reason = result.reason.empty() ? "." : ": " + result.reason + ".";
  Table table("Measures of the trial.", {{"Measure"}, {"Value", Align::kNumber}});
  const auto add = [&table](const char* name, double value, int decimals) {
    table.AddRow({Text(name), Text(FormatFixed(value, decimals))});
  };
  add("GCT [ms]", MsFromS(result.timing.gct), 1);
  add("GFT [ms]", MsFromS(result.timing.gft), 1);
  add("GOT [ms]", MsFromS(result.timing.got), 1);
  add("GFT% [%]", 100.0 * result.timing.gft_ratio, 1);
  add("GOT% [%]", 100.0 * result.timing.got_ratio, 1);
  add("Stability sigma [N]", result.stability.sigma, 2);
  add("Grip before lift-off [N]", result.grip_force, 2);
  add("Lift [mm]", MmFromM(result.lift_height), 1);
  add("Slip while held [mm]", MmFromM(result.hold_slip), 2);
  add("Deepest penetration [mm]", MmFromM(result.worst_penetration), 2);
  return MakeParagraph("Outcome: " + std::string(NameOf(result.outcome)) + reason) + table.ToHtml();
}

Html DrawPictures(const DrawnTrial& data) {
  if (data.record.result.snapshots.empty()) {
    return Element("p", {{"class", "missing"}}, "The trial ended before its first picture.");
  }
  try {
    Renderer renderer(kPictureWidth, kPictureHeight);
    return DrawFilmstrip(
        RenderSnapshots(data.record.result.snapshots, data.hand, data.object, renderer),
        data.record.result, NameOfScene(data));
  } catch (const Error& fault) {
    return MakeNote("warning", "No pictures", MakeParagraph(fault.what()));
  }
}

Html DrawContacts(const DrawnTrial& data) {
  SessionModels models;
  models.hands[data.hand->id] = data.hand;
  models.objects[data.object->id] = data.object;
  const Html strip = DrawContactStrip(data.record, NameOfScene(data), models);
  return strip.empty() ? Element("p", {{"class", "missing"}}, "Nothing touched the object.")
                       : strip;
}

Html DrawCourse(const DrawnTrial& data) {
  if (!data.course.empty()) return data.course;
  return MakeParagraph(
      "Not shown: the trial was changed on its way, so it cannot be carried out again.");
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
  return MakeParagraph("These lines, given to graspbench shell, lead here again.") +
         MakeScroll("Script", Element("pre", {}, text));
}

}  // namespace

std::string MakeTrialPage(const TrialPageData& data) {
  TrialViews views;
  DrawnTrial drawn = {data, {}};
  if (data.traced) {
    drawn.course = views.Add({data.hand, data.object, *data.traced, "view", NameOfScene(data)});
    drawn.course += views.MakeModels();
  }
  static const std::vector<PageSection<DrawnTrial>> sections = {
      {"result", "Result", &DrawResult},         {"pictures", "Pictures", &DrawPictures},
      {"course", "Course", &DrawCourse},         {"contacts", "Contacts", &DrawContacts},
      {"state", "State at the end", &DrawCards}, {"script", "How to get here", &DrawScript}};
  return AddScript(MakeSectionedPage("One trial", NameOfScene(data), sections, drawn),
                   views.MakeScript());
}

}  // namespace graspbench
