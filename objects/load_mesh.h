#pragma once
/** @file
Mesh files: OBJ, STL (binary and ASCII), PLY, GLB and glTF, chosen by the ending of the name. All
parts of a file become one mesh, with the transforms of its scene applied.

They are read behind the fence (core/fence/fence.h), OBJ by core/shape/obj_file.h, the others by
assimp (read_foreign_mesh.h); a glTF has its parts from nowhere but the mesh's own folder: a file
from elsewhere may be damaged or malicious. COLLADA is left out for things to grasp because damaged
files crash its importer, 3DS and DXF because theirs swaps axes. */

#include <filesystem>
#include <string>

#include "core/shape/tri_mesh.h"
#include "objects/mesh_limits.h"

namespace graspbench {

/** "OBJ, STL, PLY, GLB or glTF". */
std::string ListMeshFormats();

/** In metres, coincident vertices welded. Axes as in the file. Coordinates carry single precision.
Not checked: see core/shape/repair/mesh_check.h. Vertices may be non-finite. Files up to 256 MB and
meshes up to 2 million triangles.
@throws Error(kNotFound, kIo); Error(kFormat) when it is no complete file of a format known here. */
TriMesh LoadMesh(const std::filesystem::path& path, LengthUnit unit);

/** A picture of a hand's link: the same formats and COLLADA, one unit of the file a metre unless
the file states another (COLLADA does). Axes as in the file. A damaged COLLADA file that crashes its
reader is an Error(kFormat) like others. */
TriMesh LoadPictureMesh(const std::filesystem::path& path);

/** The same from the content of a file that stands alone; `name` gives the format by its ending. */
TriMesh ParseMesh(const std::string& bytes, const std::string& name, LengthUnit unit);

/** Reads the bytes of one file behind the fence. Coordinates as in the file, every part of it; not
welded, perhaps not finite. @param bytes   the file's content.
@param format  obj, stl, ply, glb, gltf or dae.
@param folder  where the files lie that a glTF names; empty: nowhere.
@param name    of the file, for messages.
@throws Error(kFormat) when it is no such file, or reading it took more memory than allowed, or
crashed; Error(kEnvironment) when the reader cannot be started or took too long. Safe with
threads. */
TriMesh RunMeshReader(const std::string& bytes, const std::string& format,
                      const std::filesystem::path& folder, const std::string& name);

}  // namespace graspbench
