#pragma once
/** @file
A pipeline with its inputs and results as one tar file (pax), for others and for archives:

    manifest.json            SHA-256 and size of every other file; program version and commit
    pipeline/<name>.yaml     and the inputs beside it, as they are named there
    results/<stage>/..       what CopyStableFiles keeps of each result

The same contents, the same bytes: sorted, all times 0, owner 0, no names of users; no clock and no
host, no path but those inside. Links among the inputs are packed as what they point at. */

#include <filesystem>
#include <string>

#include "datasets/journal/manifest.h"
#include "datasets/pipeline/pipeline_file.h"

namespace graspbench {

inline constexpr char kPipelinePack[] = "pipeline";  ///< kind in the manifest
inline constexpr char kPackedPipeline[] = "pipeline";
inline constexpr char kPackedResults[] = "results";

/** Writes such a folder as a tar file. @pre all its files are regular. @throws Error(kIo). */
void WritePack(const std::filesystem::path& folder, const std::filesystem::path& pack);

/** Makes the folder that WritePack packs. @throws Error(kNotFound, kIo). */
void GatherPack(const Pipeline& pipeline, const std::filesystem::path& results,
                const ManifestOrigin& origin, const std::filesystem::path& folder);

/** Writes the manifest of such a folder, whose other files are complete. @throws Error(kIo). */
void SealPack(const std::filesystem::path& folder, const std::string& kind,
              const ManifestOrigin& origin);

/** Into a new folder, and nowhere else: only regular files and folders with names below it, no
more than one of a name, and exactly those of the manifest.
@param kind  that the manifest must have.
@returns the manifest. @throws Error(kNotFound); Error(kFormat) naming what is wrong; Error(kIo). */
Manifest Unpack(const std::filesystem::path& pack, const std::filesystem::path& folder,
                const std::string& kind = kPipelinePack);

/** The pipeline's file in an unpacked folder. @throws Error(kFormat). */
std::filesystem::path FindPackedFile(const std::filesystem::path& folder, const Manifest& manifest);

}  // namespace graspbench
