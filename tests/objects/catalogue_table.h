#pragma once
/** @file
Table 4.1 of the thesis as printed, to hold the catalogue against. */

#include <string>
#include <vector>

namespace graspbench {

struct CatalogueRow {
  std::string id;
  double mass_g, length_mm, width_mm, height_mm, offset_mm, friction_static, friction_dynamic;
};

inline const std::vector<CatalogueRow>& ListCatalogueRows() {
  static const std::vector<CatalogueRow> kRows = {
      {"adhesive_tape", 24.6, 61.7, 53.4, 26.0, 0, 0.39, 0.32},
      {"toy_propeller", 25.9, 91.2, 91.2, 51.4, 0, 0.33, 0.18},
      {"toy_cube", 12.2, 31.0, 31.0, 31.0, 0, 0.31, 0.14},
      {"can", 368.0, 65.8, 65.8, 115.6, 0, 0.23, 0.18},
      {"tissue_pack", 25.7, 107.0, 53.0, 25.0, 0, 0.35, 0.32},
      {"tennis_ball", 58.4, 66.0, 66.0, 66.0, 0, 0.79, 0.74},
      {"paper_ball", 5.0, 68.0, 58.0, 46.0, 0, 0.75, 0.71},
      {"sharpener", 24.4, 36.6, 36.6, 57.0, 0, 0.44, 0.42},
      {"remote_control", 145.9, 165.0, 50.0, 40.0, 11.0, 0.40, 0.37},
      {"cup", 236.4, 107.5, 85.0, 65.0, 10.0, 0.40, 0.40},
      {"board_marker", 16.8, 140.0, 17.8, 17.8, 2.0, 0.44, 0.40},
      {"tea_light", 13.5, 38.0, 38.0, 16.5, 0, 0.30, 0.25},
      {"golf_ball", 45.7, 42.7, 42.7, 42.7, 0, 0.25, 0.22},
      {"matchbox", 7.2, 52.0, 37.0, 13.5, 0, 0.48, 0.42},
      {"light_bulb", 28.3, 103.5, 60.4, 60.4, 9.5, 0.30, 0.26},
      {"chocolate_bar", 55.7, 101.0, 30.5, 22.0, 0, 0.30, 0.29},
      {"folding_rule", 101.4, 235.0, 16.4, 39.0, 0, 0.31, 0.29},
      {"voltage_tester", 16.9, 139.3, 17.5, 15.0, 11.5, 0.26, 0.22},
      {"eraser", 17.9, 49.0, 10.3, 24.2, 0, 1.10, 0.80},
      {"bunch_of_keys", 98.6, 69.0, 26.0, 17.0, 0, 0.30, 0.26},
      {"pencil", 4.4, 175.0, 7.6, 6.9, 5.5, 0.30, 0.29}};
  return kRows;
}

}  // namespace graspbench
