#pragma once
/** @file
Converts figures to PDF with rsvg-convert (Debian: librsvg2-bin), if installed: none of graspbench's
own dependencies writes PDF. */

#include <filesystem>

namespace graspbench {

/** True when rsvg-convert is on the search path. */
bool HasPdfConverter();

/** Writes a PDF of the same name beside the SVG file. @throws Error(kEnvironment). */
void ConvertSvgToPdf(const std::filesystem::path& svg);

}  // namespace graspbench
