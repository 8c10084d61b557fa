#pragma once
/** @file
Files of reports/page/assets, compiled into the program (reports/CMakeLists.txt). */

#include <string_view>

namespace graspbench::assets {

extern const std::string_view kPage;         ///< page.mustache
extern const std::string_view kStyle;        ///< style.css
extern const std::string_view kPlotStyle;    ///< plot.css, which uses the variables of style.css
extern const std::string_view kScript;       ///< page.js
extern const std::string_view kReferences;   ///< references.bib
extern const std::string_view kReleaseYear;  ///< from CITATION.cff
extern const std::string_view kLibraries;    ///< "Simbody 3.7, .."
/** For scene_3d.h: three.js with its loader and controls and scene_3d.js, in this order. */
extern const std::string_view kSceneScript;
extern const std::string_view kSceneStyle;    ///< scene_3d.css
extern const std::string_view kThreeLicence;  ///< three_licence.txt

}  // namespace graspbench::assets
