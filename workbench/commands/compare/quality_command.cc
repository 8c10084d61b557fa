#include <memory>

#include "core/base/files/files.h"
#include "core/base/text/text.h"
#include "core/quality/contacts_json.h"
#include "core/quality/grasp_quality.h"
#include "workbench/command.h"
#include "workbench/tables/text_table.h"

namespace graspbench {
namespace {

void ShowQuality(const std::string& path, bool json) {
  const GraspQuality quality = CalcGraspQuality(ParseQualityRequest(ReadFile(path), path));
  if (json) {
    PrintJson(ToJson(quality));
    return;
  }
  TextTable table({"direction", "1 N in total", "1 N at each contact"});
  for (const TaskForce& force : quality.task_forces) {
    table.AddRow({force.direction, FormatSignificant(force.sum_limited, 4),
                  FormatSignificant(force.each_limited, 4)});
  }
  PrintResult(quality.description + "\n\nforce closure          " +
              (quality.force_closure ? "yes" : "no") + "\nepsilon                " +
              FormatSignificant(quality.epsilon, 6) + "\nvolume                 " +
              FormatSignificant(quality.volume, 6) + "\nmin singular value     " +
              FormatSignificant(quality.min_singular_value, 6) +
              "\n\nLargest load along a direction per newton of normal force, in N or N m:\n" +
              table.Format());
}

std::string ListConventions() {
  std::string names;
  for (const QualityConvention& convention : ListQualityConventions()) {
    names += (names.empty() ? "" : ", ") + convention.id;
  }
  return names;
}

}  // namespace

void AddQualityCommand(Command& program) {
  const auto path = std::make_shared<std::string>();
  const auto json = std::make_shared<bool>(false);
  Command& command =
      AddSubcommand(program, "quality", "Compute quality measures of a set of contacts.",
                    "  graspbench quality contacts.json\n"
                    "  graspbench quality contacts.json --json\n\n"
                    "contacts.json, lengths in metres:\n"
                    "  {\"contacts\": [{\"p_m\": [0.03, 0, 0], \"n\": [-1, 0, 0], \"mu\": 0.5, "
                    "\"torsion_m\": 0.002},\n"
                    "                {\"p_m\": [-0.03, 0, 0], \"n\": [1, 0, 0], \"mu\": 0.5, "
                    "\"torsion_m\": 0.002}],\n"
                    "   \"torque_scale_m\": 0.05}\n"
                    "  n: unit normal into the object; torsion_m: largest moment about it per "
                    "newton; t: first edge\n"
                    "  of the friction cone. Optional: torsion_m, t, edges, reference_m, "
                    "convention:\n"
                    "  " +
                        ListConventions() + ".");
  command.AddRequired("contacts", *path, "file of contacts", "CONTACTS.json");
  AddJsonOption(command, *json);
  command.SetAction([path, json] { ShowQuality(*path, *json); });
}

}  // namespace graspbench
