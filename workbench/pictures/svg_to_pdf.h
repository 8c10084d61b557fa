#pragma once
/** @file
Figures as PDF by rsvg-convert (Debian: librsvg2-bin), where it is installed: nothing that
graspbench needs draws PDF. */

#include <filesystem>

namespace graspbench {

/** True when rsvg-convert is on the search path. */
bool HasPdfConverter();

/** Writes the file beside it with the ending .pdf. @throws Error(kEnvironment). */
void ConvertSvgToPdf(const std::filesystem::path& svg);

}  // namespace graspbench
