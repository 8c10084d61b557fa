#include "reports/page/layout.h"
#include "reports/sections/section.h"

namespace graspbench {
namespace {

Html DrawTrialViews(const ReportData& data) { return data.views.body; }

}  // namespace

Section trial_views_section() { return {"views", "Trials in 3-D", DrawTrialViews}; }

}  // namespace graspbench
