#include "core/shape/grasp_object.h"

#include <string>

namespace graspbench {

void ReadApproach(YamlMap& map, Approach& approach) {
  std::string name = RowOf(kApproaches, approach).name;
  map.Read("approach", name, Needed::kNo);
  if (const ApproachRow* row = FindRow(kApproaches, name)) {
    approach = row->value;
  } else {
    map.Fail("approach",
             "no approach \"" + name + "\"" + SuggestNames(name, ListNames(kApproaches)));
  }
}

}  // namespace graspbench
