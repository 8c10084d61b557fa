#pragma once
/** @file
What of a result has the same bytes whoever made it, when, on how many workers and with how many
interruptions. Of a store (datasets/journal/store_kind.h) that is everything but run.json and what
is made from it, progress/, workers/ and the manifest, of which only counts whether it can be read;
journals whose files are named after workers count by their lines, whichever file holds them. */

#include <filesystem>
#include <map>
#include <string>

#include "datasets/pipeline/pipeline_file.h"

namespace graspbench {

/** SHA-256 by name from the folder, of stores inside it too; such journals by their pattern.
Of a file itself: one with its name. Instead of a manifest's: "whole" or "damaged". @throws
Error(kNotFound, kIo). */
std::map<std::string, std::string> ListStableFiles(const std::filesystem::path& path);

/** One hash of what ListStableFiles has found. */
std::string CalcStableSha256(const std::map<std::string, std::string>& files);

/** Copies the same to a new folder: such journals as one file each, "journal/0.jsonl", sorted; and
each store gets a manifest again, so that every program can open it. The same result, the same
bytes. @throws Error(kNotFound, kIo). */
void CopyStableFiles(const std::filesystem::path& from, const std::filesystem::path& to);

/** Files that a stage would read though its pipeline does not name them: an object's folder given
by a session file, recordings of a study. Nobody would see them change, and no pack would hold them.

A fault for each value in a YAML file among the stage's inputs that is a path outside of them, by
its root or by "..", and leads to something. */
void CheckHiddenInputs(const Pipeline& pipeline, const PipelineStage& stage, Diagnostics& problems);

}  // namespace graspbench
