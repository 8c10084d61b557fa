#include "reports/scenes/filmstrip.h"

#include "core/base/text/text.h"

namespace graspbench {
namespace {

/** A trial that failed may end long before the hold. */
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

}  // namespace graspbench
