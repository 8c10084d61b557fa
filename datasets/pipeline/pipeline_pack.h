#pragma once
/** @file
A pipeline with its inputs and results as one tar file (pax), for others and for archives:

    manifest.json            SHA-256 and size of every other file; program version and commit
    pipeline/<name>.yaml     with its inputs, at the paths that it names
    results/<stage>/..       what CopyStableFiles keeps of each result

Equal contents give equal bytes: entries are sorted, all times and owners are 0, and there are no
user names, clock times, hosts or outside paths. Links among the inputs are packed as their
targets. */

#include <filesystem>
#include <string>

#include "datasets/journal/manifest.h"
#include "datasets/pipeline/pipeline_file.h"

namespace graspbench {

inline constexpr char kPipelinePack[] = "pipeline";  ///< kind in the manifest
inline constexpr char kPackedPipeline[] = "pipeline";
inline constexpr char kPackedResults[] = "results";

/** Writes a folder as a tar file. @pre all its files are regular. @throws Error(kIo). */
void WritePack(const std::filesystem::path& folder, const std::filesystem::path& pack);

/** Makes the folder that WritePack packs. @throws Error(kNotFound, kIo). */
void GatherPack(const Pipeline& pipeline, const std::filesystem::path& results,
                const ManifestOrigin& origin, const std::filesystem::path& folder);

/** Writes the manifest of a folder to be packed. @pre its other files are complete. @throws
Error(kIo). */
void SealPack(const std::filesystem::path& folder, const std::string& kind,
              const ManifestOrigin& origin);

/** Unpacks into a new folder and nowhere else. Accepts only regular files and folders inside it,
with unique names, and exactly those in the manifest.
@param kind  required kind of the manifest.
@returns the manifest. @throws Error(kNotFound); Error(kFormat) naming what is wrong; Error(kIo). */
Manifest Unpack(const std::filesystem::path& pack, const std::filesystem::path& folder,
                const std::string& kind = kPipelinePack);

/** Returns the pipeline's file in an unpacked folder. @throws Error(kFormat). */
std::filesystem::path FindPackedFile(const std::filesystem::path& folder, const Manifest& manifest);

}  // namespace graspbench
