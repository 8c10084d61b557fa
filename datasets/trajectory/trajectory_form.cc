#include "datasets/trajectory/trajectory_form.h"

#include <filesystem>

#include "core/base/error.h"

namespace graspbench {

const std::vector<TrajectoryForm>& ListTrajectoryForms() {
  static const std::vector<TrajectoryForm> forms = {
#define GRASPBENCH_TRAJECTORY_FORM(Name) Make##Name##TrajectoryForm(),
#include "datasets/trajectory/trajectory_form_list.inc"
#undef GRASPBENCH_TRAJECTORY_FORM
  };
  return forms;
}

const TrajectoryForm& FindTrajectoryForm(const std::string& name) {
  const std::string ending = std::filesystem::path(name).extension().string();
  std::string known;
  for (const TrajectoryForm& form : ListTrajectoryForms()) {
    if (name == form.name || ending == "." + std::string(form.name)) return form;
    known += (known.empty() ? "." : ", .") + std::string(form.name);
  }
  throw Error(ErrorKind::kUsage,
              "--trajectory: \"" + name + "\" ends in none of the forms there are: " + known);
}

std::vector<TrajectoryFile> MakeTrajectoryFiles(const TrajectoryForm& form,
                                                const TrialTrajectory& trajectory) {
  if (form.make) return form.make(trajectory);
  const auto collection = form.collect();
  collection->Add(trajectory);
  return {{"." + std::string(form.name), collection->Finish()}};
}

}  // namespace graspbench
