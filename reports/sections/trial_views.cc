#include "reports/page/layout.h"
#include "reports/sections/section.h"

namespace graspbench {
namespace {

Html DrawTrialViews(const ReportData& data) {
  if (!data.views.body.empty()) return data.views.body;
  return Element("p", {},
                 Text("This page was made without them; with them: ") +
                     Element("code", {}, "graspbench report DIR --3d") +
                     Text("; one trial alone: ") +
                     Element("code", {}, "graspbench trial DIR TRIAL --page trial.html"));
}

}  // namespace

Section trial_views_section() { return {"views", "Trials in 3-D", DrawTrialViews}; }

}  // namespace graspbench
