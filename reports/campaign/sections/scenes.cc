#include <cmath>

#include "core/base/text/text.h"
#include "core/base/units.h"
#include "reports/campaign/campaign_section.h"
#include "reports/plots/trial_plots.h"
#include "reports/scenes/cell_pictures.h"

namespace graspbench {
namespace {

Html DrawPictures(const SceneVariants& scene, const CampaignData& data) {
  const auto found = data.pictures.by_scene.find(scene.key);
  if (found == data.pictures.by_scene.end()) {
    return Element("p", {{"class", "missing"}}, "No pictures of this scene.");
  }
  Html frames;
  for (int v = 0; v < kNumVariants; ++v) {
    const Picture& picture = found->second[v];
    const std::string name = WordsOf(static_cast<Variant>(v));
    const Html image =
        picture.webp.empty()
            ? Element("p", {{"class", "missing"}}, "no picture")
            : Element("img", {{"src", MakeDataUri("image/webp", picture.webp)},
                              {"width", std::to_string(kPictureWidth)},
                              {"height", std::to_string(kPictureHeight)},
                              {"alt", data.NameOfScene(scene) + ", closed: " + name}});
    frames += Element("figure", {}, image + Element("figcaption", {}, name));
  }
  return Element("div", {{"class", "film"}}, frames);
}

Html DrawThumb(const Json& step, const SceneVariants& scene, const CampaignData& data) {
  Table table("Target angles of the thumb, " + data.NameOfScene(scene) + ".",
              {"Joint", "Before [deg]", "Evolved [deg]", "Change [deg]", "Bounds [deg]"});
  const auto angle = [&](const char* key, size_t i) {
    return DegFromRad(step.at(key).at(i).get<double>());
  };
  for (size_t i = 0; i < step.at("joints").size(); ++i) {
    const double before = angle("start_rad", i), after = angle("found_rad", i);
    table.AddRow({step.at("joints").at(i).get<std::string>(), FormatFixed(before, 1),
                  FormatFixed(after, 1), FormatFixed(after - before, 1),
                  FormatRange(angle("lower_rad", i), angle("upper_rad", i), 1)});
  }
  return table.ToHtml();
}

/** Tabulates the coordinates of a search space other than the thumb's, in degrees or
millimetres. */
Html DrawCoordinates(const Json& step, const SceneVariants& scene, const CampaignData& data) {
  Table table("What step 2 searched (" + step.at("search").get<std::string>() + "), " +
                  data.NameOfScene(scene) + ".",
              {"Coordinate", "Unit", "Before", "Found", "Change", "Bounds"});
  for (const Json& coordinate : step.at("coordinates")) {
    const bool is_length = coordinate.at("unit") == "m";
    const auto value = [&](const char* key) {
      const double si = coordinate.at(key).get<double>();
      return is_length ? MmFromM(si) : DegFromRad(si);
    };
    const double before = value("start"), after = value("found");
    table.AddRow({coordinate.at("name").get<std::string>(), is_length ? "mm" : "deg",
                  FormatFixed(before, 1), FormatFixed(after, 1), FormatFixed(after - before, 1),
                  FormatRange(value("lower"), value("upper"), 1)});
  }
  return table.ToHtml();
}

/** Draws the contact strips of the pictured trials. */
Html DrawStrips(const SceneVariants& scene, const CampaignData& data) {
  const auto hand = data.models.FindHand(scene.hand);
  Html strips;
  for (int v = 0; hand && v < kNumVariants; ++v) {
    const CellSummary* cell = scene.cells[v];
    const TrialRecord* record = cell ? ChooseTrial(*cell, *hand, data.campaign.benchmark) : nullptr;
    if (record == nullptr) continue;
    strips += DrawContactStrip(
        *record, data.NameOfScene(scene) + ", " + WordsOf(static_cast<Variant>(v)), data.models);
  }
  return strips.empty() ? Html() : MakeDetails("Contacts of these trials", strips);
}

Html DrawScene(const SceneVariants& scene, const CampaignData& data) {
  Html content = Element("h3", {}, data.NameOfScene(scene) + ", " + NameOfGrasp(scene.grasp));
  const Json& result = scene.scene->result;
  if (result.is_null()) {
    content += MakeParagraph("Not finished.");
  } else {
    content += DrawPictures(scene, data) + DrawStrips(scene, data);
    if (const Json* const step = result.find("pregrasp_step")) {
      content += MakeParagraph("Step 1: " + step->at("verdict").get<std::string>());
    }
    if (const Json* const step = result.find("target_step")) {
      content += MakeParagraph("Step 2: " + step->at("verdict").get<std::string>());
      content += step->contains("joints") ? DrawThumb(*step, scene, data)
                                          : DrawCoordinates(*step, scene, data);
    }
  }
  return Element("section", {{"id", scene.key}, {"class", "cell"}}, content);
}

Html DrawScenes(const CampaignData& data) {
  if (data.scenes.empty()) return MakeParagraph("There is nothing to show.");
  Html html = MakeParagraph(
      "The closed hand in one benchmark trial of each variant (the first success, if any), from "
      "one camera; below, the decision of each step and its reason.");
  for (const SceneVariants& scene : data.scenes) html += DrawScene(scene, data);
  return html;
}

}  // namespace

CampaignSection scenes_campaign_section() {
  return {"scenes", "Pictures and decisions", DrawScenes};
}

}  // namespace graspbench
