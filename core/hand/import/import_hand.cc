#include "core/hand/import/import_hand.h"

#include <algorithm>

#include "core/hand/import/checks/find_implausible.h"
#include "core/hand/import/checks/joint_limits.h"
#include "core/hand/import/foreign_hand.h"
#include "core/hand/import/guess_hand.h"
#include "core/hand/import/link_contact.h"
#include "core/hand/import/read_foreign_urdf.h"
#include "core/hand/import/select_hand.h"
#include "core/hand/import/write_hand.h"

namespace graspbench {
namespace {

void Add(const Diagnostic& entry, Diagnostics& problems) {
  entry.severity == Severity::kError ? problems.Fail(entry.file, entry.line, entry.text)
                                     : problems.Warn(entry.file, entry.line, entry.text);
}

/** Reports the reader's problems, except those of links and joints that are left out. */
void TellOfKept(const Diagnostics& told, const ForeignHand& whole, const ForeignHand& kept,
                Diagnostics& problems) {
  std::set<size_t> of_whole, of_kept;
  for (const auto& [hand, entries] : {std::pair{&whole, &of_whole}, std::pair{&kept, &of_kept}}) {
    for (const ForeignLink& link : hand->links) entries->insert(link.told.begin(), link.told.end());
    for (const ForeignJoint& joint : hand->joints)
      entries->insert(joint.told.begin(), joint.told.end());
  }
  for (size_t k = 0; k < told.entries().size(); ++k) {
    if (of_whole.count(k) > of_kept.count(k)) continue;
    Add(told.entries()[k], problems);
  }
}

ImportedFiles ImportInOrder(const std::string& text, const HandSource& source,
                            const std::string& palm, Diagnostics& problems) {
  const auto has_failed = [&] { return problems.num_errors() > 0; };
  Diagnostics told;
  ForeignHand foreign =
      IsMjcf(text) ? ReadForeignMjcf(text, source.file, source.folder, told, source.in_degrees)
                   : ReadForeignUrdf(text, source.file, told, source.in_degrees);
  // Parts that a named palm leaves out may be invalid.
  const ForeignHand whole = foreign;
  const bool is_selected_first = !palm.empty() && !whole.links.empty();
  if (!is_selected_first) TellOfKept(told, whole, whole, problems);
  if (has_failed()) return {};
  SetLengthUnit(source.unit, source.file, problems, foreign);
  if (has_failed()) return {};
  ShapeLoader loader(source, problems);
  const auto lacks_mesh = [&](const ForeignLink& link) { return loader.LacksMesh(link); };
  const int palm_link = SelectHand(palm, lacks_mesh, source.file, problems, foreign);
  if (is_selected_first) TellOfKept(told, whole, palm_link < 0 ? whole : foreign, problems);
  if (has_failed()) return {};
  FindDecoration(source.file, problems, foreign);
  if (!loader.CheckMeshes(foreign)) return {};
  loader.InferMeshUnit(foreign);
  std::vector<LoadedShapes> shapes;
  for (size_t i = 0; i < foreign.links.size(); ++i) {
    ForeignLink& link = foreign.links[i];
    shapes.push_back(loader.Load(link, static_cast<int>(i) == palm_link));
    loader.Weigh(link);
    RaiseToBounds(foreign, link);
  }
  std::set<std::filesystem::path> read = loader.ListFiles();
  read.insert(foreign.included.begin(), foreign.included.end());
  if (has_failed()) return {};
  ImportedHand imported = WeldLinks(foreign, palm_link, shapes, source.file, problems);
  if (has_failed()) return {};
  imported.hand.name = foreign.name;
  GuessHand(source.file, source.palm_normal, imported, problems);
  if (has_failed()) return {};
  FindImplausible(source.file, imported, problems);
  if (has_failed()) return {};
  const bool is_covered = source.num_cover_points > 0;
  const LinkSolids solids = is_covered ? MakeLinkSolids(imported.solids) : LinkSolids();
  if (is_covered) CoverLinks(solids, source.num_cover_points, imported);
  FreeJoints(source.file, imported, problems);
  if (is_covered) {
    MeasureLinks(source.file, source.accepts_coarse_contact, solids, imported, problems);
  }

  ImportedFiles result;
  const Hand& hand = imported.hand;
  result.num_digits = static_cast<int>(hand.digits.size());
  result.num_joints = hand.num_joints();
  result.num_driven =
      static_cast<int>(std::count_if(hand.joints.begin(), hand.joints.end(),
                                     [](const HandJoint& joint) { return joint.coupled_to < 0; }));
  const std::string name = std::filesystem::path(source.file).filename().string();
  result.fits = imported.fits;
  result.files = FormatHandFiles(imported, name, problems);
  result.files["import.json"] =
      FormatImportRecord(text, read, source, palm, imported, problems, result.files);
  return result;
}

}  // namespace

ImportedFiles ImportHand(const std::string& text, const HandSource& source, const std::string& palm,
                         Diagnostics& problems) {
  Diagnostics found;
  ImportedFiles files = ImportInOrder(text, source, palm, found);
  std::vector<Diagnostic> entries = found.entries();
  std::stable_sort(entries.begin(), entries.end(),
                   [](const Diagnostic& a, const Diagnostic& b) { return a.line < b.line; });
  for (const Diagnostic& entry : entries) Add(entry, problems);
  return files;
}

}  // namespace graspbench
