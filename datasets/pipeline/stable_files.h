#pragma once
/** @file
The parts of a result whose bytes do not depend on who made it, when, on how many workers and with
how many interruptions. For a store (datasets/journal/store_kind.h) these are all files except
run.json, ro-crate-metadata.json, progress/, workers/ and the manifest; for the manifest only its
readability counts. Journals whose files are named after workers count by their lines, in whichever
file these are. */

#include <filesystem>
#include <map>
#include <string>

#include "datasets/pipeline/pipeline_file.h"

namespace graspbench {

/** Lists SHA-256 hashes by path relative to the folder, including stores inside it; journals of
workers are listed by their pattern. If `path` is a file, lists only this file. A manifest has the
value "whole" or "damaged" instead of a hash. @throws Error(kNotFound, kIo). */
std::map<std::string, std::string> ListStableFiles(const std::filesystem::path& path);

/** Returns one hash of the result of ListStableFiles. */
std::string CalcStableSha256(const std::map<std::string, std::string>& files);

/** Copies these parts to a new folder. Journals of workers become one sorted file each,
"journal/0.jsonl", and each store gets a new manifest, so that every command can open it. Equal
results give equal bytes. @throws Error(kNotFound, kIo). */
void CopyStableFiles(const std::filesystem::path& from, const std::filesystem::path& to);

/** Finds files that a stage would read although its pipeline does not list them, as an object's
folder named in a session file, or a study's recordings. Their changes would be undetected, and
packs would lack them.

Adds a fault for each value in a YAML file among the stage's inputs that is an absolute path or
contains "..", and exists. */
void CheckHiddenInputs(const Pipeline& pipeline, const PipelineStage& stage, Diagnostics& problems);

}  // namespace graspbench
