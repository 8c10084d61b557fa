#include "core/hand/import/fenced_import.h"

#include <utility>

#include "core/base/files/files.h"
#include "core/fence/fence.h"

namespace graspbench {
namespace {

struct ImportOutcome {
  ImportedFiles imported;
  Diagnostics problems;
};

}  // namespace

template <class Values>
void CrossMembers(Values& values, HandSource& source) {
  Cross(values, source.file, source.folder, source.package_path, source.palm_normal, source.unit,
        source.mesh_unit, source.accepts_coarse_contact, source.in_degrees,
        source.num_cover_points);
}

template <class Values>
void CrossMembers(Values& values, ContactError& error) {
  Cross(values, error.at_95, error.most);
}

template <class Values>
void CrossMembers(Values& values, ContactFit& fit) {
  Cross(values, fit.link, fit.num_balls, fit.out, fit.sink, fit.palmar_out, fit.palmar_sink,
        fit.num_capsules, fit.self_contact);
}

template <class Values>
void CrossMembers(Values& values, ImportedFiles& imported) {
  Cross(values, imported.files, imported.num_digits, imported.num_joints, imported.num_driven,
        imported.fits);
}

template <class Values>
void CrossMembers(Values& values, ImportOutcome& outcome) {
  Cross(values, outcome.imported, outcome.problems);
}

ImportedFiles ImportHandFile(const HandSource& source, const std::string& palm,
                             Diagnostics& problems) {
  ImportOutcome outcome =
      Fence::Shared().Read<ImportOutcome>("hand", FencedFile(std::filesystem::path(source.file)),
                                          nullptr, kHandImportSeconds, source, palm);
  for (const Diagnostic& entry : outcome.problems.entries()) {
    entry.severity == Severity::kError ? problems.Fail(entry.file, entry.line, entry.text)
                                       : problems.Warn(entry.file, entry.line, entry.text);
  }
  return std::move(outcome.imported);
}

FencedReader MakeHandReader(MeshLoader load_mesh) {
  return {"hand", [load_mesh = std::move(load_mesh)](
                      const FencedInput& input, IncomingValues& arguments, OutgoingValues& answer) {
            HandSource source;
            std::string palm;
            Cross(arguments, source, palm);
            source.load_mesh = load_mesh;
            ImportOutcome outcome;
            outcome.imported = ImportHand(ReadFile(input.path()), source, palm, outcome.problems);
            Cross(answer, outcome);
          }};
}

}  // namespace graspbench
