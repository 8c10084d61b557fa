#include "reports/trial_page.h"

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/base/units.h"
#include "reports/cell_pictures.h"
#include "reports/contact_strip.h"
#include "reports/layout.h"
#include "reports/models.h"
#include "reports/sectioned_page.h"

namespace graspbench {
namespace {

std::string NameOfScene(const TrialPageData& data) {
  return data.hand->name + ", " + data.object->name + ", " + NameOfGrasp(data.record.plan.grasp);
}

Html DrawResult(const TrialPageData& data) {
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

Html DrawPictures(const TrialPageData& data) {
  if (data.record.result.snapshots.empty()) {
    return Element("p", {{"class", "missing"}}, "The trial ended before its first picture.");
  }
  try {
    Renderer renderer(kPictureWidth, kPictureHeight);
    Html frames;
    for (const Picture& picture :
         RenderSnapshots(data.record.result.snapshots, data.hand, data.object, renderer)) {
      const std::string name = Capitalise(NameOf(picture.moment));
      frames +=
          Element("figure", {},
                  Element("img", {{"src", MakeDataUri("image/webp", picture.webp)},
                                  {"width", std::to_string(kPictureWidth)},
                                  {"height", std::to_string(kPictureHeight)},
                                  {"alt", NameOfScene(data) + ": " + name}}) +
                      Element("figcaption", {}, name + ", " + FormatFixed(picture.time, 2) + " s"));
    }
    return Element("div", {{"class", "film"}}, frames);
  } catch (const Error& fault) {
    return MakeNote("warning", "No pictures", MakeParagraph(fault.what()));
  }
}

Html DrawContacts(const TrialPageData& data) {
  SessionModels models;
  models.hands[data.hand->id] = data.hand;
  models.objects[data.object->id] = data.object;
  const Html strip = DrawContactStrip(data.record, NameOfScene(data), models);
  return strip.empty() ? Element("p", {{"class", "missing"}}, "Nothing touched the object.")
                       : strip;
}

Html DrawCards(const TrialPageData& data) {
  Html html;
  for (const auto& [heading, text] : data.cards) {
    html += Element("h3", {}, heading) + MakeScroll(heading, Element("pre", {}, text));
  }
  return html;
}

Html DrawScript(const TrialPageData& data) {
  std::string text;
  for (const std::string& line : data.script) text += line + "\n";
  return MakeParagraph("These lines, given to graspbench shell, lead here again.") +
         MakeScroll("Script", Element("pre", {}, text));
}

}  // namespace

std::string MakeTrialPage(const TrialPageData& data) {
  static const std::vector<PageSection<TrialPageData>> sections = {
      {"result", "Result", &DrawResult},
      {"pictures", "Pictures", &DrawPictures},
      {"contacts", "Contacts", &DrawContacts},
      {"state", "State at the end", &DrawCards},
      {"script", "How to get here", &DrawScript}};
  return MakeSectionedPage("One trial", NameOfScene(data), sections, data);
}

}  // namespace graspbench
