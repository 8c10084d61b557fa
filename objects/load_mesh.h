#pragma once
/** @file
Reads mesh files: OBJ, STL (binary and ASCII), PLY, GLB and glTF, chosen by the file extension. All
parts of a file become one mesh, with the transforms of its scene applied.

The files may be damaged or malicious, so they are read behind the fence (core/fence/fence.h): OBJ
by core/shape/obj_file.h, the others by assimp (read_foreign_mesh.h). A glTF file may only refer to
files in its own folder or below. For objects to grasp, COLLADA is not supported because damaged
files crash its importer, nor are 3DS and DXF because theirs swaps axes. */

#include <filesystem>
#include <string>

#include "core/shape/tri_mesh.h"
#include "objects/mesh_limits.h"

namespace graspbench {

/** Returns "OBJ, STL, PLY, GLB or glTF". */
std::string ListMeshFormats();

/** Loads a mesh in metres, with coincident vertices welded and the axes of the file. Coordinates
have single precision. The mesh is not checked (see core/shape/repair/mesh_check.h), and vertices
may be non-finite. Files may have up to 256 MB and meshes up to 2 million triangles.
@throws Error(kNotFound, kIo); Error(kFormat) when it is not a complete file of a known format. */
TriMesh LoadMesh(const std::filesystem::path& path, LengthUnit unit);

/** Loads the visual mesh of a hand's link, in the same formats or COLLADA, with the axes of the
file. The file's unit is the metre unless it states another (COLLADA does). A damaged COLLADA file
that crashes its reader raises Error(kFormat) as well. */
TriMesh LoadPictureMesh(const std::filesystem::path& path);

/** As LoadMesh(), from the content of a self-contained file; the extension of `name` gives the
format. */
TriMesh ParseMesh(const std::string& bytes, const std::string& name, LengthUnit unit);

/** Reads all parts of one file behind the fence. Coordinates are as in the file, not welded and
perhaps not finite. Thread-safe.
@param bytes   the file's content.
@param format  obj, stl, ply, glb, gltf or dae.
@param folder  holds the files that a glTF refers to; empty: none may be read.
@param name    of the file, for messages.
@throws Error(kFormat) when the file does not have this format, or when its reader crashed or
exceeded its memory limit; Error(kEnvironment) when the reader cannot be started or timed out. */
TriMesh RunMeshReader(const std::string& bytes, const std::string& format,
                      const std::filesystem::path& folder, const std::string& name);

}  // namespace graspbench
