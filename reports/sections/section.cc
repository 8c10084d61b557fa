#include "reports/sections/section.h"

namespace graspbench {

std::vector<Section> ListSections() {
  return {
#define GRASPBENCH_SECTION(name) name##_section(),
#include "reports/sections/section_list.inc"
#undef GRASPBENCH_SECTION
  };
}

}  // namespace graspbench
